#include "contact/motion_bounds.h"

#include <gtest/gtest.h>

namespace unsnarl {
namespace {

TEST(MotionBounds, allow_the_segment_and_what_is_around_it) {
  MotionBounds bounds;
  bounds.reset(2);
  EXPECT_TRUE(bounds.allow(0, Vec3::Zero()));
  EXPECT_FALSE(bounds.allow(0, Vec3(1e-9, 0, 0)));
  bounds.along.col(1) << 2, 0, 0;
  bounds.around[1] = 0.5;
  EXPECT_TRUE(bounds.allow(1, Vec3(-0.49, 0, 0)));
  EXPECT_TRUE(bounds.allow(1, Vec3(1, 0.3, -0.3)));
  EXPECT_TRUE(bounds.allow(1, Vec3(2.49, 0, 0)));
  EXPECT_FALSE(bounds.allow(1, Vec3(-0.51, 0, 0)));
  EXPECT_FALSE(bounds.allow(1, Vec3(1, 0.4, -0.4)));
  EXPECT_FALSE(bounds.allow(1, Vec3(2.4, 0, 0.4)));
}

TEST(MotionBounds, only_motion_towards_each_other_brings_two_primitives_nearer) {
  // Vertex 0 is 1 above the face (1, 2, 3).
  Positions x(3, 4);
  x << 0.2, 0, 1, 0,  //
      0.2, 0, 0, 1,   //
      1, 0, 0, 0;
  const Stencil s{StencilKind::vertex_face, {0, 1, 2, 3}};
  MotionBounds bounds;
  bounds.reset(4);
  const auto least = [&] { return least_distance(s, x, bounds, closest(s, x).direction); };
  EXPECT_NEAR(least(), 1, 1e-12);
  bounds.along.col(0) << 3, 0, 5;
  EXPECT_NEAR(least(), 1, 1e-12);
  bounds.along.col(0) << 3, 0, -0.25;
  EXPECT_NEAR(least(), 0.75, 1e-12);
  // The vertex may stay where it is, the face come after it.
  bounds.along.row(2).setConstant(0.25);
  EXPECT_NEAR(least(), 0.75, 1e-12);
  bounds.around = {0.1, 0, 0.3, 0.2};
  EXPECT_NEAR(least(), 0.35, 1e-12);
}

}  // namespace
}  // namespace unsnarl
