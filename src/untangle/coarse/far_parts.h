#pragma once

#include <vector>

#include "geometry/types.h"
#include "scene/scene.h"

namespace unsnarl {

/// Sum of the distances of the free vertices to rest, a length.
double total_motion(const Scene& scene);

/// Connected sets of free vertices that are farther than `distance` (a length) from rest, each ascending. Each has more
/// than `share` of the total motion; the set with the most motion comes first.
std::vector<std::vector<Index>> far_parts(const Scene& scene, double distance, double share);

}  // namespace unsnarl
