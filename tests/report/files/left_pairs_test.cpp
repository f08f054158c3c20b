// Why pairs are left: each reason where it alone can be true.
#include "report/left_pairs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "scene/shapes.h"
#include "unsnarl/repair.h"
#include "unsnarl/report_json.h"
#include "unsnarl/samples.h"
#include "untangle/strategies.h"

namespace unsnarl {
namespace {

using shapes::Shape;

std::size_t count(const RepairResult& result, LeftReason reason) {
  return result.report.left_by_reason[static_cast<std::size_t>(reason)];
}

/// The result of a repair, whose list of pairs is that of the faces that intersect in it.
RepairResult repaired(const Surface& surface, const RepairOptions& options = {}, Context* context = nullptr) {
  RepairResult result = repair(surface, options, context);
  const auto left = find_intersections({result.positions, surface.corners, surface.offsets});
  std::size_t counted = 0;
  for (const std::size_t n : result.report.left_by_reason) counted += n;
  EXPECT_EQ(counted, left.size());
  EXPECT_EQ(result.report.left.size(), left.size());
  for (std::size_t i = 0; i < result.report.left.size(); ++i) {
    const LeftPair& pair = result.report.left[i];
    EXPECT_TRUE((IntersectingPair{pair.a, pair.b, pair.kind} == left[i]));
    EXPECT_EQ(pair.strategy.empty(), pair.reason != LeftReason::unresolved);
  }
  return result;
}

TEST(LeftPairs, none_of_what_is_embedded) {
  const RepairResult result = repaired(shapes::crossing_bumps(8, 0.3).surface());
  EXPECT_EQ(result.status, Status::embedded);
  EXPECT_TRUE(result.report.left.empty());
}

TEST(LeftPairs, what_no_motion_parts) {
  Surface doubled = shapes::crossing_bumps(8, 0.3).surface();
  doubled.corners.insert(doubled.corners.end(), {doubled.corners[3], doubled.corners[5], doubled.corners[4]});
  const RepairResult duplicate = repaired(doubled);
  ASSERT_EQ(duplicate.report.left.size(), 1u);
  EXPECT_EQ(duplicate.report.left[0].a, 1);
  EXPECT_EQ(duplicate.report.left[0].kind, PairClass::duplicate);
  EXPECT_EQ(duplicate.report.left[0].reason, LeftReason::duplicate_faces);

  const RepairResult klein = repaired(make_sample("klein_bottle", 16));
  EXPECT_GT(klein.report.after.total(), 0u);
  EXPECT_EQ(count(klein, LeftReason::closed_non_orientable), klein.report.after.total());
}

TEST(LeftPairs, what_is_fixed) {
  const Surface surface = shapes::crossed_squares().surface();
  RepairOptions options;
  options.fixed.assign(8, 1);
  RepairResult result = repaired(surface, options);
  EXPECT_GT(result.report.after.total(), 0u);
  EXPECT_EQ(count(result, LeftReason::fixed_faces), result.report.after.total());
  // An edge through a face is enough, whatever the corner across from it does.
  options.fixed[5] = options.fixed[7] = 0;
  result = repaired(surface, options);
  EXPECT_EQ(result.status, Status::obstructed) << to_string(result.status);
  EXPECT_GT(result.report.after.total(), 0u);
  EXPECT_EQ(count(result, LeftReason::fixed_faces), result.report.after.total());
}

TEST(LeftPairs, what_was_not_asked_for) {
  const Surface bumps = shapes::crossing_bumps(8, 0.3).surface();
  RepairOptions options;
  options.each_component = true;
  const RepairResult each = repaired(bumps, options);
  EXPECT_EQ(each.report.after.total(), each.report.before.total());
  EXPECT_EQ(count(each, LeftReason::between_components), each.report.after.total());

  Shape fan;
  fan.points = {Vec3(0, 0, 0), Vec3(2, -1, 0), Vec3(2, 1, 0), Vec3(2, 0, -1), Vec3(2.1, 0, 1)};
  fan.triangles = {{0, 1, 2}, {0, 3, 4}};
  options = {};
  options.goal = Goal::disjoint;
  const RepairResult disjoint = repaired(fan.surface(), options);
  ASSERT_EQ(disjoint.report.left.size(), 1u);
  EXPECT_EQ(disjoint.report.left[0].reason, LeftReason::goal);
}

TEST(LeftPairs, what_a_limit_kept_from_being_resolved) {
  const Surface bumps = shapes::crossing_bumps(10, 0.4).surface();
  RepairOptions options;
  options.time_limit_s = 1e-9;
  const RepairResult late = repaired(bumps, options);
  EXPECT_GT(late.report.after.total(), 0u);
  EXPECT_EQ(count(late, LeftReason::time_limit), late.report.after.total());

  Context context;
  context.cancel();
  const RepairResult cancelled = repaired(bumps, {}, &context);
  EXPECT_EQ(count(cancelled, LeftReason::cancelled), cancelled.report.after.total());

  options = {};
  options.max_displacement_rel = 1e-6;
  const RepairResult near = repaired(bumps, options);
  EXPECT_GT(near.report.after.total(), 0u);
  EXPECT_EQ(count(near, LeftReason::displacement), near.report.after.total());
}

TEST(LeftPairs, what_no_strategy_could_part_names_the_furthest) {
  // Ten faces around a vertex, one for each two of five others: five points on a small sphere around it cannot all be
  // joined without crossings (K5 is not planar).
  Shape fan;
  fan.points = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0.1), Vec3(-1, 0.2, 0), Vec3(0.1, -1, 0), Vec3(0.2, 0.1, 1)};
  for (Index i = 1; i <= 5; ++i)
    for (Index j = i + 1; j <= 5; ++j) fan.triangles.push_back({0, i, j});
  const RepairResult result = repaired(fan.surface());
  ASSERT_FALSE(result.report.left.empty());
  for (const LeftPair& pair : result.report.left) {
    EXPECT_EQ(pair.reason, LeftReason::unresolved);
    EXPECT_EQ(pair.strategy, strategy_name(last_strategy()));
  }
}

TEST(LeftPairs, all_are_listed_but_for_the_json) {
  Shape many;
  for (int i = 0; i < 600; ++i) many.add(shapes::crossed_squares(), {10.0 * i, 0, 0});
  RepairOptions options;
  options.fixed.assign(many.points.size(), 1);
  const RepairResult result = repaired(many.surface(), options);
  EXPECT_GT(result.report.after.total(), most_left_pairs_listed) << "the test tests nothing";
  EXPECT_EQ(count(result, LeftReason::fixed_faces), result.report.after.total());
  const auto json = nlohmann::json::parse(report_json(result, options, {}));
  EXPECT_EQ(json["left"]["pairs"].size(), most_left_pairs_listed);
  EXPECT_EQ(json["left"]["by_reason"]["fixed_faces"], result.report.after.total());
}

}  // namespace
}  // namespace unsnarl
