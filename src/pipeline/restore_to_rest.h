#pragma once

#include <span>
#include <vector>

#include "contact/intersection_finder.h"
#include "scene/scene.h"

namespace unsnarl {

/// Puts sets of vertices back to rest, whole, in which a vertex is farther from rest than `limit`, and those that would
/// run through them then. Pairs beyond `known` (sorted, those of the scene at rest) that are there afterwards lie
/// outside of all sets. `finder` is of the scene's triangles. True: some were put back.
bool restore_what_is_too_far(Scene& scene, const std::vector<std::vector<Index>>& sets, double limit,
                             std::span<const IntersectingPair> known, IntersectionFinder& finder);

}  // namespace unsnarl
