#include "applications/isotopy/shrink_to_triangles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "oracle/crossings_by_brute_force.h"

namespace unsnarl {
namespace {

const std::function<bool()> never = [] { return false; };

Points2 points(const std::vector<double>& numbers) {
  return Eigen::Map<const Points2>(numbers.data(), 2, static_cast<Eigen::Index>(numbers.size() / 2));
}

/// Between each two rings and at them nothing crosses.
void expect_simple(const Stack& stack) {
  for (std::size_t k = 0; k < stack.rungs.size(); ++k)
    for (const double t : {0.0, 0.5, 1.0}) {
      std::vector<Curve> curves;
      for (std::size_t c = 0; c < stack.rings[k].size(); ++c) {
        const Points2 &lower = stack.rings[k][c], &upper = stack.rings[k + 1][c];
        Curve& curve = curves.emplace_back();
        curve.closed = true;
        const Points2& ring = t < 0.5 ? lower : upper;
        if (t != 0.5) curve.points.assign(ring.data(), ring.data() + ring.size());
        for (const Rung& rung : stack.rungs[k][c])
          for (int axis = 0; t == 0.5 && axis < 2; ++axis)
            curve.points.push_back(0.5 * (lower(axis, rung.lower) + upper(axis, rung.upper)));
      }
      EXPECT_EQ(oracle::count_crossings(curves, {}), 0U) << k << " " << t;
    }
}

void expect_triangles(const TrianglesWay& way, const Polygons& polygons) {
  ASSERT_EQ(way.corners.size(), way.stack.rings.size());
  EXPECT_EQ(way.stack.rings.front().size(), polygons.size());
  for (std::size_t c = 0; c < polygons.size(); ++c) {
    EXPECT_EQ(way.stack.rings.front()[c], polygons[c]);
    EXPECT_EQ(way.stack.rings.back()[c].cols(), 3);
    EXPECT_EQ(way.corners.back()[c].size(), 3U);
    // Rings of the way only lose points.
    for (std::size_t k = 0; k + 1 < way.corners.size(); ++k)
      EXPECT_TRUE(std::includes(way.corners[k][c].begin(), way.corners[k][c].end(), way.corners[k + 1][c].begin(),
                                way.corners[k + 1][c].end()));
  }
  expect_simple(way.stack);
}

TEST(ShrinkToTriangles, a_spiral_keeps_its_corners_where_general_position_puts_them) {
  std::vector<double> outer, inner;
  for (int k = 0; k <= 40; ++k) {
    const double angle = 2 * std::numbers::pi * k / 20, r = 1 + 0.1 * k;
    outer.insert(outer.end(), {(r + 0.5) * std::cos(angle), (r + 0.5) * std::sin(angle)});
    inner.insert(inner.begin(), {r * std::cos(angle), r * std::sin(angle)});
  }
  outer.insert(outer.end(), inner.begin(), inner.end());
  const Polygons spiral{points(outer)};
  const std::vector<Index> parent{-1};
  const std::vector<double> sides{1};
  const TrianglesWay way = shrink_to_triangles(spiral, parent, sides, never);
  expect_triangles(way, spiral);
  ASSERT_EQ(way.corners[1][0].size(), static_cast<std::size_t>(spiral[0].cols()));
  const Points2& there = way.stack.rings[1][0];
  EXPECT_LT((there - spiral[0]).colwise().norm().maxCoeff(), 0.02 * 0.5);  // the band is 0.5 wide
  for (std::size_t k = 1; k < way.corners.size(); ++k)
    for (std::size_t i = 0; i < way.corners[k][0].size(); ++i)
      EXPECT_EQ(Vec2(way.stack.rings[k][0].col(static_cast<Index>(i))), Vec2(there.col(way.corners[k][0][i])));
}

TEST(ShrinkToTriangles, what_lies_in_the_arms_of_a_letter_is_gathered) {
  // A clockwise letter U with a square at both ends and one at the bottom, which holds a triangle.
  const Polygons polygons{points({0, 0, 0, 20, 4, 20, 4, 4, 16, 4, 16, 20, 20, 20, 20, 0}),
                          points({1, 17, 3, 17, 3, 19, 1, 19}), points({17, 17, 19, 17, 19, 19, 17, 19}),
                          points({9, 1, 11, 1, 11, 3, 9, 3}), points({9.5, 1.5, 10.5, 1.5, 10, 2})};
  const std::vector<Index> parent{-1, 0, 0, 0, 3};
  const std::vector<double> sides{-1, 1, 1, 1, 1};
  const TrianglesWay way = shrink_to_triangles(polygons, parent, sides, never);
  expect_triangles(way, polygons);
}

}  // namespace
}  // namespace unsnarl
