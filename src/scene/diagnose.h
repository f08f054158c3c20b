#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "contact/intersection_finder.h"
#include "scene/pair_policy.h"
#include "scene/prepared_surface.h"
#include "unsnarl/repair.h"

namespace unsnarl {

/// Properties of the input, before the repair.
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

/// Topology, components and edges of a surface, without intersections.
Diagnosis diagnose_topology(const SurfaceView& surface, const PreparedSurface& prepared);

/// Adds the pairs that intersect at prepared.rest to a diagnose_topology(), and which of them no motion resolves.
/// `policy`: of these components. `finder`: of the prepared triangles. Throws WorkStopped soon after `stop` says so.
void diagnose_intersections(const PreparedSurface& prepared, const PairPolicy& policy, IntersectionFinder& finder,
                            Diagnosis& diagnosis, const std::function<bool()>& stop = {});

/// Both, where all pairs count. `fixed`: one flag a welded vertex; empty: none. Arguments as above.
Diagnosis diagnose(const SurfaceView& surface, const PreparedSurface& prepared, std::span<const std::uint8_t> fixed,
                   IntersectionFinder& finder, const std::function<bool()>& stop = {});

}  // namespace unsnarl
