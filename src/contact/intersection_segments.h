#pragma once

#include <array>
#include <span>
#include <vector>

#include "geometry/types.h"
#include "unsnarl/intersections.h"

namespace unsnarl {

/// The pieces of the intersection curves: where the two triangles of each pair cross, from end to end. Pairs that only
/// touch in a point, or that overlap flat, have none.
///
/// `pairs` are those the exact detector found at x. Which edges pierce which triangles is decided exactly, the points
/// are rounded.
std::vector<std::array<Vec3, 2>> intersection_segments(const Positions& x, std::span<const Triangle> triangles,
                                                       std::span<const IntersectingPair> pairs);

}  // namespace unsnarl
