#pragma once

#include <span>
#include <vector>

#include "geometry/types.h"
#include "repair/scene.h"
#include "unsnarl/intersections.h"

namespace unsnarl {

/// Intersecting faces that hang together and are repaired as one.
struct ConflictRegion {
  std::vector<Index> core;              ///< vertices of the intersecting faces, ascending
  std::vector<IntersectingPair> pairs;  ///< ascending
};

/// Groups pairs whose faces intersect each other or lie within two edges of each other. Ordered by smallest vertex.
std::vector<ConflictRegion> conflict_regions(const Scene& scene, std::span<const IntersectingPair> pairs);

/// The given vertices and all that at most `rings` edges away, without fixed ones; ascending.
std::vector<Index> dilate(const Scene& scene, std::span<const Index> vertices, int rings);

}  // namespace unsnarl
