#include "peer.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "contact/intersection_finder.h"

namespace unsnarl::peers {
namespace {

constexpr std::array all_methods = {
    Method{"isir", "Jang et al. 2025, Instant Self-Intersection Repair, 60 iterations", make_instant_repair},
    Method{"isir_long", "the same, 15,000 iterations", make_long_instant_repair},
    Method{"cmcf", "Kazhdan et al. 2012, conformalised mean curvature flow, until embedded", make_conformalised_flow},
    Method{"smoothing", "Laplacian smoothing around the intersecting faces", make_conflict_smoothing},
    Method{"contours", "Volino and Magnenat-Thalmann 2006, intersection contours, each crossing by itself",
           make_contour_minimisation},
    Method{"contours_whole", "the same, one direction a contour", make_contour_scale_minimisation},
    Method{"colouring", "Baraff, Witkin and Kass 2003, regions inside intersection curves",
           make_intersection_colouring},
};

}  // namespace

std::span<const Method> methods() {
  return all_methods;
}

const Method& method_named(std::string_view name) {
  std::string known;
  for (const Method& method : all_methods) {
    if (method.name == name) return method;
    known += (known.empty() ? "" : ", ") + std::string(method.name);
  }
  throw std::invalid_argument("there is no method '" + std::string(name) + "'; there are " + known);
}

Outcome run(Peer& peer, const Start& start, int most_iterations, const std::function<bool()>& stop) {
  if (most_iterations <= 0) most_iterations = peer.most_iterations();
  IntersectionFinder finder(start.triangles);
  Positions x = start.rest;
  Outcome outcome;
  outcome.x = x;
  for (bool first = true;; first = false) {
    std::vector<IntersectingPair> pairs = finder.find(x);
    std::erase_if(pairs, [&](const IntersectingPair& pair) { return !peer.sees(pair.kind); });
    if (first || pairs.size() < outcome.pairs_left) {
      outcome.x = x;
      outcome.pairs_left = pairs.size();
    }
    outcome.ended = pairs.empty()                           ? "goal"
                    : outcome.iterations >= most_iterations ? "iterations"
                    : stop()                                ? "time"
                                                            : "";
    if (!outcome.ended.empty()) break;
    if (!peer.step(pairs, x)) {
      outcome.ended = "own rule";
      break;
    }
    ++outcome.iterations;
    if (!x.allFinite()) {
      outcome.ended = "diverged";
      break;
    }
  }
  return outcome;
}

}  // namespace unsnarl::peers
