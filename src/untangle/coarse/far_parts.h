#pragma once

#include <vector>

#include "geometry/types.h"
#include "scene/scene.h"

namespace unsnarl {

/// How far the free vertices of a scene are from rest: the sum of their distances, a length.
double total_motion(const Scene& scene);

/// Connected sets of free vertices that are farther than `distance` (a length) from rest, each ascending, of which each
/// has more than this share of the total motion; the set with the most of it comes first.
std::vector<std::vector<Index>> far_parts(const Scene& scene, double distance, double share);

}  // namespace unsnarl
