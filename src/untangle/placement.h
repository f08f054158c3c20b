#pragma once

#include <functional>
#include <span>
#include <vector>

#include "scene/patch.h"
#include "scene/scene.h"
#include "unsnarl/intersections.h"
#include "untangle/conflict_regions.h"
#include "untangle/tangle_depth.h"

namespace unsnarl {

/// Components are put at the cheapest free place instead of being repelled. Every component of the patch that is free
/// as a whole goes back to patch.rest, unless it intersects itself there, and from there, the largest first, to the
/// nearest place where it intersects nothing outside itself but those still to be placed: by a translation (26
/// directions and the normals of its contacts) or by shrinking toward its middle or one of its own vertices, cheapest
/// by the root mean square of the displacement. One without a free place within its own diagonal stays where it was,
/// one of more than 4000 faces at rest. Returns the number of components that were placed.
int place(Patch& patch, std::span<const IntersectingPair> tolerated, const std::function<bool()>& stop);

/// All vertices of the components that a region ties together, by its pairs and through those that intersected at first
/// (`initial_pairs`), ascending. Components with a fixed vertex are left out; none where the region lies within one.
std::vector<Index> vertices_of_tied_components(const Scene& scene, const ConnectedParts& parts,
                                               const ConflictRegion& region,
                                               std::span<const IntersectingPair> initial_pairs);

}  // namespace unsnarl
