#include "untangle/strategies.h"

#include <gtest/gtest.h>

#include <set>

#include "untangle/flow_shapes.h"

namespace unsnarl {
namespace {

Strategy strategy(const std::string& name) {
  for (const Tier& tier : default_tiers())
    for (const Strategy& strategy : tier)
      if (strategy.name == name) return strategy;
  ADD_FAILURE() << name;
  return {};
}

std::set<std::string> names_of(std::span<const Tier> tiers) {
  std::set<std::string> names;
  for (const Tier& tier : tiers)
    for (const Strategy& strategy : tier) names.insert(strategy.name);
  return names;
}

int solve(const std::string& name, Patch& patch) {
  const std::function<bool()> never;
  return strategy(name).solve(patch, Task{.tolerated = {}, .stop = never});
}

TEST(Strategies, a_small_patch_flows_once_and_not_again_at_full_resolution) {
  Patch patch = shapes::patch_of(shapes::two_spheres(12));
  ASSERT_LT(patch.active_count, 3000);
  const Positions start = patch.x;
  EXPECT_EQ(solve("fine_flow", patch), 0);
  EXPECT_TRUE(patch.x == start);
  EXPECT_GT(solve("flow", patch), 0);
  EXPECT_EQ(shapes::count_pairs(patch), 0u);
  EXPECT_TRUE(patch.rest == start);
}

TEST(Strategies, a_large_patch_flows_on_a_coarse_mesh_before_it_flows_itself) {
  Patch coarse = shapes::patch_of(shapes::two_spheres(26)), fine = coarse;
  ASSERT_GT(coarse.active_count, 3000);
  const std::size_t before = shapes::count_pairs(coarse);
  EXPECT_GT(solve("flow", coarse), 0);
  EXPECT_GT(solve("fine_flow", fine), 0);
  EXPECT_LT(shapes::count_pairs(coarse), before / 3);
  EXPECT_EQ(shapes::count_pairs(fine), 0u);
  EXPECT_FALSE(coarse.x == fine.x);
}

TEST(Strategies, no_patch_of_more_than_30000_faces_moves_at_once) {
  Patch patch = shapes::patch_of(shapes::two_spheres(90));
  ASSERT_GT(patch.active_count, 30000);
  const Positions start = patch.x;
  for (const std::string name : {"fine_flow", "recession"}) EXPECT_EQ(solve(name, patch), 0) << name;
  EXPECT_TRUE(patch.x == start);
}

TEST(Strategies, coarse_meshes_have_all_but_coarse_to_fine_and_recession) {
  std::set<std::string> expected = names_of(default_tiers());
  EXPECT_EQ(expected.erase("coarse_to_fine") + expected.erase("coarse_to_fine_wide") + expected.erase("recession"), 3u);
  EXPECT_EQ(names_of(coarse_mesh_tiers()), expected);
}

}  // namespace
}  // namespace unsnarl
