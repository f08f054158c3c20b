#include "scene/scene.h"

#include <gtest/gtest.h>

#include "scene/shapes.h"

namespace unsnarl {
namespace {

TEST(Scene, starts_at_rest_with_nothing_fixed) {
  const shapes::Shape shape = shapes::bumpy_sheet(2, 0.3);
  const Scene scene = make_scene(shape.positions(), shape.triangles, {});
  EXPECT_EQ(scene.vertex_count(), 9);
  EXPECT_EQ(scene.triangle_count(), 8);
  EXPECT_TRUE(scene.x == scene.rest);
  EXPECT_EQ(scene.fixed, std::vector<std::uint8_t>(9, 0));
  ASSERT_EQ(scene.triangles_of_vertex.size(), 9);
  EXPECT_EQ(scene.triangles_of_vertex[4].size(), 6u);
  EXPECT_EQ(scene.neighbours[0].size(), 3u);  // two along the border, one over the diagonal
  EXPECT_EQ(scene.neighbours[8].size(), 3u);
  EXPECT_EQ(scene.neighbours[2].size(), 2u);
}

}  // namespace
}  // namespace unsnarl
