#include "applications/isotopy/circles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "oracle/crossings_by_brute_force.h"

namespace unsnarl {
namespace {

Points2 triangle(std::initializer_list<double> numbers) {
  Points2 p(2, 3);
  std::copy(numbers.begin(), numbers.end(), p.data());
  return p;
}

std::size_t crossings_between(const Polygons& lower, const Polygons& upper, double t) {
  std::vector<Curve> curves;
  for (std::size_t c = 0; c < lower.size(); ++c) {
    const Points2 p = (1 - t) * lower[c] + t * upper[c];
    curves.push_back({.points = {p.data(), p.data() + p.size()}, .closed = true, .fixed = {}, .name = {}});
  }
  return oracle::count_crossings(curves, {});
}

TEST(Circles, the_incircle_touches_all_sides) {
  const Incircle circle = incircle_of({0, 0}, {4, 0}, {0, 3});
  EXPECT_EQ(circle.middle, Vec2(1, 1));
  EXPECT_EQ(circle.radius, 1);
}

TEST(Circles, triangles_in_triangles_become_circles_in_circles_without_a_crossing) {
  // A needle, which is clockwise, holds a triangle, which holds another one and stands beside a fourth.
  const Polygons triangles{triangle({0, 0, 40, 6, 100, 0}), triangle({35, 1, 46, 1, 41, 5}),
                           triangle({40, 2, 42, 2, 41, 3}), triangle({60, 1, 62, 1, 61, 2})};
  const std::vector<Index> parent{-1, 0, 1, 0};
  const std::vector<double> sides{-1, 1, 1, 1};
  const int count = 16;
  const CirclesWay way = make_circles(triangles, parent, sides, count);
  ASSERT_GE(way.rings.size(), 4U);
  for (std::size_t k = 0; k < way.rings.size(); ++k)
    for (const double t : {0.0, 0.25, 0.5, 0.75})
      EXPECT_EQ(crossings_between(way.rings[k], way.rings[std::min(k + 1, way.rings.size() - 1)], t), 0U)
          << k << " " << t;

  std::vector<Vec2> middles;
  std::vector<double> radii;
  for (std::size_t c = 0; c < triangles.size(); ++c) {
    // The corners of the triangle are points of the first ring.
    for (Index corner = 0; corner < 3; ++corner)
      EXPECT_EQ((way.rings.front()[c].colwise() - triangles[c].col(corner)).colwise().squaredNorm().minCoeff(), 0);
    const Points2& last = way.rings.back()[c];
    ASSERT_EQ(last.cols(), count);
    middles.emplace_back(last.rowwise().mean());
    radii.push_back((last.col(0) - middles.back()).norm());
    EXPECT_GT(radii.back(), 0);
    const double edge = (last.col(1) - last.col(0)).norm();
    for (Index k = 0; k < count; ++k) {
      const Vec2 a = last.col(k) - middles.back(), b = last.col((k + 1) % count) - middles.back();
      EXPECT_NEAR(a.norm(), radii.back(), 1e-9 * radii.back());
      EXPECT_NEAR((b - a).norm(), edge, 1e-9 * radii.back());
      EXPECT_GT(sides[c] * (a.x() * b.y() - a.y() * b.x()), 0);
    }
  }
  for (std::size_t c = 1; c < triangles.size(); ++c)
    EXPECT_LT((middles[c] - middles[parent[c]]).norm() + radii[c], 0.5 * radii[parent[c]]);
}

}  // namespace
}  // namespace unsnarl
