#include "applications/knots/moving_polygon.h"

#include <gtest/gtest.h>

#include <numbers>

#include "applications/knots/strip.h"

namespace unsnarl {
namespace {

Positions circle(Index n, double radius, const Vec3& centre) {
  Positions x(3, n);
  for (Index k = 0; k < n; ++k) {
    const double angle = 2 * std::numbers::pi * k / n;
    x.col(k) = centre + radius * Vec3(std::cos(angle), std::sin(angle), 0);
  }
  return x;
}

/// A polygon with a finger from (2, 0, height) to the middle, and a strand across at z = 0.
Positions finger(double height, double reach) {
  Positions x(3, 8);
  x << 0, 2, 2, reach, 2, 2, 0, 0,    //
      3, 3, 0.2, 0, -0.2, -3, -3, 0,  //
      0, 0, height, height, height, 0, 0, 0;
  return x;
}

TEST(MovingPolygon, motions_of_the_whole_are_proven) {
  const Positions x = circle(40, 1, Vec3::Zero());
  EXPECT_TRUE(stays_simple(x, x));
  EXPECT_TRUE(stays_simple(x, circle(40, 3, {5, 6, 7})));
  EXPECT_TRUE(stays_simple(circle(40, 3, {1e3, 0, 0}), x));
  EXPECT_TRUE(is_isotopy(x, circle(40, 3, {5, 6, 7})));
  // Through a point, to the other side.
  EXPECT_FALSE(stays_simple(x, Positions(-x)));
  EXPECT_FALSE(is_isotopy(x, Positions(-x)));
}

TEST(MovingPolygon, a_strand_that_is_passed_is_found) {
  for (const double reach : {0.5, -0.5}) {
    // Short of the strand the finger may go up and down; beyond it, only one way.
    const Positions above = finger(1, reach), below = finger(-1, reach);
    EXPECT_EQ(stays_simple(above, below), reach > 0) << reach;
    EXPECT_EQ(is_isotopy(above, below), reach > 0) << reach;
    EXPECT_TRUE(stays_simple(above, finger(0.1, reach)));
    EXPECT_TRUE(is_isotopy(above, finger(0.1, reach)));
  }
}

TEST(MovingPolygon, a_touch_is_not_proven) {
  EXPECT_FALSE(stays_simple(finger(1, -0.5), finger(0, -0.5)));
  EXPECT_FALSE(is_isotopy(finger(1, -0.5), finger(0, -0.5)));
  EXPECT_TRUE(stays_simple(finger(1, -0.5), finger(1e-6, -0.5)));
  EXPECT_TRUE(is_isotopy(finger(1, -0.5), finger(1e-300, -0.5)));  // exact: however near
  EXPECT_FALSE(stays_simple(finger(1, -0.5), finger(1e-6, -0.5), 1e-6));
}

TEST(MovingPolygon, an_edge_that_folds_over_is_found) {
  Positions from(3, 5), to;
  from << 0, 4, 4, 2, 0,  //
      0, 0, 4, 6, 4,      //
      0, 0, 0, 0, 0;
  to = from;
  to.col(1) << 0, 2, 0;  // on the edge before
  EXPECT_FALSE(stays_simple(from, to));
  EXPECT_FALSE(is_isotopy(from, to));
}

}  // namespace
}  // namespace unsnarl
