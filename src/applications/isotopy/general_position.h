#pragma once

#include <functional>

#include "applications/isotopy/corner_removal.h"

namespace unsnarl {

/// Places near the corners of simple, disjoint polygons, in general position: drawings often have corners in line, and
/// removals would then lead edges past corners at a distance of rounding. Every corner goes a random way of at most a
/// fiftieth of the distance from its edges to what these do not touch. The polygons stay simple and disjoint while
/// corners go straight to their places. Precondition: all points are corners. If stop() says true, the points are
/// returned as they are.
Points2 in_general_position(const Corners& corners, const std::function<bool()>& stop);

}  // namespace unsnarl
