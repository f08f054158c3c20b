#include "recover/step_operator.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

namespace unsnarl {
namespace {

/// One vertex of mass 1, held by springs along directions.
StepOperator one_vertex(const std::vector<std::pair<Vec3, double>>& springs) {
  StepOperator result;
  result.mass = {1};
  result.row_begin = {0, 1};
  result.column = {0};
  result.entry = {1};
  for (const auto& [direction, stiffness] : springs) {
    StepOperator::RankOne term;
    term.slot = {0, -1, -1, -1};
    term.g.setZero();
    term.g.col(0) = direction;
    term.stiffness = stiffness;
    result.terms.push_back(term);
  }
  return result;
}

TEST(StepOperator, BlocksAreInverted) {
  const StepOperator springs = one_vertex({{Vec3(1, 0, 0), 3}, {Vec3(0, 1, 1), 2}});
  std::vector<Eigen::Matrix3d> inverse;
  springs.inverse_blocks(false, inverse);
  Eigen::Matrix3Xd image(3, 1);
  for (int k = 0; k < 3; ++k) {
    springs.apply(inverse[0].col(k), image);
    EXPECT_LT((image - Vec3::Unit(k)).norm(), 1e-9);
  }
}

// As of faces that have collapsed: all but one direction is lost to round-off.
TEST(StepOperator, InversesOfStiffBlocksArePositiveDefinite) {
  const Vec3 direction = Vec3(0.3, -0.7, 0.65).normalized();
  for (const double stiffness : {1e10, 1e16, 1e20, 1e30}) {
    std::vector<Eigen::Matrix3d> inverse;
    one_vertex({{direction, stiffness}, {Vec3(direction + 1e-9 * Vec3::UnitX()), 0.3 * stiffness}})
        .inverse_blocks(false, inverse);
    EXPECT_EQ(inverse[0].llt().info(), Eigen::Success) << stiffness;
  }
}

}  // namespace
}  // namespace unsnarl
