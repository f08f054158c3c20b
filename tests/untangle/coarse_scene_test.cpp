#include "untangle/coarse_scene.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "scene/shapes.h"
#include "untangle/conflict_regions.h"

namespace unsnarl {
namespace {

/// The middle of a bumpy sheet, and its rim held.
Patch middle_of_a_sheet(Scene& scene) {
  std::vector<Index> free;
  for (Index v = 0; v < scene.vertex_count(); ++v)
    if (scene.x.col(v).head<2>().cwiseAbs().maxCoeff() < 9.5) free.push_back(v);
  const SceneIndex index(scene);
  Patch patch = cut_patch(scene, index, free, 1);
  patch.edge_length = 1;
  return patch;
}

TEST(CoarseScene, has_far_fewer_triangles_and_holds_what_is_held) {
  Scene scene = shapes::scene_of(shapes::bumpy_sheet(24, 2, 6));
  const Patch patch = middle_of_a_sheet(scene);
  const auto coarse = CoarseScene::of(patch);
  ASSERT_TRUE(coarse.has_value());
  const std::size_t obstacles = patch.triangles.size() - static_cast<std::size_t>(patch.active_count);
  EXPECT_LE(coarse->scene().triangles.size(), obstacles + patch.active_count / 2);
  EXPECT_TRUE(coarse->scene().x == coarse->scene().rest);
  // Every vertex is one of the patch, and fixed where that one is.
  for (Index v = 0; v < coarse->scene().vertex_count(); ++v) {
    Index same = -1;
    for (Index w = 0; w < patch.x.cols(); ++w)
      if (patch.x.col(w) == coarse->scene().x.col(v)) same = w;
    ASSERT_GE(same, 0);
    EXPECT_EQ(coarse->scene().fixed[v] != 0, same >= patch.free_count);
  }
}

TEST(CoarseScene, carries_the_patch_along) {
  Scene scene = shapes::scene_of(shapes::bumpy_sheet(24, 2, 6));
  Patch patch = middle_of_a_sheet(scene);
  const auto coarse = CoarseScene::of(patch);
  ASSERT_TRUE(coarse.has_value());
  const Positions start = patch.x;
  coarse->carry(coarse->scene().rest, patch);
  EXPECT_TRUE(patch.x == start);

  // All one way: what lies between free vertices goes that way, what is held stays, nothing goes farther.
  Positions x = coarse->scene().rest;
  for (Index v = 0; v < x.cols(); ++v)
    if (!coarse->scene().fixed[v]) x(2, v) += 0.5;
  coarse->carry(x, patch);
  std::size_t whole = 0;
  for (Index v = 0; v < patch.x.cols(); ++v) {
    const Vec3 motion = patch.x.col(v) - start.col(v);
    EXPECT_LE(motion[2], 0.5 + 1e-12);
    EXPECT_GE(motion[2], -1e-12);
    EXPECT_EQ(motion.head<2>().norm(), 0);
    if (v >= patch.free_count) {
      EXPECT_EQ(motion.norm(), 0);
    }
    whole += motion[2] > 0.5 - 1e-9;
  }
  EXPECT_GT(whole, static_cast<std::size_t>(patch.free_count) / 2);
}

TEST(CoarseScene, there_is_none_of_what_cannot_be_simplified) {
  Scene scene = shapes::scene_of(shapes::bumpy_sheet(3, 0));
  std::vector<Index> free = {5};
  const SceneIndex index(scene);
  Patch patch = cut_patch(scene, index, free, 1);
  patch.edge_length = 1;
  EXPECT_FALSE(CoarseScene::of(patch).has_value());
}

}  // namespace
}  // namespace unsnarl
