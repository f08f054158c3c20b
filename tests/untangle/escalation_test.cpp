#include "untangle/escalation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "scene/shapes.h"
#include "untangle/strategies.h"

namespace unsnarl {
namespace {

using shapes::Shape;

EscalationResult untangle(Scene& scene, std::span<const IntersectingPair> ignored, EscalationOptions options) {
  SceneIndex index(scene);
  if (options.tiers.empty()) options.tiers = default_tiers();
  return escalate(scene, index, ignored, options);
}

EscalationOptions options_with(std::span<const Tier> tiers) {
  EscalationOptions options;
  options.tiers = tiers;
  return options;
}

TEST(Escalation, clears_a_crossing_and_says_how) {
  const Shape shape = shapes::crossing_bumps(14, 0.3);
  Scene scene = shapes::scene_of(shape);
  std::vector<std::size_t> left;
  EscalationOptions options;
  options.on_progress = [&](const EscalationProgress& progress) { left.push_back(progress.left.size()); };
  const EscalationResult result = untangle(scene, {}, options);
  EXPECT_TRUE(result.left.empty());
  EXPECT_TRUE(shapes::pairs_at(scene.x, scene.triangles).empty());
  ASSERT_EQ(result.regions.size(), 1u);
  EXPECT_EQ(result.regions[0].pairs, shapes::pairs_of(shape).size());
  EXPECT_FALSE(result.regions[0].strategy.empty());
  EXPECT_GT(result.regions[0].faces, 0u);
  ASSERT_GE(left.size(), 2u);
  EXPECT_EQ(left.front(), shapes::pairs_of(shape).size());
  EXPECT_EQ(left.back(), 0u);
  // Nothing moved but what is said to have been free.
  ASSERT_EQ(result.moved.size(), 1u);
  for (Index v = 0; v < scene.vertex_count(); ++v) {
    EXPECT_TRUE(scene.x.col(v) == scene.rest.col(v) ||
                std::binary_search(result.moved[0].begin(), result.moved[0].end(), v));
  }
  EXPECT_TRUE(scene.rest == shape.positions());
}

// Too deep for the first strategies: those that failed are not reported, and leave no trace.
TEST(Escalation, a_region_escalates_until_a_strategy_resolves_it) {
  const Shape shape = shapes::crossing_bumps(14, 3.5);
  Scene scene = shapes::scene_of(shape), shallow = shapes::scene_of(shapes::crossing_bumps(14, 0.3));
  const EscalationResult result = untangle(scene, {}, {}), shallow_result = untangle(shallow, {}, {});
  EXPECT_TRUE(result.left.empty());
  ASSERT_EQ(result.regions.size(), 1u);
  ASSERT_EQ(shallow_result.regions.size(), 1u);
  EXPECT_NE(result.regions[0].strategy, shallow_result.regions[0].strategy);
  EXPECT_EQ(result.regions[0].pairs, shapes::pairs_of(shape).size());
  EXPECT_TRUE(shapes::pairs_at(scene.x, scene.triangles).empty());
}

// Two wide bumps run through each other many edges deep: the mesh with edges twice as long goes first.
TEST(Escalation, deep_conflicts_start_on_a_coarser_mesh) {
  const auto bump = [](double height) {
    return shapes::grid(100, 100, false, [=](double i, double j) {
      const double x = i - 50, y = j - 50;
      return Vec3(x, y, height * std::exp(-(x * x + y * y) / 1400));
    });
  };
  Shape shape = bump(16);
  shape.add(bump(-16), {0.31, 0.17, 20});
  Scene scene = shapes::scene_of(shape);
  const double all = static_cast<double>(shapes::pairs_of(shape).size());
  double least_work = all;
  EscalationOptions options;
  options.on_progress = [&](const EscalationProgress& progress) {
    EXPECT_GE(progress.pairs_now, 0);
    EXPECT_GE(progress.work_left, 0);
    EXPECT_LE(progress.work_left, static_cast<double>(progress.left.size()));
    least_work = std::min(least_work, progress.work_left);
  };
  const EscalationResult result = untangle(scene, {}, options);
  EXPECT_EQ(least_work, 0);
  EXPECT_TRUE(result.left.empty());
  EXPECT_TRUE(shapes::pairs_at(scene.x, scene.triangles).empty());
  ASSERT_FALSE(result.regions.empty());
  EXPECT_EQ(result.regions[0].strategy, "half_resolution");
  EXPECT_GT(2 * result.regions[0].pairs, shapes::pairs_of(shape).size());
  // What it says has moved has, and is not everything.
  ASSERT_FALSE(result.moved.empty());
  std::vector<std::uint8_t> is_free(scene.vertex_count(), 0);
  for (const std::vector<Index>& moved : result.moved)
    for (Index v : moved) is_free[v] = 1;
  for (Index v = 0; v < scene.vertex_count(); ++v) EXPECT_TRUE(is_free[v] || scene.x.col(v) == scene.rest.col(v));
  EXPECT_LT(std::count(is_free.begin(), is_free.end(), 1), scene.vertex_count());
}

TEST(Escalation, nothing_to_do_moves_nothing) {
  Scene scene = shapes::scene_of(shapes::bumpy_sheet(5, 0.5));
  const EscalationResult result = untangle(scene, {}, {});
  EXPECT_TRUE(result.regions.empty());
  EXPECT_TRUE(result.left.empty());
  EXPECT_TRUE(scene.x == scene.rest);
}

TEST(Escalation, regions_apart_do_not_feel_each_other) {
  const Shape shallow = shapes::crossing_bumps(12, 0.2), deeper = shapes::crossing_bumps(12, 0.8);
  Scene alone = shapes::scene_of(shallow);
  untangle(alone, {}, {});
  Scene both = shapes::scene_of(Shape(shallow).add(deeper, {60, 0, 0}));
  const EscalationResult result = untangle(both, {}, {});
  EXPECT_TRUE(result.left.empty());
  EXPECT_EQ(result.regions.size(), 2u);
  EXPECT_TRUE(both.x.leftCols(alone.x.cols()) == alone.x);
}

TEST(Escalation, ignored_pairs_are_tolerated) {
  const Shape shape = Shape(shapes::crossing_bumps(12, 0.2)).add(shapes::crossed_squares(), {60, 0, 0});
  const Index squares = static_cast<Index>(shapes::crossing_bumps(12, 0.2).triangles.size());
  std::vector<IntersectingPair> ignored;
  for (const IntersectingPair& pair : shapes::pairs_of(shape))
    if (pair.a >= squares) ignored.push_back(pair);
  ASSERT_FALSE(ignored.empty());
  Scene scene = shapes::scene_of(shape);
  const EscalationResult result = untangle(scene, ignored, {});
  EXPECT_TRUE(result.left.empty());
  EXPECT_TRUE(shapes::pairs_at(scene.x, scene.triangles) == ignored);
  EXPECT_TRUE(scene.x.rightCols(8) == scene.rest.rightCols(8));
}

TEST(Escalation, fixed_vertices_stay) {
  const Shape shape = shapes::crossing_bumps(12, 0.3);
  std::vector<std::uint8_t> fixed(shape.points.size(), 0);
  std::fill(fixed.begin(), fixed.begin() + static_cast<std::ptrdiff_t>(fixed.size() / 2),
            std::uint8_t{1});  // a whole sheet
  Scene scene = make_scene(shape.positions(), shape.triangles, fixed);
  const EscalationResult result = untangle(scene, {}, {});
  EXPECT_TRUE(result.left.empty());
  const Index half = scene.vertex_count() / 2;
  EXPECT_TRUE(scene.x.leftCols(half) == scene.rest.leftCols(half));
  EXPECT_TRUE(shapes::pairs_at(scene.x, scene.triangles).empty());
}

// One pair of faces cannot move: all around it is cleared all the same.
TEST(Escalation, what_cannot_be_resolved_keeps_what_was_gained) {
  const Shape shape = shapes::crossing_bumps(12, 0.3);
  const auto pairs = shapes::pairs_of(shape);
  std::vector<std::uint8_t> fixed(shape.points.size(), 0);
  for (const Index t : {pairs[0].a, pairs[0].b})
    for (const Index v : shape.triangles[t]) fixed[v] = 1;
  Scene scene = make_scene(shape.positions(), shape.triangles, fixed);
  const EscalationResult result = untangle(scene, {}, {});
  EXPECT_FALSE(result.left.empty());
  EXPECT_LT(2 * result.left.size(), pairs.size());
  EXPECT_TRUE(result.left == shapes::pairs_at(scene.x, scene.triangles));
  EXPECT_TRUE(scene.rest == shape.positions());
  EXPECT_EQ(result.regions.back().strategy, "none");
  std::vector<Index> moved;
  for (const auto& vertices : result.moved) moved.insert(moved.end(), vertices.begin(), vertices.end());
  for (Index v = 0; v < scene.vertex_count(); ++v) {
    const bool is_at_rest = scene.x.col(v) == scene.rest.col(v);
    EXPECT_TRUE(is_at_rest || (!fixed[v] && std::count(moved.begin(), moved.end(), v) > 0)) << v;
  }
}

/// Two sheets that run through each other; the faces of the first pair cannot move, so that something is always left.
Scene stubborn(const Shape& shape, const Shape& far_away = {}) {
  Shape both = shape;
  both.add(far_away, {90, 0, 0});
  std::vector<std::uint8_t> fixed(both.points.size(), 0);
  const auto hold = [&](const Shape& part, std::size_t first) {
    const auto pairs = shapes::pairs_of(part);
    if (pairs.empty()) return;
    for (const Index t : {pairs[0].a, pairs[0].b})
      for (const Index v : part.triangles[t]) fixed[first + static_cast<std::size_t>(v)] = 1;
  };
  hold(shape, 0);
  hold(far_away, shape.points.size());
  return make_scene(both.positions(), both.triangles, fixed);
}

// Neither what is gained here nor what is given up there depends on the other.
TEST(Escalation, stubborn_parts_apart_do_not_feel_each_other) {
  const std::array<Shape, 2> shapes = {shapes::crossing_bumps(7, 0.3), shapes::crossing_bumps(6, 1.5)};
  for (const Shape& here : shapes) {
    Scene alone = stubborn(here);
    const EscalationResult result = untangle(alone, {}, {});
    Scene both = stubborn(here, shapes[0]);
    const EscalationResult result_of_both = untangle(both, {}, {});
    EXPECT_GT(result.left.size(), 0u);
    EXPECT_GT(result_of_both.left.size(), result.left.size());
    EXPECT_TRUE(both.x.leftCols(alone.x.cols()) == alone.x);
  }
}

TEST(Escalation, stopping_leaves_the_rest_as_it_is) {
  Scene scene = shapes::scene_of(shapes::crossing_bumps(12, 0.3));
  EscalationOptions options;
  options.stop = [] { return true; };
  const EscalationResult result = untangle(scene, {}, options);
  EXPECT_TRUE(result.left == shapes::pairs_at(scene.rest, scene.triangles));
  EXPECT_TRUE(result.moved.empty());
  EXPECT_TRUE(scene.x == scene.rest);
}

/// Moves everything free by a length along z: a trivial strategy, as CONTRIBUTING.md shows one. `reach` in h.
Strategy lifting(double height, double reach = 100, std::string name = "lifting") {
  const auto solve = [height](Patch& patch, const Task&) {
    patch.x.row(2).leftCols(patch.free_count).array() += height;
    return 1;
  };
  return {.name = std::move(name), .select = select_whole_components(reach), .solve = solve};
}

/// A tier of each list.
std::vector<Tier> tiers_of(std::vector<std::vector<Strategy>> lists) {
  std::vector<Tier> tiers;
  for (std::vector<Strategy>& strategies : lists) tiers.push_back({.strategies = std::move(strategies)});
  return tiers;
}

/// Two components: what lies in the upper sheet moves, the lower sheet is fixed.
Scene two_sheets(double depth) {
  const Shape shape = shapes::crossing_bumps(12, depth);
  std::vector<std::uint8_t> fixed(shape.points.size(), 0);
  std::fill(fixed.begin(), fixed.begin() + static_cast<std::ptrdiff_t>(fixed.size() / 2), std::uint8_t{1});
  return make_scene(shape.positions(), shape.triangles, fixed);
}

TEST(Escalation, a_new_strategy_takes_one_entry_of_a_table) {
  Scene scene = two_sheets(1.5);
  const std::vector<Tier> tiers = tiers_of({{lifting(5)}});
  const EscalationResult result = untangle(scene, {}, options_with(tiers));
  EXPECT_TRUE(result.left.empty());
  ASSERT_EQ(result.regions.size(), 1u);
  EXPECT_EQ(result.regions[0].strategy, "lifting");
  ASSERT_EQ(result.depths.size(), 1u);
  EXPECT_NEAR(result.depths[0], 5, 1e-12);
}

TEST(Escalation, candidates_with_more_pairs_are_not_kept) {
  Scene scene = two_sheets(0.5);
  const std::size_t before = shapes::pairs_at(scene.x, scene.triangles).size();
  const std::vector<Tier> tiers = tiers_of({{lifting(-0.5)}});  // deeper into the other sheet
  const EscalationResult result = untangle(scene, {}, options_with(tiers));
  EXPECT_EQ(result.left.size(), before);
  EXPECT_TRUE(scene.x == scene.rest);
}

// Each step up leaves fewer pairs, but too many to be kept at once: the best candidate of the tier is.
TEST(Escalation, what_a_tier_leaves_is_where_the_next_starts) {
  Scene scene = two_sheets(3);
  const std::vector<Tier> small = tiers_of({{lifting(0.3), lifting(2.4)}});
  const EscalationResult result = untangle(scene, {}, options_with(small));
  EXPECT_TRUE(result.left.empty());
  ASSERT_EQ(result.depths.size(), 2u);
  EXPECT_NEAR(result.depths[0], 2.4, 1e-12);
  EXPECT_NEAR(result.depths[1], 2 * 2.4, 1e-12) << "the depth counts from rest";
}

TEST(Escalation, what_goes_far_waits_for_a_nearer_candidate) {
  const Strategy far = lifting(5, 0.1), near = lifting(4, 100, "nearer"), nearer_than_far = lifting(4, 0.1, "nearer");
  const auto kept = [](const std::vector<Tier>& tiers) {
    Scene scene = two_sheets(1.5);
    const EscalationResult result = untangle(scene, {}, options_with(tiers));
    EXPECT_TRUE(result.left.empty());
    return result.regions.size() == 1 ? result.regions[0].strategy : "not one region";
  };
  EXPECT_EQ(kept(tiers_of({{far}, {near}})), "nearer");
  EXPECT_EQ(kept(tiers_of({{far}})), "lifting") << "none came";
  EXPECT_EQ(kept(tiers_of({{near}, {far}})), "nearer");
  // Two that both go far: the nearer of them, in either order.
  EXPECT_EQ(kept(tiers_of({{far}, {nearer_than_far}})), "nearer");
  EXPECT_EQ(kept(tiers_of({{nearer_than_far}, {far}})), "nearer");
  // It does not wait for last resorts.
  std::vector<Tier> with_last_resort = tiers_of({{far}, {near}});
  with_last_resort[1].is_last_resort = true;
  EXPECT_EQ(kept(with_last_resort), "lifting");
}

TEST(Escalation, what_goes_far_and_leaves_pairs_is_not_kept) {
  const Scene before = two_sheets(3);
  const std::size_t pairs = shapes::pairs_at(before.x, before.triangles).size();
  const auto left_with_reach = [&](double reach, Scene& scene) {
    const std::vector<Tier> tiers = tiers_of({{lifting(2.4, reach)}});  // not all the way
    return untangle(scene, {}, options_with(tiers)).left.size();
  };
  Scene scene = before;
  EXPECT_LT(left_with_reach(100, scene), pairs);
  scene = before;
  EXPECT_EQ(left_with_reach(0.1, scene), pairs);
  EXPECT_TRUE(scene.x == scene.rest);
}

// Higher up, beyond the obstacles that it was tried with, the sheet runs into another one just as deep.
TEST(Escalation, what_goes_far_is_judged_by_all_that_it_meets) {
  const Shape sheets = shapes::crossing_bumps(12, 1.5);
  const Index count = static_cast<Index>(sheets.points.size()) / 2;
  Shape lower = sheets;
  lower.points.resize(static_cast<std::size_t>(count));
  std::erase_if(lower.triangles, [&](const Triangle& t) { return t[0] >= count; });
  Shape shape = sheets;
  shape.add(lower, Vec3(0, 0, 5));
  std::vector<std::uint8_t> fixed(shape.points.size(), 1);
  std::fill(fixed.begin() + count, fixed.begin() + 2 * count, std::uint8_t{0});
  Scene scene = make_scene(shape.positions(), shape.triangles, fixed);
  const std::size_t before = shapes::pairs_at(scene.x, scene.triangles).size();
  const std::vector<Tier> tiers = tiers_of({{lifting(5, 0.1)}});
  EXPECT_EQ(untangle(scene, {}, options_with(tiers)).left.size(), before);
  EXPECT_TRUE(scene.x == scene.rest);
}

/// A sheet with a bump of each radius, which reaches through a plane that is fixed.
Scene bumps_through_a_plane(std::span<const double> radii) {
  constexpr Index n = 12;
  const Index bumps = static_cast<Index>(radii.size());
  Shape shape = shapes::grid(n, n * bumps, false, [&](double i, double j) {
    double height = 0.4;
    for (Index b = 0; b < bumps; ++b) {
      const double x = i - n / 2 + 0.31, y = j - n * (b + 0.5) + 0.17, radius = radii[static_cast<std::size_t>(b)];
      height -= std::exp(-(x * x + y * y) / (radius * radius));
    }
    return Vec3(i, j, height);
  });
  const std::size_t free = shape.points.size();
  shape.add(shapes::grid(n, n * bumps, false, [](double i, double j) { return Vec3(i, j, 0); }));
  std::vector<std::uint8_t> fixed(shape.points.size(), 1);
  std::fill(fixed.begin(), fixed.begin() + static_cast<std::ptrdiff_t>(free), std::uint8_t{0});
  return make_scene(shape.positions(), shape.triangles, fixed);
}

// The second strategy takes both bumps at once, and leaves more pairs of the two than the first one leaves of one.
TEST(Escalation, the_candidate_that_resolves_most_is_kept) {
  const std::array<double, 2> radii = {1.5, 3};
  Strategy first = lifting(0.05);
  first.select = select_rings({});
  const Strategy second = lifting(0.3);
  const auto pairs_left = [&](const std::vector<Strategy>& tier) {
    Scene scene = bumps_through_a_plane(radii);
    const std::vector<Tier> tiers = tiers_of({tier});
    return untangle(scene, {}, options_with(tiers)).left.size();
  };
  EXPECT_GT(pairs_left({first}), 0u);
  EXPECT_EQ(pairs_left({second}), 0u);
  EXPECT_EQ(pairs_left({first, second}), 0u);
}

TEST(Escalation, a_candidate_that_is_not_finite_is_dropped) {
  Scene scene = two_sheets(0.5);
  const std::vector<Tier> tiers = tiers_of({{lifting(std::numeric_limits<double>::quiet_NaN()), lifting(5)}});
  const EscalationResult result = untangle(scene, {}, options_with(tiers));
  EXPECT_TRUE(result.left.empty());
  EXPECT_TRUE(scene.x.allFinite());
}

TEST(Escalation, what_is_not_accepted_leaves_the_surface_as_it_was) {
  Scene scene = two_sheets(1.5);
  AttemptLog attempts(scene.rest);
  const std::vector<Tier> tiers = tiers_of({{lifting(5), lifting(4)}});
  EscalationOptions options = options_with(tiers);
  int asked = 0;
  options.accept = [&](Patch&) { return ++asked < 0; };
  options.attempts = &attempts;
  const std::size_t before = shapes::pairs_at(scene.x, scene.triangles).size();
  EXPECT_EQ(untangle(scene, {}, options).left.size(), before);
  EXPECT_EQ(asked, 1) << "whole components are not tried again";
  EXPECT_TRUE(scene.x == scene.rest);
  EXPECT_GT(std::count(attempts.is_too_far.begin(), attempts.is_too_far.end(), 1), 0);
}

TEST(Escalation, strategies_can_be_left_out_by_name) {
  std::vector<Tier> named = tiers_of({{lifting(5), lifting(4, 100, "lower")}});
  const auto kept = [&](std::vector<std::string> left_out) {
    Scene scene = two_sheets(1.5);
    EscalationOptions options = options_with(named);
    options.left_out = std::move(left_out);
    return untangle(scene, {}, options).regions.front().strategy;
  };
  EXPECT_EQ(kept({}), "lifting");
  EXPECT_EQ(kept({"lifting"}), "lower");
  EXPECT_EQ(kept({"lower"}), "lifting");
  EXPECT_EQ(kept({"lifting", "lower"}), "none");

  // Not all the way: the candidate is kept where the first strategy ends the tier now, and what it leaves starts anew.
  named = tiers_of({{lifting(0.3), lifting(2.4), lifting(0, 100, "nothing")}});
  Scene scene = two_sheets(3);
  EscalationOptions options = options_with(named);
  options.left_out = {"nothing"};
  EXPECT_TRUE(untangle(scene, {}, options).left.empty());
}

}  // namespace
}  // namespace unsnarl
