#include "rigid/rigid_motion.h"

#include <gtest/gtest.h>

#include <numbers>

#include "geometry/rotation.h"

namespace unsnarl {
namespace {

Positions some_points() {
  Positions points(3, 7);
  points << 0.1, 2, -1, 0.3, 4, 1, 0.7, 1, 0.2, 0.5, -3, 1, 2, 0.9, 0.4, 1, 2, 0.1, -1, 0.6, 3;
  return points;
}

TEST(RigidMotion, the_best_one_is_the_one_that_was_applied) {
  const Positions from = some_points();
  for (const double degrees : {1e-6, 0.5, 40.0, 90.0, 179.9}) {
    const Vec3 axis = Vec3(1, -2, 0.5).normalized(), shift(3, -1, 0.25);
    const Eigen::Matrix3d turn = rotation_by(degrees * std::numbers::pi / 180 * axis);
    const Positions to = (turn * from).colwise() + shift;
    const RigidMotion found = best_rigid_motion(from, to);
    EXPECT_LT((found.rotation - turn).norm(), 1e-12);
    EXPECT_LT((found.translation - shift).norm(), 1e-12);
    EXPECT_NEAR(found.degrees(), degrees, 1e-9);
    EXPECT_LT((found.apply(from.col(3)) - to.col(3)).norm(), 1e-12);
  }
}

TEST(RigidMotion, without_motion_it_is_exactly_the_identity) {
  const RigidMotion none = best_rigid_motion(some_points(), some_points());
  EXPECT_EQ(none.rotation, Eigen::Matrix3d::Identity());
  EXPECT_EQ(none.translation, Vec3::Zero());
  EXPECT_EQ(none.degrees(), 0);
}

TEST(RigidMotion, points_of_weight_0_do_not_count_and_equal_weights_change_nothing) {
  const Positions from = some_points();
  const Eigen::Matrix3d turn = rotation_by(Vec3(0.3, 0.2, -0.9));
  Positions to = (turn * from).colwise() + Vec3(1, 2, 3);
  to.col(2) += Vec3(5, -4, 3);
  Eigen::VectorXd weights = Eigen::VectorXd::Constant(7, 0.7);
  const RigidMotion even = best_rigid_motion(from, to, weights), plain = best_rigid_motion(from, to);
  EXPECT_LT((even.rotation - plain.rotation).norm() + (even.translation - plain.translation).norm(), 1e-12);
  EXPECT_GT((plain.rotation - turn).norm(), 0.1);
  weights[2] = 0;
  EXPECT_LT((best_rigid_motion(from, to, weights).rotation - turn).norm(), 1e-12);
}

TEST(RigidMotion, mirrors_nothing) {
  Positions mirrored = some_points();
  mirrored.row(0) *= -1;
  EXPECT_NEAR(best_rigid_motion(some_points(), mirrored).rotation.determinant(), 1, 1e-12);
}

TEST(RigidMotion, points_in_a_plane_or_on_a_line_will_do) {
  for (const int rank : {1, 2}) {
    Positions from = some_points();
    from.bottomRows(3 - rank).setZero();
    const Positions to = (rotation_by(Vec3(0.3, 0.2, -0.9)) * from).colwise() + Vec3(1, 2, 3);
    const RigidMotion found = best_rigid_motion(from, to);
    EXPECT_LT((((found.rotation * from).colwise() + found.translation) - to).norm(), 1e-12);
    EXPECT_NEAR(found.rotation.determinant(), 1, 1e-12);
  }
}

}  // namespace
}  // namespace unsnarl
