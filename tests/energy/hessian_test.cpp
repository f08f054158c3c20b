#include "energy/hessian.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

namespace unsnarl {
namespace {

/// One vertex of mass 1, held by springs along directions.
Hessian one_vertex(const std::vector<std::pair<Vec3, double>>& springs) {
  Hessian result;
  HessianTerms& terms = result.begin(1)[0];
  terms.diagonals.push_back({7, 1});
  for (const auto& [direction, stiffness] : springs) {
    HessianTerms::RankOne& term = terms.rank_ones.emplace_back();
    term.vertices[0] = 7;
    term.g.col(0) = direction;
    term.stiffness = stiffness;
  }
  std::vector<Index> slot(8, -1);
  slot[7] = 0;
  result.assemble(slot, 1);
  return result;
}

TEST(Hessian, blocks_are_inverted) {
  const Hessian springs = one_vertex({{Vec3(1, 0, 0), 3}, {Vec3(0, 1, 1), 2}});
  std::vector<Eigen::Matrix3d> inverse;
  springs.inverse_blocks(inverse);
  Eigen::Matrix3Xd image(3, 1);
  for (int k = 0; k < 3; ++k) {
    springs.apply(inverse[0].col(k), image);
    EXPECT_LT((image - Vec3::Unit(k)).norm(), 1e-9);
  }
}

// As of faces that have collapsed: all but one direction is lost to round-off.
TEST(Hessian, inverses_of_stiff_blocks_are_positive_definite) {
  const Vec3 direction = Vec3(0.3, -0.7, 0.65).normalized();
  for (const double stiffness : {1e10, 1e16, 1e20, 1e30}) {
    std::vector<Eigen::Matrix3d> inverse;
    one_vertex({{direction, stiffness}, {Vec3(direction + 1e-9 * Vec3::UnitX()), 0.3 * stiffness}})
        .inverse_blocks(inverse);
    EXPECT_EQ(inverse[0].llt().info(), Eigen::Success) << stiffness;
  }
}

TEST(Hessian, vertices_that_do_not_move_are_left_out) {
  Hessian result;
  HessianTerms& terms = result.begin(1)[0];
  terms.diagonals = {{0, 2}, {1, 5}};
  HessianTerms::RankOne& term = terms.rank_ones.emplace_back();
  term.vertices = {0, 1, -1, -1};
  term.g.col(0) = Vec3(1, 0, 0);
  term.g.col(1) = Vec3(-1, 0, 0);
  term.stiffness = 3;
  const std::vector<Index> slot = {-1, 0};
  result.assemble(slot, 1);
  Eigen::Matrix3Xd image(3, 1);
  result.apply(Vec3(1, 1, 0), image);
  EXPECT_EQ(image, Eigen::Matrix3Xd(Vec3(8, 5, 0)));
}

TEST(Hessian, terms_over_many_vertices_leave_out_those_that_do_not_move) {
  Hessian hessian;
  HessianTerms& terms = hessian.begin(1)[0];
  terms.diagonals = {{0, 1}, {2, 1}, {4, 1}};
  HessianTerms::Dense& term = terms.dense.emplace_back();
  term.vertices = {0, 1, 2, 3, 4};
  term.g.resize(3, 5);
  term.g << 1, 2, 3, 4, 5, 0, 0, 1, 0, 0, 0, 0, 0, 0, -1;
  term.stiffness = 2;
  const std::vector<Index> slot = {-1, -1, 1, -1, 0};
  hessian.assemble(slot, 2);
  Eigen::VectorXd g(6);
  g << 5, 0, -1, 3, 1, 0;
  const Eigen::MatrixXd expected = Eigen::MatrixXd::Identity(6, 6) + 2 * g * g.transpose();
  Eigen::Matrix3Xd unit(3, 2), image(3, 2);
  for (Index k = 0; k < 6; ++k) {
    unit.setZero();
    unit(k % 3, k / 3) = 1;
    hessian.apply(unit, image);
    EXPECT_EQ(Eigen::VectorXd(image.reshaped()), Eigen::VectorXd(expected.col(k)));
  }
  std::vector<Eigen::Matrix3d> inverse;
  hessian.inverse_blocks(inverse);
  EXPECT_LT((inverse[0] * expected.topLeftCorner(3, 3) - Eigen::Matrix3d::Identity()).norm(), 1e-9);
}

TEST(Hessian, its_lower_triangle_is_that_of_what_it_applies) {
  Hessian hessian;
  const std::span<HessianTerms> parts = hessian.begin(2);
  parts[0].diagonals = {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 5}};
  HessianTerms::Strain& strain = parts[0].strains.emplace_back();
  strain.vertices = {3, 1, 0};
  strain.rotation << 0.6, 0, 0, 1, 0.8, 0;
  Eigen::Matrix<double, 2, 3> rest_edges;
  rest_edges << 1, -0.7, -0.3, 0, 0.9, -0.9;
  strain.turn = HessianTerms::Strain::turn_of(rest_edges);
  strain.stiffness = 3;
  strain.uniform = 0.2;
  HessianTerms::RankOne& contact = parts[1].rank_ones.emplace_back();
  contact.vertices = {4, 0, 2, 1};
  contact.g << 1, -2, 0.5, 0, 3, 0.1, -1, 0, 0, 2, 1, -0.4;
  contact.stiffness = 1.5;
  HessianTerms::Dense& volume = parts[1].dense.emplace_back();
  volume.vertices = {0, 2, 3, 4};
  volume.g.resize(3, 4);
  volume.g << 1, 2, 3, 4, 0, -1, 1, 0, 0.5, 0, 0, -1;
  volume.stiffness = 2;
  const std::vector<Index> slot = {2, 0, -1, 1, 3};
  hessian.assemble(slot, 4);
  const Eigen::MatrixXd lower = hessian.lower_triangle();
  EXPECT_TRUE(lower.isLowerTriangular());
  const Eigen::MatrixXd whole = lower.selfadjointView<Eigen::Lower>();
  Eigen::Matrix3Xd unit(3, 4), image(3, 4);
  for (Index k = 0; k < 12; ++k) {
    unit.setZero();
    unit(k % 3, k / 3) = 1;
    hessian.apply(unit, image);
    EXPECT_LT((image.reshaped() - whole.col(k)).norm(), 1e-13) << k;
  }
}

}  // namespace
}  // namespace unsnarl
