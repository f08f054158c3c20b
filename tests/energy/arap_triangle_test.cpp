#include "energy/arap_triangle.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "energy/finite_differences.h"

namespace unsnarl {
namespace {

const std::vector<Triangle> fan = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}};

TEST(ArapTriangle, GradientAgreesWithFiniteDifferences) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const Positions rest = random_positions(seed, 5);
    const Positions x = rest + 0.4 * random_positions(seed + 100, 5);
    const ArapTriangle energy(rest, fan);
    Positions g = Positions::Zero(3, 5);
    const double value = energy.value_and_gradient(x, 2, g);
    EXPECT_DOUBLE_EQ(value, energy.value(x));
    EXPECT_GT(value, 0);
    expect_gradient([&](const Positions& y) { return 2 * energy.value(y); }, x, g, 1e-6, 1e-7);
  }
}

TEST(ArapTriangle, SliversAndSegmentsAtRestAreHarmless) {
  Positions rest(3, 5);
  rest << 0, 1, 2, 3, 1.5,  //
      0, 0, 0, 1e-9, 0,     //
      0, 0, 0, 0, 0;
  const Positions x = rest + 0.2 * random_positions(3, 5);
  const ArapTriangle energy(rest, fan);
  Positions g = Positions::Zero(3, 5);
  EXPECT_TRUE(std::isfinite(energy.value_and_gradient(x, 1, g)));
  EXPECT_LT(g.cwiseAbs().maxCoeff(), 10);
  expect_gradient([&](const Positions& y) { return energy.value(y); }, x, g, 1e-6, 1e-6);
  const ArapTriangle points(Positions::Zero(3, 5), fan);
  EXPECT_TRUE(std::isfinite(points.value(x)));
}

TEST(ArapTriangle, RigidMotionCostsNothing) {
  const Positions rest = random_positions(7, 5);
  const ArapTriangle energy(rest, fan);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(2.5, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  const Positions x = (turn * rest).colwise() + Vec3(3, 4, 5);
  Positions g = Positions::Zero(3, 5);
  EXPECT_LT(energy.value_and_gradient(x, 1, g), 1e-25);
  EXPECT_LT(g.cwiseAbs().maxCoeff(), 1e-12);
}

TEST(ArapTriangle, ScalesAsLengthSquared) {
  const Positions rest = random_positions(8, 5);
  const Positions x = rest + 0.3 * random_positions(9, 5);
  EXPECT_NEAR(ArapTriangle(3 * rest, fan).value(3 * x), 9 * ArapTriangle(rest, fan).value(x), 1e-12);
}

TEST(ArapTriangle, StrainIsTheHessianAtRest) {
  const Positions rest = random_positions(10, 3);
  const ArapTriangle energy(rest, std::span<const Triangle>(fan).first(1));
  ArapTriangle::Strain strain;
  Eigen::Matrix3d forces;
  energy.linearise(rest, 0, forces, strain);
  const double step = 1e-6;
  Eigen::Matrix<double, 9, 9> hessian;
  for (int k = 0; k < 3; ++k) {
    for (int axis = 0; axis < 3; ++axis) {
      Positions plus = rest, minus = rest;
      plus(axis, k) += step;
      minus(axis, k) -= step;
      Positions gp = Positions::Zero(3, 3), gm = Positions::Zero(3, 3);
      energy.value_and_gradient(plus, 1, gp);
      energy.value_and_gradient(minus, 1, gm);
      const Eigen::Matrix3d difference = (gp - gm) / (2 * step);
      Eigen::Matrix3d unit = Eigen::Matrix3d::Zero();
      unit(axis, k) = 1;
      const Eigen::Matrix3d applied = energy.weight() * strain.apply(unit);
      EXPECT_LT((applied - difference).cwiseAbs().maxCoeff(), 1e-6);
      hessian.col(3 * k + axis) = applied.reshaped();
      EXPECT_LT((energy.weight() * strain.block(k).col(axis) - applied.col(k)).norm(), 1e-12);
    }
  }
  EXPECT_LT((hessian - hessian.transpose()).norm(), 1e-12);
  const Eigen::VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(hessian).eigenvalues();
  EXPECT_GT(eigenvalues[0], -1e-12);
  EXPECT_LT(eigenvalues[5], 1e-9);  // six rigid motions
  EXPECT_GT(eigenvalues[6], 1e-3);  // three strains
}

}  // namespace
}  // namespace unsnarl
