#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "contact/intersection_finder.h"
#include "repair/prepared_surface.h"
#include "unsnarl/repair.h"

namespace unsnarl {

/// What the input is, before any work.
struct Diagnosis {
  Topology topology;
  Components components;
  std::vector<Edge> edges;              ///< of the triangles, sorted
  std::vector<IntersectingPair> pairs;  ///< of triangles, sorted
  std::vector<Obstruction> obstructions;
  std::vector<IntersectingPair> obstructed;  ///< those pairs that no motion can resolve; a subset of `pairs`, sorted
};

inline bool are_of_two_components(const Components& components, const IntersectingPair& pair) {
  return components.component_of_triangle[pair.a] != components.component_of_triangle[pair.b];
}

/// `fixed`: one flag an identified vertex; empty: none. `finder`: of the prepared triangles.
Diagnosis diagnose(const SurfaceView& surface, const PreparedSurface& prepared, std::span<const std::uint8_t> fixed,
                   IntersectionFinder& finder);

}  // namespace unsnarl
