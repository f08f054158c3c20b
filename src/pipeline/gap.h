#pragma once

#include <span>

#include "geometry/scale.h"
#include "scene/scene.h"
#include "unsnarl/intersections.h"

namespace unsnarl {

/// The gap wanted between sheets around these vertices for the format that is to be written: a few units in its last
/// place. By these vertices alone, so that distant parts change nothing. `scale`: of the positions.
double gap_of_format(const Scene& scene, std::span<const Index> vertices, bool float32, const Scale& scale);

/// Is float32 fine enough for the scene? By the conflicts alone: parts far away that have none change nothing.
bool float32_can_hold(const Scene& scene, std::span<const IntersectingPair> pairs, const Scale& scale);

}  // namespace unsnarl
