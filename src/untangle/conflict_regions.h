#pragma once

#include <limits>
#include <span>
#include <vector>

#include "geometry/types.h"
#include "scene/scene.h"
#include "unsnarl/intersections.h"

namespace unsnarl {

/// Intersecting faces that are near each other and are repaired as one.
struct ConflictRegion {
  std::vector<Index> core;              ///< vertices of the intersecting faces, ascending
  std::vector<IntersectingPair> pairs;  ///< ascending
};

/// Bound of the number of neighbours of a vertex: none. (Vertices of high valence connect faces far apart, and move all
/// of them.)
constexpr std::size_t any_valence = std::numeric_limits<std::size_t>::max();

/// Groups pairs whose faces intersect each other or lie within two edges of each other. Ordered by smallest vertex.
/// Vertices with more neighbours than `most_valence` belong to no region and join none. A pair is left out if one of
/// its faces has only such vertices.
std::vector<ConflictRegion> conflict_regions(const Scene& scene, std::span<const IntersectingPair> pairs,
                                             std::size_t most_valence = any_valence);

/// The given vertices (ascending) and all that are at most `rings` edges away, without fixed ones, ascending. Rings end
/// at vertices with more neighbours than `most_valence`, which are left out.
std::vector<Index> dilate(const Scene& scene, std::span<const Index> vertices, int rings,
                          std::size_t most_valence = any_valence);

/// Sets of vertices that overlap become one; each ascending.
std::vector<std::vector<Index>> merge_overlapping(std::vector<std::vector<Index>> sets, Index vertex_count);

}  // namespace unsnarl
