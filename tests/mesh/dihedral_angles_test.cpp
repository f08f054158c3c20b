#include "mesh/dihedral_angles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace unsnarl {
namespace {

constexpr double pi = std::numbers::pi;

/// Two faces at the edge from 0 to 1, the second turned by `angle` from the first.
Positions wings(double angle, double scale = 1, Vec3 shift = Vec3::Zero()) {
  Positions x(3, 4);
  x.col(0) = Vec3(0, 0, 0);
  x.col(1) = Vec3(1, 0, 0);
  x.col(2) = Vec3(0.3, 1, 0);
  x.col(3) = Vec3(0.8, std::cos(angle), std::sin(angle));
  return (scale * x).colwise() + shift;
}
const std::vector<Triangle> two = {{0, 1, 2}, {1, 0, 3}};

TEST(DihedralAngles, are_those_between_the_faces) {
  const std::vector<Hinge> hinges = hinges_of(two);
  ASSERT_EQ(hinges.size(), 1u);
  for (const double angle : {1e-7, 0.01, 1.0, pi / 2, 2.5, pi}) {
    for (const double scale : {1e-20, 1.0, 1e20}) {
      const Positions x = wings(angle, scale);
      const HingeAngle rounded = hinge_angle(x, hinges[0]);
      EXPECT_NEAR(rounded.radians, angle, rounded.error);
      EXPECT_LT(rounded.error, 1e-13);
      EXPECT_NEAR(*exact_hinge_angle(x, hinges[0]), angle, 1e-14);
    }
  }
}

TEST(DihedralAngles, the_bound_holds_against_exact_arithmetic_for_needles_too) {
  const std::vector<Hinge> hinges = hinges_of(two);
  for (int i = 1; i < 200; ++i) {
    Positions x = wings(1e-3 * i, 1, Vec3(1000.1, -300.7, 0.01 * i));
    x.col(2) = x.col(0) + 0.4 * (x.col(1) - x.col(0)) + std::pow(10, -0.05 * i) * Vec3(0.1, 0.7, 0.2);
    const HingeAngle rounded = hinge_angle(x, hinges[0]);
    const auto exact = exact_hinge_angle(x, hinges[0]);
    ASSERT_TRUE(exact);
    EXPECT_LE(std::abs(rounded.radians - *exact), rounded.error) << i;
  }
}

TEST(DihedralAngles, faces_without_area_have_none) {
  Positions x = wings(1);
  x.col(2) = x.col(1);
  EXPECT_FALSE(exact_hinge_angle(x, hinges_of(two)[0]));
  EXPECT_TRUE(std::isinf(hinge_angle(x, hinges_of(two)[0]).error));
  EXPECT_EQ(smallest_angle(x, hinges_of(two)).hinge, -1);
}

TEST(DihedralAngles, every_two_faces_at_an_edge_count_but_duplicates) {
  Positions x(3, 5);
  x.leftCols(4) = wings(0.5);
  x.col(4) = Vec3(0.5, std::cos(0.4), std::sin(0.4));
  const std::vector<Triangle> three = {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}, {1, 2, 0}};
  const std::vector<Hinge> hinges = hinges_of(three);
  const SmallestAngle smallest = smallest_angle(x, hinges);
  ASSERT_GE(smallest.hinge, 0);
  EXPECT_NEAR(smallest.radians, 0.1, 1e-14);
  EXPECT_EQ(hinges[smallest.hinge].first, 1);
  EXPECT_EQ(hinges[smallest.hinge].second, 2);
}

}  // namespace
}  // namespace unsnarl
