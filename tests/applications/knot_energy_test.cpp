#include "applications/knots/knot_energy.h"

#include <gtest/gtest.h>

#include <numbers>

#include "applications/knots/knot_path.h"
#include "applications/knots/relax_knot.h"

namespace unsnarl {
namespace {

Positions knot(const char* name, Index n) {
  return densified(points_of(knot_of_table(name).components[0]), n).points;
}

TEST(KnotEnergy, gradient_is_that_of_finite_differences) {
  // Resampled coarsely, so that strands are within reach of the barrier.
  for (const char* name : {"goeritz", "3_1", "kinks_6"}) {
    const Positions x = knot(name, 0);
    KnotEnergy energy;
    Positions gradient;
    const double value = energy(x, gradient);
    EXPECT_EQ(energy(x), value);
    for (Index k = 0; k < x.cols(); k += 37)
      for (int axis = 0; axis < 3; ++axis) {
        const double h = 1e-6;
        Positions y = x, z = x;
        y(axis, k) += h, z(axis, k) -= h;
        const double slope = (energy(y) - energy(z)) / (2 * h);
        EXPECT_NEAR(gradient(axis, k), slope, 1e-5 * gradient.cwiseAbs().maxCoeff()) << name << " " << k;
      }
  }
}

TEST(KnotEnergy, size_place_and_direction_do_not_matter) {
  const Positions x = knot("4_1", 150);
  const KnotEnergy energy;
  const double value = energy(x);
  EXPECT_NEAR(energy(Positions((7 * x).colwise() + Vec3(3, 4, 5))), value, 1e-9 * value);
  EXPECT_NEAR(energy(Positions(x.rowwise().reverse())), value, 1e-9 * value);
  EXPECT_NEAR(energy(Positions(Eigen::AngleAxisd(1, Vec3(1, 2, 2) / 3).toRotationMatrix() * x)), value, 1e-9 * value);
}

TEST(KnotMetric, is_positive) {
  const Positions x = knot("3_1", 100);
  const KnotMetric metric(x, KnotEnergy().evenness);
  Positions v = Positions::Zero(3, x.cols());
  for (Index k = 0; k < x.cols(); ++k) {
    v.setZero();
    v(k % 3, k) = 1;
    EXPECT_GT(v.cwiseProduct(metric.solve(v)).sum(), 0);
  }
}

TEST(RelaxKnot, one_knot_comes_to_rest_with_one_energy) {
  const auto never = [] { return false; };
  const RelaxedKnot a = relax_knot(knot("3_1", 200), {}, never);
  const RelaxedKnot b =
      relax_knot(densified(points_of(parse_link("braid 3: -1 -1 -1 -2").components[0]), 200).points, {}, never);
  EXPECT_TRUE(a.at_rest && b.at_rest);
  EXPECT_NEAR(a.energy, b.energy, 1e-4 * a.energy);
  for (std::size_t k = 1; k < a.states.size(); ++k) EXPECT_TRUE(is_proven_way(a.states[k - 1], a.states[k]));
}

}  // namespace
}  // namespace unsnarl
