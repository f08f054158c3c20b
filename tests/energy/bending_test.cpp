#include "energy/bending.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

#include "energy/energy_checks.h"

namespace unsnarl {
namespace {

/// Two unit right triangles over the edge (0, 1), the second bent by `angle`.
Positions bent(double angle) {
  Positions x(3, 4);
  x.col(0) = Vec3(0, 0, 0);
  x.col(1) = Vec3(0, 1, 0);
  x.col(2) = Vec3(-1, 0.5, 0);
  x.col(3) = Vec3(std::cos(angle), 0.5, std::sin(angle));
  return x;
}

double angle_of(const Positions& x) {
  return bending_angle(x.col(0), x.col(1), x.col(2), x.col(3));
}

TEST(Bending, angle_is_signed_and_reaches_both_sides) {
  EXPECT_NEAR(angle_of(bent(0)), 0, 1e-15);
  const double sign = angle_of(bent(0.5)) > 0 ? 1 : -1;
  for (double angle : {-3.1, -2.0, -0.3, 0.2, 1.57, 3.1}) EXPECT_NEAR(sign * angle_of(bent(angle)), angle, 1e-12);
}

TEST(Bending, angle_gradient_agrees_with_finite_differences) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const Positions x = bent(0.6 * static_cast<double>(seed) - 2.7) + 0.1 * random_positions(seed, 4);
    Eigen::Matrix<double, 3, 4> gradient;
    const double angle = bending_angle(x.col(0), x.col(1), x.col(2), x.col(3), gradient);
    EXPECT_DOUBLE_EQ(angle, angle_of(x));
    expect_gradient(angle_of, x, gradient, 1e-6, 1e-7);
  }
}

TEST(Bending, faces_without_area_have_no_gradient) {
  Positions x = bent(0.4);
  x.col(2) = Vec3(0, 0.5, 0);
  Eigen::Matrix<double, 3, 4> gradient;
  bending_angle(x.col(0), x.col(1), x.col(2), x.col(3), gradient);
  EXPECT_TRUE(gradient.isZero(0));
}

TEST(Bending, gradient_agrees_with_finite_differences) {
  const std::vector<Triangle> triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}};
  const std::vector<BendingHinge> hinges = bending_hinges_of(triangles, build_edges(triangles));
  EXPECT_EQ(hinges.size(), 4u);
  const Positions rest = random_positions(1, 5);
  const Positions x = rest + 0.1 * random_positions(2, 5);
  const Bending energy(rest, x, hinges, {});
  expect_derivatives(energy, x, 1e-6, 1e-4 * linearise_all(energy, x, 1).gradient.norm());
}

TEST(Bending, hessian_is_exact_at_rest) {
  const std::vector<BendingHinge> hinges = {{0, 1, 2, 3}};
  const Positions rest = bent(0.3);
  const Bending energy(rest, rest, hinges, {});
  const Eigen::MatrixXd differences =
      difference_hessian([&](const Positions& x) { return linearise_all(energy, x, 2).gradient; }, rest, 1e-6);
  EXPECT_LT((dense(linearise_all(energy, rest, 2).hessian, 4) - differences).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(Bending, invariant_under_rigid_motion_and_scaling) {
  const std::vector<BendingHinge> hinges = {{0, 1, 2, 3}};
  const Positions rest = bent(0.3), x = bent(1.2);
  const double value = total_value(Bending(rest, x, hinges, {}), x);
  EXPECT_GT(value, 0);
  EXPECT_LT(total_value(Bending(rest, rest, hinges, {}), rest), 1e-28);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Vec3(3, -1, 2).normalized()).toRotationMatrix();
  const Positions moved = (turn * x).colwise() + Vec3(1, 2, 3);
  EXPECT_NEAR(total_value(Bending(rest, moved, hinges, {}), moved), value, 1e-12);
  Bending::Options scaled;
  scaled.edge_length = 5;
  EXPECT_NEAR(total_value(Bending(5 * rest, 5 * x, hinges, scaled), 5 * x), value, 1e-12);
}

TEST(Bending, rest_angle_is_taken_on_the_side_of_the_start) {
  // At rest almost folded to one side, at the start almost folded to the other: the nearest way is through the fold.
  const std::vector<BendingHinge> hinges = {{0, 1, 2, 3}};
  const Bending energy(bent(3.0), bent(-3.0), hinges, {});
  const double stiffness = linearise_all(energy, bent(-3.0), 1).hessian.rank_ones[0].stiffness;
  const double residual = 2 * std::numbers::pi - 6;
  EXPECT_NEAR(energy.value(bent(-3.0), 0), 0.5 * stiffness * residual * residual, 1e-12);
}

TEST(Bending, slivers_stay_as_soft_as_ordinary_hinges) {
  Positions thin = bent(0);
  thin(0, 2) = -1e-2;
  const std::vector<BendingHinge> hinges = {{0, 1, 2, 3}};
  const HessianTerms terms = linearise_all(Bending(thin, thin, hinges, {}), thin, 1).hessian;
  EXPECT_LT(terms.rank_ones[0].stiffness * terms.rank_ones[0].g.squaredNorm(), 50);
  thin(0, 2) = -1e-6;
  EXPECT_EQ(Bending(thin, thin, hinges, {}).size(), 0);
}

TEST(Bending, non_manifold_edges_chain_their_triangles) {
  const std::vector<Triangle> book = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}};
  EXPECT_EQ(bending_hinges_of(book, build_edges(book)).size(), 2u);
}

}  // namespace
}  // namespace unsnarl
