#pragma once

#include <span>
#include <vector>

#include "geometry/types.h"

namespace unsnarl {

/// Twice the area times the unit normal.
inline Vec3 area_vector(const Positions& x, const Triangle& t) {
  const Vec3 a = x.col(t[0]), b = x.col(t[1]), c = x.col(t[2]);
  return (b - a).cross(c - a);
}
inline double triangle_area(const Positions& x, const Triangle& t) {
  return 0.5 * area_vector(x, t).norm();
}
/// Unit normal; zero where the triangle has no area.
Vec3 triangle_normal(const Positions& x, const Triangle& t);

std::vector<double> triangle_areas(const Positions& x, std::span<const Triangle> triangles);
/// Sum of the areas of all triangles.
double total_area(const Positions& x, std::span<const Triangle> triangles);

/// Integral over the triangle at rest of the squared distance between x and rest, both linear on it. The motion by area
/// of a surface is the root of the sum of these over its area: a length.
double squared_motion(const Positions& rest, const Positions& x, const Triangle& t);

/// Number of triangles that have exactly no area at x, but had some at rest.
std::size_t count_lost_areas(const Positions& rest, const Positions& x, std::span<const Triangle> triangles);

/// Signed volume between the triangles and a point, positive where their normals point away from it.
double volume_over(const Positions& x, std::span<const Triangle> triangles, const Vec3& point);

/// Signed volume enclosed by the triangles, positive where their normals point outward. Meaningful for closed oriented
/// sets only; taken about the first vertex, so that distance from the origin costs no digits.
double signed_volume(const Positions& x, std::span<const Triangle> triangles);

/// Mean length of the sides of the triangles (an edge of two triangles counts twice); 0 without triangles.
double mean_edge_length(const Positions& x, std::span<const Triangle> triangles);

/// Mean over triangles of the altitude on the longest edge, a length; 0 without triangles.
double mean_least_altitude(const Positions& x, std::span<const Triangle> triangles);

/// Mean side of the equilateral triangles with the same areas; 0 without triangles. Unlike the mean edge it is small
/// for needles, whose length says nothing about how close their neighbours are.
double mean_equilateral_side(const Positions& x, std::span<const Triangle> triangles);

}  // namespace unsnarl
