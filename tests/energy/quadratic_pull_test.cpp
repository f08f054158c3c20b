#include "energy/quadratic_pull.h"

#include <gtest/gtest.h>

#include "energy/energy_checks.h"

namespace unsnarl {
namespace {

TEST(QuadraticPull, vertex_areas_sum_to_the_surface) {
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

TEST(QuadraticPull, gradient_agrees_with_finite_differences) {
  const QuadraticPull energy{{0.5, 2, 1}, random_positions(1, 3)};
  const Positions x = random_positions(2, 3);
  expect_derivatives(energy, x, 1e-6, 1e-8);
  EXPECT_EQ(total_value(energy, energy.rest), 0);
  const QuadraticPull scaled{{0.5, 2, 1}, 3 * energy.rest};
  EXPECT_NEAR(total_value(scaled, 3 * x), 9 * total_value(energy, x), 1e-12);
}

TEST(QuadraticPull, damping_is_in_the_hessian_alone) {
  const QuadraticPull energy{{0.5, 2}, random_positions(1, 2)};
  const QuadraticPull damped{{0.5, 2}, energy.rest, 3};
  const Positions x = random_positions(2, 2);
  const Linearised a = linearise_all(energy, x, 2), b = linearise_all(damped, x, 2);
  EXPECT_EQ(a.gradient, b.gradient);
  const Eigen::VectorXd diagonal = dense(a.hessian, 2).diagonal();
  EXPECT_EQ(diagonal, Eigen::VectorXd((Eigen::VectorXd(6) << 1, 1, 1, 4, 4, 4).finished()));
  EXPECT_LT((dense(b.hessian, 2).diagonal() - 4 * diagonal).norm(), 1e-12);
}

}  // namespace
}  // namespace unsnarl
