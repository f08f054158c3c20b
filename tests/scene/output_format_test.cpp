#include "scene/output_format.h"

#include <gtest/gtest.h>

#include "scene/shapes.h"

namespace unsnarl {
namespace {

TEST(Gap, follows_the_format_and_the_vertices_named) {
  Scene scene = shapes::scene_of(shapes::crossing_bumps(6, 0.4));
  const std::vector<Index> here = {0, 1, 2};
  const double single = gap_of_format(scene, here, true, {}), twofold = gap_of_format(scene, here, false, {});
  EXPECT_GT(twofold, 0);
  EXPECT_DOUBLE_EQ(single / twofold, 0x1p29);  // 52 bits against 23
  scene.rest.col(scene.vertex_count() - 1) = Vec3(1e9, 0, 0);
  EXPECT_EQ(gap_of_format(scene, here, true, {}), single) << "a distant vertex counts";
  scene.rest.leftCols(3) *= 1024;
  EXPECT_DOUBLE_EQ(gap_of_format(scene, here, true, {}), 1024 * single);
}

TEST(Gap, float32_is_too_coarse_for_small_edges_far_from_the_origin) {
  const shapes::Shape shape = shapes::crossing_bumps(6, 0.4);
  const std::vector<IntersectingPair> pairs = shapes::pairs_of(shape);
  ASSERT_FALSE(pairs.empty());
  Scene scene = shapes::scene_of(shape);
  EXPECT_TRUE(float32_can_hold(scene, pairs, {}));
  scene.rest.colwise() += Vec3(1e7, 0, 0);
  EXPECT_FALSE(float32_can_hold(scene, pairs, {}));
  scene.rest.colwise() += Vec3(1e200, 0, 0);
  EXPECT_FALSE(float32_can_hold(scene, pairs, {}));
}

}  // namespace
}  // namespace unsnarl
