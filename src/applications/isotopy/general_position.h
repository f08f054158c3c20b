#pragma once

#include <functional>

#include "applications/isotopy/corner_removal.h"

namespace unsnarl {

/// Places near those of simple, disjoint polygons, of which no three are in line but by chance: corners of drawings
/// often are, and removals would then lead edges past corners at a distance of rounding. Every corner goes a random
/// way, at most a fiftieth of the distance of its edges to what they do not touch, so that the polygons stay simple and
/// disjoint if corners go straight there. All points are corners. The points as they are where stop() says true.
Points2 in_general_position(const Corners& corners, const std::function<bool()>& stop);

}  // namespace unsnarl
