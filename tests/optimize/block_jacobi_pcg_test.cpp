#include "optimize/block_jacobi_pcg.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

namespace unsnarl {
namespace {

Eigen::MatrixXd random_matrix(std::uint64_t seed, int rows, int columns) {
  std::mt19937_64 engine(seed);
  Eigen::MatrixXd m(rows, columns);
  for (double& entry : m.reshaped()) entry = static_cast<double>(engine() >> 11) * 0x1p-52 - 1;
  return m;
}

std::vector<Eigen::Matrix3d> inverse_diagonal_blocks(const Eigen::MatrixXd& a) {
  std::vector<Eigen::Matrix3d> blocks;
  for (Eigen::Index k = 0; k < a.rows(); k += 3) blocks.push_back(a.block<3, 3>(k, k).inverse());
  return blocks;
}

TEST(BlockJacobiPcg, agrees_with_a_direct_solve) {
  const int n = 20;
  const Eigen::MatrixXd r = random_matrix(1, 3 * n, 3 * n);
  const Eigen::MatrixXd a = r * r.transpose() + Eigen::MatrixXd::Identity(3 * n, 3 * n);
  const Eigen::Matrix3Xd b = random_matrix(2, 3, n);
  Eigen::Matrix3Xd x;
  BlockJacobiPcg solver;
  const auto apply = [&](const Eigen::Matrix3Xd& v, Eigen::Matrix3Xd& result) {
    result = (a * v.reshaped()).reshaped(3, n);
  };
  const int steps = solver.solve(apply, inverse_diagonal_blocks(a), b, x, {1e-12, 1000});
  EXPECT_LT(steps, 1000);
  EXPECT_LT((a * x.reshaped() - b.reshaped()).norm(), 1e-8 * b.norm());
}

TEST(BlockJacobiPcg, block_diagonal_systems_take_one_step) {
  const int n = 6;
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(3 * n, 3 * n);
  for (int k = 0; k < 3 * n; k += 3) {
    const Eigen::MatrixXd r = random_matrix(k, 3, 3);
    a.block<3, 3>(k, k) = r * r.transpose() + Eigen::Matrix3d::Identity();
  }
  const Eigen::Matrix3Xd b = random_matrix(3, 3, n);
  Eigen::Matrix3Xd x;
  BlockJacobiPcg solver;
  const auto apply = [&](const Eigen::Matrix3Xd& v, Eigen::Matrix3Xd& result) {
    result = (a * v.reshaped()).reshaped(3, n);
  };
  EXPECT_EQ(solver.solve(apply, inverse_diagonal_blocks(a), b, x, {1e-10, 10}), 1);
}

TEST(BlockJacobiPcg, returns_a_descent_direction_where_the_matrix_is_indefinite) {
  const Eigen::Matrix3Xd b = random_matrix(4, 3, 4);
  Eigen::Matrix3Xd x;
  BlockJacobiPcg solver;
  const std::vector<Eigen::Matrix3d> identity(4, Eigen::Matrix3d::Identity());
  solver.solve([](const Eigen::Matrix3Xd& v, Eigen::Matrix3Xd& result) { result = -v; }, identity, b, x, {1e-3, 10});
  EXPECT_GT(b.cwiseProduct(x).sum(), 0);
}

TEST(BlockJacobiPcg, zero_right_hand_side) {
  Eigen::Matrix3Xd x;
  BlockJacobiPcg solver;
  const std::vector<Eigen::Matrix3d> identity(4, Eigen::Matrix3d::Identity());
  EXPECT_EQ(solver.solve([](const Eigen::Matrix3Xd& v, Eigen::Matrix3Xd& result) { result = v; }, identity,
                         Eigen::Matrix3Xd::Zero(3, 4), x, {}),
            0);
  EXPECT_TRUE(x.isZero(0));
}

}  // namespace
}  // namespace unsnarl
