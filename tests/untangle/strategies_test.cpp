#include "untangle/strategies.h"

#include <gtest/gtest.h>

#include <set>

#include "untangle/escalation.h"
#include "untangle/tangled_shapes.h"

namespace unsnarl {
namespace {

Strategy strategy(const std::string& name) {
  for (const Tier& tier : default_tiers())
    for (const Strategy& strategy : tier.strategies)
      if (strategy.name == name) return strategy;
  ADD_FAILURE() << name;
  return {};
}

std::set<std::string> names_of(std::span<const Tier> tiers) {
  std::set<std::string> names;
  for (const Tier& tier : tiers)
    for (const Strategy& strategy : tier.strategies) names.insert(strategy.name);
  return names;
}

int solve(const std::string& name, Patch& patch) {
  return strategy(name).solve(patch, Task{.untangle = make_untangler({}, {})});
}

TEST(Strategies, before_the_last_resorts_are_all_that_are_none) {
  const std::span<const Tier> first = tiers_before_last_resorts();
  ASSERT_LT(first.size(), default_tiers().size());
  EXPECT_EQ(first.data(), default_tiers().data());
  for (std::size_t k = 0; k < default_tiers().size(); ++k)
    EXPECT_EQ(default_tiers()[k].is_last_resort, k >= first.size()) << k;
}

TEST(Strategies, whole_components_go_from_coarse_to_fine) {
  for (const Index size : {12, 26}) {
    Patch patch = shapes::patch_of(shapes::two_spheres(size));
    const Positions start = patch.x;
    ASSERT_GT(shapes::count_pairs(patch), 0u);
    EXPECT_GT(solve("coarse_to_fine_whole", patch), 0);
    EXPECT_EQ(shapes::count_pairs(patch), 0u);
    EXPECT_TRUE(patch.rest == start);
  }
}

TEST(Strategies, large_deep_tangles_go_to_half_the_resolution_before_anything_else) {
  for (const std::span<const Tier> tiers : {default_tiers(), coarse_mesh_tiers()}) {
    ASSERT_EQ(tiers.front().strategies.size(), 1u);
    EXPECT_EQ(tiers.front().strategies.front().name, "half_resolution");
  }
  EXPECT_FALSE(names_of(local_tiers()).contains("half_resolution"));
}

TEST(Strategies, names_and_numbers_belong_together) {
  std::set<std::string> names;
  for (int number = 0; number <= last_strategy(); ++number) {
    names.emplace(strategy_name(number));
    EXPECT_EQ(strategy_number(strategy_name(number)), number);
  }
  EXPECT_EQ(names, names_of(default_tiers()));
  EXPECT_EQ(strategy_number("none of them"), -1);
  EXPECT_EQ(strategy_name(0), default_tiers().front().strategies.front().name);
  EXPECT_EQ(strategy_name(last_strategy()), default_tiers().back().strategies.back().name);
}

}  // namespace
}  // namespace unsnarl
