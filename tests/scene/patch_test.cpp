#include "scene/patch.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "scene/shapes.h"
#include "untangle/conflict_regions.h"

namespace unsnarl {
namespace {

TEST(Patch, is_a_copy_of_its_part_of_the_scene) {
  Scene scene = shapes::scene_of(shapes::crossing_bumps(10, 0.4));
  for (Index v = 0; v < scene.vertex_count(); ++v) scene.x(0, v) += 0.01 * v;  // no longer at rest
  const SceneIndex index(scene);
  const std::vector<Index> free = {48, 49, 60, 200};
  const double reach = 1.3;
  const Patch patch = cut_patch(scene, index, free, reach);

  ASSERT_EQ(patch.free_count, 4);
  EXPECT_TRUE(std::equal(free.begin(), free.end(), patch.vertices.begin()));
  EXPECT_TRUE(std::is_sorted(patch.vertices.begin() + 4, patch.vertices.end()));
  EXPECT_TRUE(std::is_sorted(patch.faces.begin(), patch.faces.begin() + patch.active_count));
  EXPECT_TRUE(std::is_sorted(patch.faces.begin() + patch.active_count, patch.faces.end()));

  ASSERT_EQ(patch.triangles.size(), patch.faces.size());
  for (std::size_t t = 0; t < patch.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) EXPECT_EQ(patch.vertices[patch.triangles[t][k]], scene.triangles[patch.faces[t]][k]);
  for (std::size_t v = 0; v < patch.vertices.size(); ++v) {
    const Index k = static_cast<Index>(v);
    EXPECT_TRUE(patch.x.col(k) == scene.x.col(patch.vertices[v]));
    const bool is_free = k < patch.free_count;
    EXPECT_TRUE(patch.rest.col(k) == (is_free ? scene.rest : scene.x).col(patch.vertices[v]));
  }

  // Active: exactly those with a free vertex. Obstacles: exactly those others within reach of one, now or at rest.
  std::vector<Index> active, obstacles;
  for (Index t = 0; t < scene.triangle_count(); ++t) {
    const auto is_free = [&](Index v) { return std::binary_search(free.begin(), free.end(), v); };
    if (std::any_of(scene.triangles[t].begin(), scene.triangles[t].end(), is_free)) active.push_back(t);
  }
  for (Index t = 0; t < scene.triangle_count(); ++t) {
    if (std::binary_search(active.begin(), active.end(), t)) continue;
    for (Index a : active) {
      Box box = box_of(scene.x, scene.triangles[a]);
      box.extend(box_of(scene.rest, scene.triangles[a]));
      if (box.inflated(reach).overlaps(box_of(scene.x, scene.triangles[t]))) {
        obstacles.push_back(t);
        break;
      }
    }
  }
  EXPECT_TRUE(std::equal(active.begin(), active.end(), patch.faces.begin(), patch.faces.begin() + patch.active_count));
  EXPECT_TRUE(
      std::equal(obstacles.begin(), obstacles.end(), patch.faces.begin() + patch.active_count, patch.faces.end()));
  EXPECT_FALSE(obstacles.empty());
}

TEST(Patch, pasting_moves_the_free_vertices_and_nothing_else) {
  Scene scene = shapes::scene_of(shapes::crossing_bumps(8, 0.4));
  SceneIndex index(scene);
  const std::vector<Index> free = {30, 31, 40};
  Patch patch = cut_patch(scene, index, free, 1);
  patch.x.array() += 50;  // the fixed ones too: pasting has to leave them where they are
  const Positions before = scene.x;
  paste_patch(patch, scene, index);
  for (Index v = 0; v < scene.vertex_count(); ++v) {
    const bool is_free = std::binary_search(free.begin(), free.end(), v);
    EXPECT_TRUE(scene.x.col(v) == (is_free ? Vec3(before.col(v).array() + 50) : Vec3(before.col(v))));
  }
  const Box there = shapes::box_around({50, 50, 50}, 6);
  EXPECT_EQ(shapes::found_by(index, there), shapes::overlapping(scene, there));
  EXPECT_FALSE(shapes::found_by(index, there).empty());
}

TEST(Patch, its_box_holds_whatever_is_cut_out) {
  const Scene scene = shapes::scene_of(shapes::crossing_bumps(10, 0.4));
  const SceneIndex index(scene);
  const std::vector<Index> free = {48, 60};
  const Patch patch = cut_patch(scene, index, free, 0.9);
  const Box box = patch_box(scene, free, 0.9);
  for (const Triangle& t : patch.triangles) EXPECT_TRUE(box.overlaps(box_of(patch.x, t)));
}

TEST(Patch, what_passes_through_all_of_it_is_no_obstacle) {
  Scene scene = shapes::scene_of(shapes::crossing_bumps(10, 0.4));
  const Index of_sheet = scene.triangle_count() / 2;
  std::vector<Index> free;
  for (const Index v : scene.triangles[of_sheet / 2]) free.push_back(v);
  std::sort(free.begin(), free.end());
  const auto is_obstacle = [&](const Patch& patch, Index sheet) {
    return std::any_of(patch.faces.begin() + patch.active_count, patch.faces.end(),
                       [&](Index t) { return t / of_sheet == sheet; });
  };
  ASSERT_TRUE(is_obstacle(cut_patch(scene, SceneIndex(scene), free, 5), 1));
  const PassingParts parts(2, std::vector<std::array<Index, 2>>{{0, 1}});
  scene.parts = &parts;
  for (Index t = 0; t < scene.triangle_count(); ++t) scene.part_of.push_back(t / of_sheet);
  const Patch patch = cut_patch(scene, SceneIndex(scene), free, 5);
  EXPECT_FALSE(is_obstacle(patch, 1));
  EXPECT_TRUE(is_obstacle(patch, 0));
  ASSERT_EQ(patch.part_of.size(), patch.faces.size());
  // One triangle that may not pass suffices.
  scene.part_of[scene.triangles_of_vertex[free[0]].front()] = 1;
  EXPECT_TRUE(is_obstacle(cut_patch(scene, SceneIndex(scene), free, 5), 1));
}

TEST(Patch, knows_whether_a_solid_is_inside_out) {
  Scene scene = shapes::scene_of(shapes::box({1, 2, 3}));
  scene.solids = {.list = {{6, 22}}, .of_triangle = std::vector<Index>(scene.triangles.size(), 0)};
  const SceneIndex index(scene);
  // One corner is free: the volume is 0 where it meets the opposite one.
  Patch patch = cut_patch(scene, index, std::vector<Index>{0}, 0);
  EXPECT_EQ(patch.solids.list.size(), 1u);
  EXPECT_EQ(triangles_of_solids(patch).front().size(), static_cast<std::size_t>(patch.active_count));
  EXPECT_FALSE(turns_a_solid_inside_out(patch));
  patch.x.col(0) = Vec3(0.9, 1.8, 2.7);
  EXPECT_FALSE(turns_a_solid_inside_out(patch));
  patch.x.col(0) = Vec3(1.1, 2.2, 3.3);
  EXPECT_TRUE(turns_a_solid_inside_out(patch));
}

}  // namespace
}  // namespace unsnarl
