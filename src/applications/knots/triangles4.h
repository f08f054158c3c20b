#pragma once

#include <array>

#include "geometry/types.h"

namespace unsnarl {

using Vec4 = Eigen::Vector4d;
using Triangle4 = std::array<Vec4, 3>;

/// Whether two triangles in R^4, neither of them degenerate, meet anywhere but in the hull of the corners they share.
/// Touching counts. The first `shared` corners of a and b, 0 to 2 of them, are the same.
///
/// Exact: a hyperplane between the two is tried in floating point with a bound of its rounding; where that does not
/// tell, the linear system whose solutions are the common points is solved in rational numbers, parallel and
/// overlapping planes included.
bool triangles_meet(const Triangle4& a, const Triangle4& b, int shared);

/// Sign of det(a1 - a0, a2 - a0, b1 - b0, b2 - b0), exactly: that of a crossing of two oriented surfaces; 0: the planes
/// of the triangles have a direction in common.
int crossing_sign(const Triangle4& a, const Triangle4& b);

/// The point at which two triangles meet that have no common corners and a crossing sign other than 0; rounded.
Vec4 crossing_point(const Triangle4& a, const Triangle4& b);

/// The point of the convex hull of `count` points (1 to 9) that is nearest to the origin, by P. Wolfe, "Finding the
/// nearest point in a polytope" (1976), up to rounding. weights: those of the points in it, which sum to 1.
Vec4 nearest_to_origin(const std::array<Vec4, 9>& points, int count, std::array<double, 9>& weights);

}  // namespace unsnarl
