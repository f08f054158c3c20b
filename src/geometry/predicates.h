#pragma once

#include <cfloat>
#include <cmath>

#include "geometry/types.h"

// The error bounds below hold for arithmetic that rounds every operation to a double, to nearest, and keeps its order.
#if defined(__FAST_MATH__) || defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__) || \
    (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__ > 0)
#error "unsnarl would certify falsely with -ffast-math, -Ofast or one of their parts: compile it without"
#endif
static_assert(FLT_EVAL_METHOD == 0, "unsnarl would certify falsely with the x87 unit: compile it with -mfpmath=sse");

namespace unsnarl {

/// Exact signs. Each predicate tries a floating-point filter whose error is bounded and decides by exact arithmetic
/// where the filter cannot. Points that are not finite have sign 0. Filters after J. R. Shewchuk, "Adaptive Precision
/// Floating-Point Arithmetic and Fast Robust Geometric Predicates" (1997), error bounds "A".
using Sign = int;  // -1, 0, +1

namespace detail {
/// These compute with integers of as many digits as the coordinates need: nothing is rounded.
Sign orient3d_exact(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
Sign orient2d_exact(double ax, double ay, double bx, double by, double cx, double cy);

/// Half a unit in the last place of 1, 2^-53 (fixed by float64)
inline constexpr double half_ulp = 1.1102230246251565e-16;
/// Relative error of orient3d in floating point, from Shewchuk's paper (fixed by float64)
inline constexpr double orient3d_bound = (7.0 + 56.0 * half_ulp) * half_ulp;
/// Relative error of orient2d in floating point, from Shewchuk's paper (fixed by float64)
inline constexpr double orient2d_bound = (3.0 + 16.0 * half_ulp) * half_ulp;
/// Products below this may underflow, and the error bounds do not hold (fixed by float64)
inline constexpr double underflow_guard = 1e-280;
/// An underflowing product loses less than this; in orient3d it is then multiplied by a difference along z (fixed by
/// float64)
inline constexpr double lost_to_underflow = 1e-300;
inline Sign sign_of(double value) {
  return (value > 0) - (value < 0);
}
}  // namespace detail

/// Sign of det(b - a, c - a, d - a): +1 where d sees a, b, c counter-clockwise from the side that (b-a)x(c-a) points
/// to.
inline Sign orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const double adx = a[0] - d[0], ady = a[1] - d[1], adz = a[2] - d[2];
  const double bdx = b[0] - d[0], bdy = b[1] - d[1], bdz = b[2] - d[2];
  const double cdx = c[0] - d[0], cdy = c[1] - d[1], cdz = c[2] - d[2];
  const double bc1 = bdx * cdy, bc2 = cdx * bdy;
  const double ca1 = cdx * ady, ca2 = adx * cdy;
  const double ab1 = adx * bdy, ab2 = bdx * ady;
  const double det = adz * (bc1 - bc2) + bdz * (ca1 - ca2) + cdz * (ab1 - ab2);
  const double magnitude = (std::abs(bc1) + std::abs(bc2)) * std::abs(adz) +
                           (std::abs(ca1) + std::abs(ca2)) * std::abs(bdz) +
                           (std::abs(ab1) + std::abs(ab2)) * std::abs(cdz);
  // A product that underflows may be multiplied by a difference along z that is huge.
  const double underflow = detail::lost_to_underflow * (1 + (std::abs(adz) + std::abs(bdz) + std::abs(cdz)));
  if (std::abs(det) > detail::orient3d_bound * magnitude + underflow)
    return -detail::sign_of(det);  // Shewchuk's sign is that of det(a - d, b - d, c - d)
  // Planes parallel to the axes are common in modelled shapes and would all reach the exact path.
  if ((adx == 0 && bdx == 0 && cdx == 0) || (ady == 0 && bdy == 0 && cdy == 0) || (adz == 0 && bdz == 0 && cdz == 0))
    return 0;
  return detail::orient3d_exact(a, b, c, d);
}

/// Sign of the area of the triangle (a, b, c) in the plane.
inline Sign orient2d(double ax, double ay, double bx, double by, double cx, double cy) {
  const double left = (ax - cx) * (by - cy);
  const double right = (ay - cy) * (bx - cx);
  const double det = left - right;
  const double magnitude = std::abs(left) + std::abs(right);
  if (magnitude > detail::underflow_guard && std::abs(det) > detail::orient2d_bound * magnitude)
    return detail::sign_of(det);
  return detail::orient2d_exact(ax, ay, bx, by, cx, cy);
}

/// orient2d after dropping coordinate `axis`.
inline Sign orient2d_dropping(int axis, const Vec3& a, const Vec3& b, const Vec3& c) {
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  return orient2d(a[i], a[j], b[i], b[j], c[i], c[j]);
}

/// Coordinate whose dropping keeps the triangle's area nonzero, or -1 where the three points are collinear.
int projection_axis(const Vec3& a, const Vec3& b, const Vec3& c);

/// True where the three points lie on one line (or coincide).
inline bool collinear(const Vec3& a, const Vec3& b, const Vec3& c) {
  return projection_axis(a, b, c) < 0;
}

/// Order of positions by x, then y, then z. Along a line it is the order along the line.
inline bool lexicographic_less(const Vec3& a, const Vec3& b) {
  if (a[0] != b[0]) return a[0] < b[0];
  if (a[1] != b[1]) return a[1] < b[1];
  return a[2] < b[2];
}

}  // namespace unsnarl
