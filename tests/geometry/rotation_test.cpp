#include "geometry/rotation.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

namespace unsnarl {
namespace {

const Vec3 some_axis = Vec3(1, -2, 0.5).normalized();

TEST(rotation, is_that_of_eigen) {
  for (const double angle : {-3.0, -0.2, 1e-9, 0.7, 3.1, 8.0}) {
    const Eigen::Matrix3d expected = Eigen::AngleAxisd(angle, some_axis).toRotationMatrix();
    EXPECT_LT((rotation_about(some_axis, angle) - expected).norm(), 1e-15) << angle;
    EXPECT_LT((rotation_by(angle * some_axis) - expected).norm(), 1e-15) << angle;
  }
  EXPECT_EQ(rotation_by(Vec3::Zero()), Eigen::Matrix3d::Identity());
}

TEST(rotation, its_vector_gives_it_back) {
  for (const double angle : {1e-9, 0.01, 1.0, 3.0, std::numbers::pi - 1e-6}) {
    const Vec3 w = angle * some_axis;
    EXPECT_LT((rotation_vector(rotation_by(w)) - w).norm(), 1e-9) << angle;
  }
  EXPECT_EQ(rotation_vector(Eigen::Matrix3d::Identity()), Vec3::Zero());
}

TEST(rotation, the_nearest_to_a_matrix_has_the_largest_trace_with_it) {
  Eigen::Matrix3d m;
  m << 2, 0.3, -1, 0.1, 1, 0.5, 0.7, -0.2, 3;
  for (const double mirrored : {1.0, -1.0}) {
    m.col(2) *= mirrored;
    const Eigen::Matrix3d nearest = nearest_rotation(m);
    EXPECT_NEAR(nearest.determinant(), 1, 1e-12);
    const double trace = (nearest.transpose() * m).trace();
    for (int k = 0; k < 3; ++k)
      for (const double step : {-0.1, 0.1})
        EXPECT_LT(((nearest * rotation_by(step * Vec3::Unit(k))).transpose() * m).trace(), trace);
  }
}

}  // namespace
}  // namespace unsnarl
