#include "applications/knots/cylinder_energy.h"

#include <gtest/gtest.h>

#include <random>

#include "applications/knots/knot_path.h"

namespace unsnarl {
namespace {

TEST(CylinderEnergy, gradients_are_those_of_finite_differences) {
  const Positions from = densified(points_of(knot_of_table("3_1").components[0]), 100).points;
  Positions to = from;
  to.row(0) *= -1;
  std::vector<Positions> rings;
  for (int r = 0; r < 6; ++r) rings.push_back((1 - r / 5.0) * from + r / 5.0 * to);
  CylinderEnergy energy(std::move(rings));
  std::mt19937 dice(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Eigen::VectorXd x(energy.size()), direction(energy.size());
  for (Eigen::Index k = 0; k < x.size(); ++k) x[k] = 0.03 * uniform(dice), direction[k] = uniform(dice);
  for (int term = 0; term < 3; ++term) {
    energy.gaussian = term == 0 ? 1 : 0;
    energy.penalty = term == 1 ? 1 : 0;
    energy.membrane = term == 2 ? 1 : 1e-12;
    Eigen::VectorXd gradient, unused;
    EXPECT_GT(energy(x, gradient), 0) << term;
    const double h = 1e-6, slope = (energy(x + h * direction, unused) - energy(x - h * direction, unused)) / (2 * h);
    EXPECT_NEAR(gradient.dot(direction), slope, 1e-6 * std::abs(slope)) << term;
  }
}

TEST(Separation4, is_the_distance_or_the_depth) {
  const Triangle4 a{Vec4(-1, -1, 0, 0), Vec4(2, -1, 0, 0), Vec4(-1, 2, 0, 0)};
  for (const double z : {0.5, 2.0}) {
    // Across a, at a distance of z beyond its corner plane.
    const Triangle4 b{Vec4(0, 0, z, -1), Vec4(0, 0, z + 3, -1), Vec4(0, 0, z, 2)};
    const Separation4 apart = separation_of(a, b);
    EXPECT_NEAR(apart.distance, z, 1e-12);
    EXPECT_NEAR(apart.direction[2], -1, 1e-12);
  }
  const Triangle4 c{Vec4(0, 0, -0.25, -1), Vec4(0, 0, 3, -1), Vec4(0, 0, -0.25, 2)};
  const Separation4 crossing = separation_of(a, c);
  EXPECT_NEAR(crossing.distance, -0.25, 1e-12);  // out over the nearest edge of c
  EXPECT_NEAR(std::abs(crossing.direction[2]), 1, 1e-12);
  double total = 0;
  for (const double w : crossing.weights) total += w;
  EXPECT_NEAR(total, 1, 1e-9);
  // Moved apart by the depth along the direction they touch; by more they are apart.
  for (const double by : {0.2, 0.3}) {
    Triangle4 moved = a;
    for (Vec4& p : moved) p += by * crossing.direction;
    EXPECT_NEAR(separation_of(moved, c).distance, by - 0.25, 1e-9);
  }
}

}  // namespace
}  // namespace unsnarl
