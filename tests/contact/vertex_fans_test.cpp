#include "contact/vertex_fans.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "contact/intersection_finder.h"

namespace unsnarl {
namespace {

/// A fan around vertex 0: its other vertices are 1, 2, ... in order.
std::vector<Triangle> fan(Index size, bool closed) {
  std::vector<Triangle> triangles;
  for (Index k = 1; k < size; ++k) triangles.push_back({k, k + 1, 0});
  if (closed) triangles.push_back({0, size, 1});
  return triangles;
}

Positions circle(Index size, double turn) {
  Positions x(3, size + 1);
  x.col(0) = Vec3(0.1, -0.2, 0.3);
  for (Index k = 0; k < size; ++k)
    x.col(k + 1) = x.col(0) + Vec3(std::cos(turn * k / size), std::sin(turn * k / size), 0.1 * (k % 2));
  return x;
}

bool unfolded(const std::vector<Triangle>& triangles, const Positions& x) {
  VertexFans fans(triangles, static_cast<Index>(triangles.size()), static_cast<Index>(x.cols()));
  fans.update(x);
  return fans.is_unfolded(0);
}

constexpr double once = 2 * std::numbers::pi;

TEST(VertexFans, once_around_is_unfolded_from_any_side) {
  for (const bool closed : {true, false}) {
    const Positions x = circle(6, once);
    EXPECT_TRUE(unfolded(fan(6, closed), x));
    EXPECT_TRUE(unfolded(fan(6, closed), x.colwise().reverse()));
    Positions mirrored = x;
    mirrored.row(1) *= -1;
    EXPECT_TRUE(unfolded(fan(6, closed), mirrored));
  }
}

TEST(VertexFans, twice_around_is_not) {
  EXPECT_FALSE(unfolded(fan(9, true), circle(9, 2 * once)));
  EXPECT_FALSE(unfolded(fan(9, false), circle(9, 2 * once)));
}

TEST(VertexFans, an_open_fan_may_go_nearly_once_around_but_not_meet_itself) {
  for (int begin = 0; begin < 12; ++begin) {  // where it begins makes no difference
    for (const double turn : {0.97 * once, 1.03 * once}) {
      Positions x(3, 9);
      x.col(0).setZero();
      for (Index k = 0; k < 8; ++k) {
        const double angle = begin * once / 12 + turn * k / 7;
        x.col(k + 1) = Vec3(std::cos(angle), std::sin(angle), 0);
      }
      EXPECT_EQ(unfolded(fan(8, false), x), turn < once) << begin;
    }
  }
}

TEST(VertexFans, what_is_no_single_fan_is_not_unfolded) {
  const Positions x = circle(6, once);
  std::vector<Triangle> turned = fan(6, true);
  std::swap(turned[2][0], turned[2][1]);
  EXPECT_FALSE(unfolded(turned, x));
  std::vector<Triangle> twice = fan(6, true);
  twice.push_back(twice[0]);
  EXPECT_FALSE(unfolded(twice, x));
  std::vector<Triangle> in_two = fan(6, true);
  in_two.erase(in_two.begin() + 4);
  in_two.erase(in_two.begin() + 1);
  EXPECT_FALSE(unfolded(in_two, x));
}

// Tiny integers: flat, folded, degenerate and touching fans dominate.
TEST(VertexFans, no_pair_of_an_unfolded_fan_intersects) {
  std::mt19937 random(7);
  int found[2] = {0, 0};
  for (int round = 0; round < 20000; ++round) {
    const Index size = 3 + static_cast<Index>(random() % 4);
    const int extent = 2 + static_cast<int>(random() % 6);
    const auto triangles = fan(size, random() % 2 != 0);
    Positions x(3, size + 1);
    for (Index v = 0; v <= size; ++v)
      for (int k = 0; k < 3; ++k) x(k, v) = static_cast<int>(random() % extent) - (k == 2 ? 0.25 : 0.5) * extent;
    if (round % 2) {  // sorted around the vertex: unfolded more often
      const double turn = once / size;
      for (Index v = 1; v <= size; ++v)
        x.col(v) = x.col(0) + Vec3(std::round(4 * std::cos(turn * v)), std::round(4 * std::sin(turn * v)), x(2, v));
    }
    bool intersecting = false;
    PairClass kind;
    for (std::size_t i = 0; i < triangles.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) intersecting |= intersects(x, triangles[i], triangles[j], kind);
    const bool is_unfolded = unfolded(triangles, x);
    ++found[is_unfolded];
    ASSERT_FALSE(is_unfolded && intersecting) << x;
  }
  EXPECT_GT(found[0], 1000);
  EXPECT_GT(found[1], 1000);
}

}  // namespace
}  // namespace unsnarl
