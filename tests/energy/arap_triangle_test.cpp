#include "energy/arap_triangle.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "energy/energy_checks.h"

namespace unsnarl {
namespace {

const std::vector<Triangle> fan = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}};

TEST(ArapTriangle, gradient_agrees_with_finite_differences) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const Positions rest = random_positions(seed, 5);
    const Positions x = rest + 0.4 * random_positions(seed + 100, 5);
    const ArapTriangle energy(rest, fan);
    EXPECT_GT(total_value(energy, x), 0);
    expect_derivatives(energy, x, 1e-6, 1e-7);
  }
}

TEST(ArapTriangle, slivers_and_segments_at_rest_are_harmless) {
  Positions rest(3, 5);
  rest << 0, 1, 2, 3, 1.5,  //
      0, 0, 0, 1e-9, 0,     //
      0, 0, 0, 0, 0;
  const Positions x = rest + 0.2 * random_positions(3, 5);
  const ArapTriangle energy(rest, fan);
  const Linearised at = linearise_all(energy, x, 1);
  EXPECT_TRUE(std::isfinite(at.value));
  EXPECT_LT(at.gradient.cwiseAbs().maxCoeff(), 10);
  expect_derivatives(energy, x, 1e-6, 1e-6);
  const ArapTriangle points(Positions::Zero(3, 5), fan);
  EXPECT_TRUE(std::isfinite(total_value(points, x)));
}

TEST(ArapTriangle, rigid_motion_costs_nothing) {
  const Positions rest = random_positions(7, 5);
  const ArapTriangle energy(rest, fan);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(2.5, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  const Positions x = (turn * rest).colwise() + Vec3(3, 4, 5);
  const Linearised at = linearise_all(energy, x, 1);
  EXPECT_LT(at.value, 1e-25);
  EXPECT_LT(at.gradient.cwiseAbs().maxCoeff(), 1e-12);
}

TEST(ArapTriangle, scales_as_length_squared) {
  const Positions rest = random_positions(8, 5);
  const Positions x = rest + 0.3 * random_positions(9, 5);
  EXPECT_NEAR(total_value(ArapTriangle(3 * rest, fan), 3 * x), 9 * total_value(ArapTriangle(rest, fan), x), 1e-12);
}

TEST(ArapTriangle, hessian_is_exact_at_rest) {
  const Positions rest = random_positions(10, 3);
  const ArapTriangle energy(rest, std::span<const Triangle>(fan).first(1));
  const Eigen::MatrixXd hessian = dense(linearise_all(energy, rest, 3).hessian, 3);
  const Eigen::MatrixXd differences =
      difference_hessian([&](const Positions& x) { return linearise_all(energy, x, 3).gradient; }, rest, 1e-6);
  EXPECT_LT((hessian - differences).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_LT((hessian - hessian.transpose()).norm(), 1e-12);
  const Eigen::VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(hessian).eigenvalues();
  EXPECT_GT(eigenvalues[0], -1e-12);
  EXPECT_LT(eigenvalues[5], 1e-9);  // six rigid motions
  EXPECT_GT(eigenvalues[6], 1e-3);  // three strains
}

TEST(ArapTriangle, damped_hessian_holds_the_rotation) {
  // With the rotation held the energy is w/2 sum |e_k - c_k|^2: w times the Laplacian of the triangle.
  const Positions rest = random_positions(11, 3);
  const ArapTriangle energy(rest, std::span<const Triangle>(fan).first(1), 1);
  Eigen::MatrixXd laplacian = Eigen::MatrixXd::Zero(9, 9);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) laplacian.block<3, 3>(3 * i, 3 * j).diagonal().setConstant(i == j ? 2 : -1);
  const Eigen::MatrixXd hessian = dense(linearise_all(energy, rest, 1).hessian, 3);
  EXPECT_LT((hessian - ArapTriangle::edge_weight * laplacian).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(ArapTriangle, blocks_are_those_of_the_matrix) {
  const Positions rest = random_positions(12, 3), x = random_positions(13, 3);
  const HessianTerms terms =
      linearise_all(ArapTriangle(rest, std::span<const Triangle>(fan).first(1), 0.1), x, 2).hessian;
  const Eigen::MatrixXd hessian = dense(terms, 3);
  for (int k = 0; k < 3; ++k)
    for (int l = 0; l < 3; ++l) {
      const Eigen::Matrix3d block = hessian.block<3, 3>(3 * k, 3 * l);
      EXPECT_LT((terms.strains[0].block(k, l) - block).norm(), 1e-12);
    }
}

}  // namespace
}  // namespace unsnarl
