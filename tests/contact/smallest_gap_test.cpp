#include "contact/smallest_gap.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace unsnarl {
namespace {

/// So many triangles of size `size`, none near another's vertices, at random places.
struct LooseTriangles {
  Positions x;
  std::vector<Triangle> triangles;
};
LooseTriangles loose_triangles(int count, double size, unsigned seed) {
  std::mt19937 random(seed);
  const auto number = [&random] { return static_cast<double>(random()) / 4294967296.0; };
  LooseTriangles result;
  result.x.resize(3, 3 * count);
  for (int t = 0; t < count; ++t) {
    const Vec3 place(number(), number(), number());
    for (int k = 0; k < 3; ++k) result.x.col(3 * t + k) = place + size * Vec3(number(), number(), number());
    result.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  return result;
}

/// By a grid of points on both, which is never nearer and at most two steps of the grid farther.
double sampled_distance(const Positions& x, const Triangle& s, const Triangle& t, int steps) {
  const auto point = [&](const Triangle& f, int i, int j) -> Vec3 {
    const double u = double(i) / steps, v = double(j) / steps;
    return (1 - u - v) * x.col(f[0]) + u * x.col(f[1]) + v * x.col(f[2]);
  };
  double nearest = 1e300;
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; i + j <= steps; ++j)
      for (int k = 0; k <= steps; ++k)
        for (int l = 0; k + l <= steps; ++l) nearest = std::min(nearest, (point(s, i, j) - point(t, k, l)).norm());
  return nearest;
}

TEST(SmallestGap, is_that_of_the_nearest_two_of_all) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    const LooseTriangles s = loose_triangles(12, 0.05, seed);
    double nearest = 1e300;
    for (std::size_t i = 0; i < s.triangles.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        nearest = std::min(nearest, sampled_distance(s.x, s.triangles[i], s.triangles[j], 12));
    const SmallestGap gap = smallest_gap(s.triangles, s.x);
    EXPECT_LE(gap.distance, nearest);
    EXPECT_GT(gap.distance, nearest - 0.02);
    EXPECT_LT(gap.first, gap.second);
  }
}

/// Every pair is looked at here, so that a branch cut by mistake shows.
TEST(SmallestGap, of_groups_is_that_of_the_nearest_two_of_different_ones) {
  LooseTriangles s = loose_triangles(400, 0.01, 4);
  std::vector<Index> group;
  for (std::size_t t = 0; t < s.triangles.size(); ++t) group.push_back(s.x(0, 3 * static_cast<Index>(t)) < 0.5 ? 0 : 1);
  for (Index v = 0; v < s.x.cols(); ++v)
    if (group[v / 3] == 1) s.x(0, v) += 0.3;
  const SmallestGap gap = smallest_gap(s.triangles, s.x, group);
  double nearest = 1e300;
  for (std::size_t i = 0; i < s.triangles.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (group[i] != group[j]) nearest = std::min(nearest, sampled_distance(s.x, s.triangles[i], s.triangles[j], 2));
  EXPECT_NE(group[gap.first], group[gap.second]);
  EXPECT_GE(gap.distance, 0.3);
  EXPECT_LE(gap.distance, nearest);
  EXPECT_GT(gap.distance, nearest - 0.02);
}

TEST(SmallestGap, looks_as_far_as_it_has_to) {
  Positions x(3, 6);
  x << 0, 1, 0, 0, 1, 0,  //
      0, 0, 1, 0, 0, 1,   //
      0, 0, 0, 500, 500, 500;
  const std::vector<Triangle> triangles = {{0, 1, 2}, {3, 4, 5}};
  EXPECT_DOUBLE_EQ(smallest_gap(triangles, x).distance, 500);
  const std::vector<Index> one_group = {7, 7}, two_groups = {7, 8};
  EXPECT_TRUE(std::isinf(smallest_gap(triangles, x, one_group).distance));
  EXPECT_DOUBLE_EQ(smallest_gap(triangles, x, two_groups).distance, 500);
  const std::vector<Triangle> joined = {{0, 1, 2}, {2, 4, 5}};
  EXPECT_TRUE(std::isinf(smallest_gap(joined, x).distance));
}

TEST(SmallestGap, what_passes_through_each_other_does_not_count) {
  Positions x(3, 9);               // three triangles in planes one above the other, at heights 0, 1 and 3
  x << 0, 1, 0, 0, 1, 0, 0, 1, 0,  //
      0, 0, 1, 0, 0, 1, 0, 0, 1,   //
      0, 0, 0, 1, 1, 1, 3, 3, 3;
  const std::vector<Triangle> triangles = {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}};
  const std::vector<Index> part_of = {0, 1, 2};
  const PassingParts parts(3, std::vector<std::array<Index, 2>>{{0, 1}});
  const SmallestGap gap = smallest_gap(triangles, x, {}, Passing({}, part_of, parts));
  EXPECT_DOUBLE_EQ(gap.distance, 2);
  EXPECT_EQ(gap.first, 1);
}

TEST(SmallestGap, pairs_closer_than_a_distance_are_those_that_measure_less) {
  const LooseTriangles s = loose_triangles(60, 0.05, 5);
  const double distance = 1.5 * smallest_gap(s.triangles, s.x).distance + 0.05;
  const std::vector<std::array<Index, 2>> pairs = pairs_closer_than(s.triangles, s.x, distance);
  std::vector<std::array<Index, 2>> expected;
  for (Index i = 0; i < static_cast<Index>(s.triangles.size()); ++i)
    for (Index j = i + 1; j < static_cast<Index>(s.triangles.size()); ++j) {
      const std::vector<Triangle> two = {s.triangles[i], s.triangles[j]};
      if (smallest_gap(two, s.x).distance < distance) expected.push_back({i, j});
    }
  EXPECT_GT(pairs.size(), 1u);
  EXPECT_EQ(pairs, expected);
  EXPECT_TRUE(pairs_closer_than(s.triangles, s.x, 0).empty());
}

}  // namespace
}  // namespace unsnarl
