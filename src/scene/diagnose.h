#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "contact/intersection_finder.h"
#include "scene/prepared_surface.h"
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
  std::vector<std::uint8_t> fixed;           ///< one flag a welded vertex; empty: none
};

inline bool are_of_two_components(const Components& components, const IntersectingPair& pair) {
  return components.component_of_triangle[pair.a] != components.component_of_triangle[pair.b];
}

/// What keeps any motion from parting two intersecting triangles, if anything does.
std::optional<Obstruction::Kind> obstruction_of(const PreparedSurface& prepared, const Components& components,
                                                std::span<const std::uint8_t> fixed, const IntersectingPair& pair);

/// `fixed`: one flag a welded vertex; empty: none. `finder`: of the prepared triangles.
Diagnosis diagnose(const SurfaceView& surface, const PreparedSurface& prepared, std::span<const std::uint8_t> fixed,
                   IntersectionFinder& finder);

}  // namespace unsnarl
