#include "energy/quadratic_pull.h"

#include <algorithm>

namespace unsnarl {

std::vector<double> vertex_areas(const Positions& x, std::span<const Triangle> triangles, double floor_rel) {
  std::vector<double> areas(static_cast<std::size_t>(x.cols()), 0);
  for (const Triangle& t : triangles) {
    const Vec3 ab = x.col(t[1]) - x.col(t[0]);
    const Vec3 ac = x.col(t[2]) - x.col(t[0]);
    const double third = ab.cross(ac).norm() / 6;
    for (Index v : t) areas[v] += third;
  }
  double sum = 0;
  std::size_t count = 0;
  for (double a : areas) {
    sum += a;
    count += a > 0;
  }
  const double floor = count ? floor_rel * sum / static_cast<double>(count) : 1;
  for (double& a : areas) a = std::max(a, floor);
  return areas;
}

}  // namespace unsnarl
