#pragma once

#include <span>
#include <vector>

#include "scene/scene.h"
#include "unsnarl/intersections.h"

namespace unsnarl {

/// Of these regions (disjoint sets of vertices, each ascending) those of which some vertex has moved many times as far
/// as the faces ran into each other, and farther than what the conflicts cut off is deep, and that are a good part of
/// their components: there may be a closer way. `pairs`: of triangles, those of the scene at rest.
std::vector<std::vector<Index>> far_regions(const Scene& scene, std::span<const std::vector<Index>> regions,
                                            std::span<const IntersectingPair> pairs);

}  // namespace unsnarl
