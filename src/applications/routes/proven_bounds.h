#pragma once

#include <span>

#include "geometry/types.h"

namespace unsnarl {

/// Bounds that hold for the given coordinates whatever rounding errors their computation has.

/// A lower bound of the distance of the convex hulls of a and b, / (r + s): the gap of two planes across `direction`
/// (any; best from b's closest point to a's) with nothing of either between them. At least 1 where that is so by exact
/// arithmetic. Precondition: r + s > 0, all finite and below 1e100.
double proven_clearance(std::span<const Vec3> a, std::span<const Vec3> b, const Vec3& direction, double r, double s);

/// The same for two points that move straight and evenly, at the same time, from the first to the second of a and of b:
/// at every moment.
double proven_clearance_in_time(std::span<const Vec3, 2> a, std::span<const Vec3, 2> b, const Vec3& direction, double r,
                                double s);

/// Whether |a - b| >= r + s, exactly.
bool is_as_far(const Vec3& a, const Vec3& b, double r, double s);

/// An upper bound of r * curvature at b of the polyline a, b, c: 2 r tan(angle / 2) / the shorter of the edges (E.
/// Rawdon's MinRad). At most 1 where that is so by exact arithmetic; infinite where an edge is turned back or has no
/// length.
double proven_turn(const Vec3& a, const Vec3& b, const Vec3& c, double r);

}  // namespace unsnarl
