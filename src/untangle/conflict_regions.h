#pragma once

#include <limits>
#include <span>
#include <vector>

#include "geometry/types.h"
#include "scene/scene.h"
#include "unsnarl/intersections.h"

namespace unsnarl {

/// Intersecting faces that hang together and are repaired as one.
struct ConflictRegion {
  std::vector<Index> core;              ///< vertices of the intersecting faces, ascending
  std::vector<IntersectingPair> pairs;  ///< ascending
};

/// Vertices with more neighbours are hubs: they tie together faces far apart, and moving one moves all of those.
constexpr std::size_t no_hubs = std::numeric_limits<std::size_t>::max();

/// Groups pairs whose faces intersect each other or lie within two edges of each other. Ordered by smallest vertex.
/// Hubs are left out of the regions, and do not join them; so are pairs of which a face has nothing but hubs.
std::vector<ConflictRegion> conflict_regions(const Scene& scene, std::span<const IntersectingPair> pairs,
                                             std::size_t hub_valence = no_hubs);

/// The given vertices and all that are at most `rings` edges away, without fixed ones and hubs, nor what lies behind
/// hubs; ascending.
std::vector<Index> dilate(const Scene& scene, std::span<const Index> vertices, int rings,
                          std::size_t hub_valence = no_hubs);

/// Sets of vertices that overlap become one; each ascending.
std::vector<std::vector<Index>> merge_overlapping(std::vector<std::vector<Index>> sets, Index vertex_count);

}  // namespace unsnarl
