// Untangling, recovery and rounding of a scene.
#include "pipeline/untangle_stage.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "pipeline/stages.h"
#include "scene/shapes.h"
#include "untangle/escalation.h"
#include "untangle/strategies.h"
#include "untangle/tangled_shapes.h"

namespace unsnarl {
namespace {

TEST(UntangleStage, resolves_and_says_what_moved) {
  StagedRepair repair(shapes::crossing_bumps(8, 0.3).surface());
  ASSERT_TRUE(has_work(repair.task, repair.finders, repair.state));
  untangle_stage(repair.task, repair.control, repair.finders, repair.state);
  EXPECT_TRUE(is_resolved(repair.task, repair.finders, repair.state));
  EXPECT_EQ(repair.pairs(), 0u);
  EXPECT_EQ(repair.state.recovered, repair.state.moved.size());
  std::vector<std::uint8_t> may_move(static_cast<std::size_t>(repair.state.scene.vertex_count()), 0);
  for (const RepairState::Moved& moved : repair.state.moved) {
    EXPECT_LT(moved.region, repair.state.regions.size());
    for (const Index v : moved.vertices) may_move[v] = 1;
  }
  for (Index v = 0; v < repair.state.scene.vertex_count(); ++v)
    EXPECT_TRUE(may_move[v] || repair.state.scene.x.col(v) == repair.state.scene.rest.col(v)) << v;
}

TEST(UntangleStage, leaves_what_is_embedded_alone) {
  StagedRepair repair(shapes::bumpy_sheet(6, 0.4).surface());
  EXPECT_FALSE(has_work(repair.task, repair.finders, repair.state));
  untangle_stage(repair.task, repair.control, repair.finders, repair.state);
  EXPECT_EQ(repair.state.scene.x, repair.state.scene.rest);
}

TEST(UntangleStage, positions_are_those_that_a_reader_will_see) {
  RepairOptions options;
  options.precision = Precision::float32;
  StagedRepair repair(shapes::crossing_bumps(8, 0.3).surface(), options);
  untangle_stage(repair.task, repair.control, repair.finders, repair.state);
  ASSERT_TRUE(repair.state.format.float32());
  EXPECT_EQ(repair.state.format.as_written(repair.state.scene.x), repair.state.scene.x);
  EXPECT_TRUE(repair.finders.find_rounded(repair.state.scene.x).empty());
}

TEST(UntangleStage, what_is_stuck_does_not_hold_up_the_rest_of_its_component) {
  // Bumps that the first strategy alone does not part, and far away, tied to one of them, faces a float32 apart.
  shapes::Shape shape = shapes::crossing_bumps(8, 2);
  const Index first = static_cast<Index>(shape.points.size());
  shape.add({{{90, 0, 99}, {91, 0, 99}, {90, 1, 99}, {90, 0, 99 + 1e-7}, {91, 0, 99 + 1e-7}, {90, 1, 99 + 1e-7}},
             {{0, 1, 2}, {3, 4, 5}}});
  shape.triangles.push_back({0, 1, first});
  shape.triangles.push_back({0, 1, first + 3});
  RepairOptions options;
  options.precision = Precision::float32;
  for (const Tier& tier : default_tiers())
    for (const Strategy& strategy : tier.strategies)
      if (strategy.name != "push_apart") options.without_strategies.push_back(strategy.name);
  StagedRepair repair(shape.surface(), options);
  untangle_stage(repair.task, repair.control, repair.finders, repair.state);
  EXPECT_GT(repair.pairs(), 0u);
  for (const IntersectingPair& pair : repair.finders.find_rounded(repair.state.scene.x))
    for (const Index t : {pair.a, pair.b})
      for (const Index v : repair.state.scene.triangles[t]) EXPECT_LT(v, first);
}

TEST(UntangleStage, a_few_pairs_that_are_left_are_untangled_from_where_the_others_are_resolved) {
  shapes::Shape shape = shapes::crossing_bumps(12, 5);
  for (int k = 0; k < 10; ++k) shape.add(shapes::two_spheres(16), Vec3(50 + 10 * k, 0, 0));
  RepairOptions options;
  for (const Tier& tier : default_tiers())
    for (const Strategy& strategy : tier.strategies)
      if (strategy.name != "push_apart") options.without_strategies.push_back(strategy.name);
  StagedRepair once(shape.surface(), options);
  EscalationOptions from_input;
  from_input.tiers = default_tiers();
  from_input.left_out = options.without_strategies;
  SceneIndex index(once.state.scene);
  ASSERT_FALSE(escalate(once.state.scene, index, {}, from_input).left.empty());
  StagedRepair repair(shape.surface(), options);
  const Positions rest = repair.state.scene.rest;
  untangle_stage(repair.task, repair.control, repair.finders, repair.state);
  EXPECT_EQ(repair.pairs(), 0u);
  EXPECT_EQ(repair.state.scene.rest, rest);
  for (const RegionReport& region : repair.state.regions) EXPECT_NE(region.strategy, "none");
}

TEST(UntangleStage, a_checkpoint_brings_the_state_back) {
  StagedRepair repair(shapes::crossing_bumps(8, 0.3).surface());
  const RepairState::Checkpoint before = repair.state.checkpoint();
  untangle_stage(repair.task, repair.control, repair.finders, repair.state);
  ASSERT_NE(repair.state.scene.x, before.x);
  repair.state.restore(before);
  EXPECT_EQ(repair.state.scene.x, repair.state.scene.rest);
  EXPECT_TRUE(repair.state.regions.empty());
  EXPECT_FALSE(is_resolved(repair.task, repair.finders, repair.state));
}

TEST(UntangleStage, what_went_too_far_goes_back_with_all_that_met_it) {
  RepairOptions options;
  options.max_displacement_rel = 1e-9;
  StagedRepair repair(shapes::crossing_bumps(8, 0.3).surface(), options);
  const std::size_t pairs = repair.pairs();
  std::vector<Index> all(static_cast<std::size_t>(repair.state.scene.vertex_count()));
  for (std::size_t v = 0; v < all.size(); ++v) all[v] = static_cast<Index>(v);
  repair.state.moved.push_back({all, 0, 0});
  repair.state.scene.x.colwise() += Vec3(0, 0, 1);
  keep_within_displacement(repair.task, repair.finders.as_is, repair.state);
  EXPECT_EQ(repair.state.scene.x, repair.state.scene.rest);
  EXPECT_TRUE(repair.state.displacement_is_exceeded);
  EXPECT_EQ(std::count(repair.state.attempts.is_too_far.begin(), repair.state.attempts.is_too_far.end(), 1),
            static_cast<std::ptrdiff_t>(all.size()));
  EXPECT_EQ(repair.pairs(), pairs);
}

}  // namespace
}  // namespace unsnarl
