#include "untangle/free_search.h"

#include <gtest/gtest.h>

#include "scene/shapes.h"
#include "unsnarl/repair.h"

namespace unsnarl {
namespace {

/// Faces around an edge whose other corners lie on lines through each other.
shapes::Shape tangled_fan() {
  shapes::Shape fan;
  fan.points = {{0, 0, 0}, {1, 0, 0}};
  for (int k = 0; k < 6; ++k) {
    const double side = k % 2 ? -1 : 1;
    fan.points.push_back({0.5 + 0.1 * k, side * (1 + 0.05 * k), 0.3 * side - 0.1 * k});
    fan.triangles.push_back({0, 1, k + 2});
    if (k >= 2) fan.triangles.push_back({0, k, k + 2});
  }
  for (int k = 0; k < 3; ++k) fan.triangles.push_back({2 + k, 5 + k, 1});
  return fan;
}

TEST(FreeSearch, untangles_a_fan_the_same_way_each_time) {
  Patch patch = shapes::patch_of(tangled_fan());
  const Positions rest = patch.rest;
  ASSERT_FALSE(shapes::pairs_at(patch.x, patch.triangles).empty());
  EXPECT_GT(search_freely(patch, {}), 0);
  EXPECT_TRUE(shapes::pairs_at(patch.x, patch.triangles).empty());
  EXPECT_TRUE(patch.rest == rest);
  Patch again = shapes::patch_of(tangled_fan());
  search_freely(again, {});
  EXPECT_TRUE(again.x == patch.x);
}

TEST(FreeSearch, holds_what_is_fixed_and_leaves_alone_what_it_cannot_improve) {
  shapes::Shape shape = tangled_fan();
  Patch patch = shapes::patch_of(shape, 2, static_cast<Index>(shape.triangles.size()));
  const Positions start = patch.x;
  const std::size_t before = shapes::pairs_at(patch.x, patch.triangles).size();
  search_freely(patch, {});
  EXPECT_TRUE(patch.x.rightCols(patch.x.cols() - 2) == start.rightCols(start.cols() - 2));
  const std::size_t after = shapes::pairs_at(patch.x, patch.triangles).size();
  EXPECT_TRUE(after < before || patch.x == start);
}

TEST(FreeSearch, tolerates_what_it_is_told_to) {
  Patch patch = shapes::patch_of(tangled_fan());
  const Positions start = patch.x;
  const std::vector<IntersectingPair> pairs = shapes::pairs_at(patch.x, patch.triangles);
  search_freely(patch, {.tolerated = pairs});
  EXPECT_TRUE(patch.x == start);
}

TEST(FreeSearch, leaves_large_patches_alone) {
  Patch patch = shapes::patch_of(shapes::crossing_bumps(10, 0.3));
  const Positions start = patch.x;
  EXPECT_EQ(search_freely(patch, {}), 0);
  EXPECT_TRUE(patch.x == start);
}

/// What local strategies leave: moves of single vertices find a way.
TEST(FreeSearch, is_the_last_resort_of_a_repair) {
  shapes::Shape shape = tangled_fan();
  RepairOptions options;
  options.without_strategies = {"half_resolution",     "push_apart",         "slide_apart",         "slide_apart_wide",
                                "placement",           "coarse_to_fine",     "part_layers",         "shorten_curves",
                                "coarse_to_fine_wide", "coarse_to_fine_far", "coarse_to_fine_whole"};
  const RepairResult result = repair(shape.surface(), options);
  EXPECT_EQ(result.status, Status::embedded);
}

}  // namespace
}  // namespace unsnarl
