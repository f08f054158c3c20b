#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/types.h"
#include "unsnarl/intersections.h"

// Methods of other papers, written for measurement alone: nothing of the product uses them.

namespace unsnarl::peers {

/// The surface that a method starts from: welded vertices, polygons cut into triangles. Lengths are those of the file.
struct Start {
  const Positions& rest;
  std::span<const Triangle> triangles;
};

/// A method that moves vertices until nothing intersects, one iteration at a time.
class Peer {
 public:
  virtual ~Peer() = default;
  /// The pairs that its paper detects; it has reached its goal where none of them is left.
  virtual bool sees(PairClass) const { return true; }
  /// Its paper's limit, or ours where the paper has none.
  virtual int most_iterations() const = 0;
  /// One iteration, in place; `pairs`, never empty, are those it sees at x. False: it ends by its own rule.
  virtual bool step(const std::vector<IntersectingPair>& pairs, Positions& x) = 0;
};

struct Outcome {
  Positions x;         ///< of all iterations the state with the fewest pairs that the method sees, the first such
  int iterations = 0;  ///< made, also those after that state
  std::size_t pairs_left = 0;  ///< of triangles, at x
  std::string ended;           ///< "goal", "own rule", "iterations", "time", "diverged"
};

/// Runs a method from rest until it reaches its goal, ends by its rule, or `stop` says so; most_iterations: 0: its own.
Outcome run(Peer& peer, const Start& start, int most_iterations, const std::function<bool()>& stop);

struct Method {
  std::string_view name;  ///< as on the command line
  std::string_view description;
  std::unique_ptr<Peer> (*make)(const Start& start);
};
std::span<const Method> methods();
/// Throws std::invalid_argument, naming the methods, for an unknown name.
const Method& method_named(std::string_view name);

// The methods, each in a file of its name.
std::unique_ptr<Peer> make_instant_repair(const Start& start);
std::unique_ptr<Peer> make_long_instant_repair(const Start& start);
std::unique_ptr<Peer> make_conformalised_flow(const Start& start);
std::unique_ptr<Peer> make_conflict_smoothing(const Start& start);
std::unique_ptr<Peer> make_contour_minimisation(const Start& start);
std::unique_ptr<Peer> make_contour_scale_minimisation(const Start& start);
std::unique_ptr<Peer> make_intersection_colouring(const Start& start);

}  // namespace unsnarl::peers
