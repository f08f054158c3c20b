#pragma once

#include <span>
#include <vector>

#include "geometry/types.h"
#include "unsnarl/routes.h"

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

/// The way of a point that moves straight and evenly from p to q in step k of so many of all time, as it is seen from
/// something that moves (RouteObstacle::motion, not empty): a polyline with a corner where that changes its motion.
/// Each coordinate is rounded once.
std::vector<Vec3> seen_from(std::span<const RouteMove> motion, const Vec3& p, const Vec3& q, std::size_t k,
                            std::size_t steps, double duration);
/// proven_clearance for points that were rounded once.
double proven_clearance_of_rounded(std::span<const Vec3> a, std::span<const Vec3> b, const Vec3& direction, double r);

/// Whether |a - b| >= r + s, exactly.
bool is_as_far(const Vec3& a, const Vec3& b, double r, double s);

/// An upper bound of r * curvature at b of the polyline a, b, c: 2 r tan(angle / 2) / the shorter of the edges (E.
/// Rawdon's MinRad). At most 1 where that is so by exact arithmetic; infinite where an edge is turned back or has no
/// length.
double proven_turn(const Vec3& a, const Vec3& b, const Vec3& c, double r);

/// An upper bound of the speed from a to b in one of so many steps of all time, / the one allowed. At most 1 where that
/// is so by exact arithmetic.
double proven_speed(const Vec3& a, const Vec3& b, std::size_t steps, double duration, double allowed);

/// Whether step k of so many is not before this time, exactly.
bool is_at_or_after(std::size_t k, std::size_t steps, double duration, double time);
/// Whether it is not after this time.
bool is_at_or_before(std::size_t k, std::size_t steps, double duration, double time);

}  // namespace unsnarl
