#include "scene/scene_index.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "scene/shapes.h"

namespace unsnarl {
namespace {

TEST(SceneIndex, knows_where_moved_triangles_are) {
  Scene scene = shapes::scene_of(shapes::crossing_bumps(10, 0.4));
  SceneIndex index(scene);
  const Box here = shapes::box_around({0, 0, 0}, 1.5), there = shapes::box_around({0, 0, 30}, 1.5);
  EXPECT_EQ(shapes::found_by(index, here), shapes::overlapping(scene, here));
  EXPECT_TRUE(shapes::found_by(index, there).empty());
  const std::vector<Index> moved = {60, 61, 71};
  for (int round = 0; round < 2; ++round) {
    for (Index v : moved) scene.x(2, v) += 15;
    index.mark_moved(moved);  // twice: each triangle must still be found once
    EXPECT_EQ(shapes::found_by(index, here), shapes::overlapping(scene, here));
    EXPECT_EQ(shapes::found_by(index, there), shapes::overlapping(scene, there));
  }
  EXPECT_FALSE(shapes::found_by(index, there).empty());
}

// What was only marked has yet to be decided, in whatever order positions become known.
TEST(SceneIndex, finds_pairs_of_what_was_marked_of_what_was_not_and_of_all) {
  Scene scene = shapes::scene_of(shapes::crossing_bumps(30, 0.4));
  IntersectionFinder shared(scene.triangles);
  SceneIndex index(scene, shared);
  const auto as_if_anew = [&] { return shapes::pairs_at(scene.x, scene.triangles); };
  EXPECT_TRUE(index.find_pairs() == as_if_anew());
  const std::vector<Index> first = {405, 406}, second = {1300, 1301};
  for (Index v : first) scene.x(2, v) += 0.9;
  index.mark_moved(first);
  for (Index v : second) scene.x(2, v) -= 0.9;
  const auto pairs = index.find_pairs();
  EXPECT_TRUE(pairs == as_if_anew());
  EXPECT_FALSE(pairs.empty());
  for (Index v : first) scene.x(2, v) -= 0.9;
  index.mark_moved(first);
  scene.x = scene.rest;
  index.update();
  EXPECT_TRUE(index.find_pairs() == as_if_anew());
  EXPECT_TRUE(SceneIndex(scene).find_pairs() == as_if_anew());
}

}  // namespace
}  // namespace unsnarl
