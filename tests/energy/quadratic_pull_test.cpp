#include "energy/quadratic_pull.h"

#include <gtest/gtest.h>

#include "energy/finite_differences.h"

namespace unsnarl {
namespace {

TEST(QuadraticPull, VertexAreasSumToTheSurface) {
  Positions x(3, 5);
  x << 0, 1, 0, 1, 9,  //
      0, 0, 1, 1, 9,   //
      0, 0, 0, 0, 9;
  const std::vector<Triangle> triangles = {{0, 1, 2}, {1, 3, 2}};
  const std::vector<double> areas = vertex_areas(x, triangles);
  EXPECT_NEAR(areas[0] + areas[1] + areas[2] + areas[3], 1, 1e-15);
  EXPECT_NEAR(areas[1], 1.0 / 3, 1e-15);
  EXPECT_GT(areas[4], 0);  // without a triangle: still pulled a little
  EXPECT_LT(areas[4], 1e-3);
}

TEST(QuadraticPull, GradientAgreesWithFiniteDifferences) {
  const QuadraticPull energy{{0.5, 2, 1}, random_positions(1, 3)};
  const Positions x = random_positions(2, 3);
  Positions g = Positions::Zero(3, 3);
  const double value = energy.value_and_gradient(x, 2, g);
  EXPECT_DOUBLE_EQ(value, energy.value(x));
  expect_gradient([&](const Positions& y) { return 2 * energy.value(y); }, x, g, 1e-6, 1e-8);
  EXPECT_EQ(energy.value(energy.rest), 0);
  const QuadraticPull scaled{{0.5, 2, 1}, 3 * energy.rest};
  EXPECT_NEAR(scaled.value(3 * x), 9 * value, 1e-12);
}

}  // namespace
}  // namespace unsnarl
