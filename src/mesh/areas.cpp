#include "mesh/areas.h"

#include <algorithm>
#include <cmath>

#include "geometry/predicates.h"

namespace unsnarl {

Vec3 triangle_normal(const Positions& x, const Triangle& t) {
  const Vec3 n = area_vector(x, t);
  const double length = n.norm();
  return length > 0 ? Vec3(n / length) : Vec3::Zero();
}

std::vector<double> triangle_areas(const Positions& x, std::span<const Triangle> triangles) {
  std::vector<double> areas(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) areas[i] = triangle_area(x, triangles[i]);
  return areas;
}

double squared_motion(const Positions& rest, const Positions& x, const Triangle& t) {
  const Vec3 a = x.col(t[0]) - rest.col(t[0]), b = x.col(t[1]) - rest.col(t[1]), c = x.col(t[2]) - rest.col(t[2]);
  const double squares = a.squaredNorm() + b.squaredNorm() + c.squaredNorm() + a.dot(b) + b.dot(c) + c.dot(a);
  return triangle_area(rest, t) * squares / 6;
}

double total_area(const Positions& x, std::span<const Triangle> triangles) {
  double sum = 0;
  for (const Triangle& t : triangles) sum += triangle_area(x, t);
  return sum;
}

std::size_t count_lost_areas(const Positions& rest, const Positions& x, std::span<const Triangle> triangles) {
  auto has_no_area = [](const Positions& y, const Triangle& t) {
    return collinear(Vec3(y.col(t[0])), Vec3(y.col(t[1])), Vec3(y.col(t[2])));
  };
  return static_cast<std::size_t>(std::count_if(triangles.begin(), triangles.end(), [&](const Triangle& t) {
    return has_no_area(x, t) && !has_no_area(rest, t);
  }));
}

double volume_over(const Positions& x, std::span<const Triangle> triangles, const Vec3& point) {
  double sum = 0;
  for (const Triangle& t : triangles) {
    const Vec3 a = x.col(t[0]) - point, b = x.col(t[1]) - point, c = x.col(t[2]) - point;
    sum += a.dot(b.cross(c));
  }
  return sum / 6;
}

double signed_volume(const Positions& x, std::span<const Triangle> triangles) {
  return triangles.empty() ? 0 : volume_over(x, triangles, x.col(triangles[0][0]));
}

double mean_edge_length(const Positions& x, std::span<const Triangle> triangles) {
  if (triangles.empty()) return 0;
  double sum = 0;
  for (const Triangle& t : triangles)
    for (int k = 0; k < 3; ++k) sum += (x.col(t[k]) - x.col(t[(k + 1) % 3])).norm();
  return sum / (3.0 * static_cast<double>(triangles.size()));
}

double mean_least_altitude(const Positions& x, std::span<const Triangle> triangles) {
  double sum = 0;
  for (const Triangle& t : triangles) {
    double longest = 0;
    for (int k = 0; k < 3; ++k) longest = std::max(longest, (x.col(t[k]) - x.col(t[(k + 1) % 3])).norm());
    if (longest > 0) sum += 2 * triangle_area(x, t) / longest;
  }
  return triangles.empty() ? 0 : sum / static_cast<double>(triangles.size());
}

double mean_equilateral_side(const Positions& x, std::span<const Triangle> triangles) {
  /// 2 / 3^(1/4): side of an equilateral triangle over the root of its area (fixed by geometry)
  constexpr double side_per_root_area = 1.5196713713031853;
  double sum = 0;
  for (const Triangle& t : triangles) sum += std::sqrt(triangle_area(x, t));
  return triangles.empty() ? 0 : side_per_root_area * sum / static_cast<double>(triangles.size());
}

}  // namespace unsnarl
