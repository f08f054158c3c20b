#pragma once

#include <span>

#include "repair/conflict_regions.h"
#include "repair/scene.h"

namespace unsnarl {

/// How deep a conflict is, in edges of the mesh. Where a surface runs through another the intersecting faces cut a
/// pocket off it. The depth is the largest number of edges between a vertex of a pocket and those faces, but no more
/// than half its girth, for it may leave sideways; 0 where nothing is cut off. The cost follows the surroundings of
/// that width.
int pocket_depth(const Scene& scene, std::span<const Index> component_of_vertex, const ConflictRegion& region);

}  // namespace unsnarl
