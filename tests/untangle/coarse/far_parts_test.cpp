#include "untangle/coarse/far_parts.h"

#include <gtest/gtest.h>

#include "scene/shapes.h"

namespace unsnarl {
namespace {

/// A flat sheet of 12 x 12 vertices, an edge long each.
Scene sheet() {
  return shapes::scene_of(shapes::grid(11, 11, false, [](double i, double j) { return Vec3(i, j, 0); }));
}

TEST(FarParts, a_scene_at_rest_has_none) {
  const Scene scene = sheet();
  EXPECT_EQ(total_motion(scene), 0);
  EXPECT_TRUE(far_parts(scene, 0, 0).empty());
}

TEST(FarParts, are_connected_and_the_one_that_moved_most_is_first) {
  Scene scene = sheet();
  const Index near = 0, corner = 143, beside = 142;
  scene.x(2, near) += 2;
  scene.x(2, corner) += 2;
  scene.x(2, beside) += 3;
  EXPECT_DOUBLE_EQ(total_motion(scene), 7);
  const std::vector<std::vector<Index>> parts = far_parts(scene, 1, 0.1);
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_EQ(parts[0], (std::vector<Index>{beside, corner}));
  EXPECT_EQ(parts[1], (std::vector<Index>{near}));
}

TEST(FarParts, leaves_out_what_moved_little_or_is_fixed) {
  Scene scene = sheet();
  scene.x(2, 0) += 2;
  scene.x(2, 70) += 0.5;
  scene.x(2, 143) += 20;
  EXPECT_EQ(far_parts(scene, 1, 0.1).size(), 1u);  // the first has less than a tenth of all motion
  scene.fixed[143] = 1;
  EXPECT_DOUBLE_EQ(total_motion(scene), 2.5);
  EXPECT_EQ(far_parts(scene, 1, 0.1), (std::vector<std::vector<Index>>{{0}}));
}

}  // namespace
}  // namespace unsnarl
