#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "contact/intersection_finder.h"
#include "scene/prepared_surface.h"

namespace unsnarl {

/// Finds the intersecting pairs of the faces of a surface, by the triangles that they are split into. If both diagonals
/// of quads count, a quad is split along either. The surface must outlive it.
class FacePairFinder {
 public:
  enum class Which : std::uint8_t { to_resolve, allowed };
  /// Finds the pairs that may not pass through each other, or those that may.
  explicit FacePairFinder(const PreparedSurface& surface, Which which = Which::to_resolve);

  /// Pairs of faces, sorted, each once, in the class of its first occurrence.
  std::vector<IntersectingPair> find(const Positions& x);
  /// The same pairs in blocks and in no order, so that memory does not grow with their number. (Pairs of polygons with
  /// many corners are kept and come last.) `take` is called by one thread at a time. Throws WorkStopped soon after
  /// `stop` says so.
  void visit(const Positions& x, const std::function<bool()>& stop,
             const std::function<void(std::span<const IntersectingPair>)>& take);

 private:
  /// The triangles of a quad along one diagonal always overlap those along the other.
  bool are_of_one_quad(const IntersectingPair& pair) const;
  std::span<const Triangle> triangles() const { return triangles_.empty() ? surface_.triangles() : triangles_; }
  Passing passing() const { return Passing({}, part_of_, surface_.allowed.passing); }
  std::span<const Index> polygon() const { return triangles_.empty() ? surface_.triangulation.polygon : polygon_; }
  /// Whether no intersecting pair of pieces of the same two faces comes before this one: in its class, then by ids.
  bool stands_for_its_faces(const Positions& x, const IndexLists& pieces, const IntersectingPair& pair) const;

  const PreparedSurface& surface_;
  std::vector<Triangle> triangles_;  ///< along both diagonals; empty: only one counts
  std::vector<Index> polygon_;
  std::vector<Index> part_of_;  ///< of the triangles, among the parts of the surface
  IntersectionFinder finder_;
};

/// Intersecting pairs of faces that may pass through each other; none where nothing may. `read`: the surface as a
/// program sees it that reads these positions (cut_anew), if that differs.
std::vector<IntersectingPair> find_allowed_pairs(const PreparedSurface& surface,
                                                 const std::optional<PreparedSurface>& read, const Positions& x);

}  // namespace unsnarl
