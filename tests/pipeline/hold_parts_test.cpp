// A coarse component that finer ones can give way to hardly moves.
#include "pipeline/hold_parts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "mesh/areas.h"
#include "pipeline/stages.h"
#include "pipeline/untangle_stage.h"
#include "untangle/tangled_shapes.h"

namespace unsnarl {
namespace {

constexpr Index box_vertices = 8;

/// A box with its middle at the origin.
shapes::Shape coarse_box(const Vec3& half) {
  return shapes::Shape().add(shapes::box(2 * half), -half);
}

/// A coarse box, with fine balls that its sides cut.
shapes::Shape box_and_balls() {
  shapes::Shape shape = coarse_box({2, 1, 1});
  shape.add(shapes::sphere({0.3, 0.2, 1.4}, 0.6, 20));
  shape.add(shapes::sphere({-1.1, -1.45, 0.1}, 0.7, 20));
  return shape;
}

RepairResult repaired(const shapes::Shape& shape, const RepairOptions& options = {}) {
  return repair(shape.surface(), options);
}

double motion_by_area(const shapes::Shape& shape, const RepairResult& result) {
  const Positions x = Eigen::Map<const Positions>(result.positions.data(), 3, shape.positions().cols());
  double sum = 0;
  for (const Triangle& t : shape.triangles) sum += squared_motion(shape.positions(), x, t);
  return std::sqrt(sum / total_area(shape.positions(), shape.triangles));
}

TEST(HoldParts, finer_components_give_way_to_a_coarse_one) {
  const shapes::Shape shape = box_and_balls();
  const RepairResult result = repaired(shape);
  ASSERT_EQ(result.status, Status::embedded);
  RepairOptions held;
  held.fixed.assign(shape.points.size(), 0);
  std::fill_n(held.fixed.begin(), box_vertices, std::uint8_t{1});
  const RepairResult around = repaired(shape, held);
  ASSERT_EQ(around.status, Status::embedded);
  EXPECT_LE(motion_by_area(shape, result), 1.1 * motion_by_area(shape, around));
  const Positions x = Eigen::Map<const Positions>(result.positions.data(), 3, shape.positions().cols());
  const std::vector<Triangle> box(shape.triangles.begin(), shape.triangles.begin() + 12);
  EXPECT_GT(signed_volume(x, box), 0.95 * signed_volume(shape.positions(), box));
}

TEST(HoldParts, of_many_parts_all_coarse_ones_keep_their_shape) {
  // A row of boxes and balls that hang together: none of the boxes bears a large share of the motion of all.
  shapes::Shape row;
  constexpr int boxes = 7;
  for (int k = 0; k < boxes; ++k) {
    row.add(coarse_box({0.5, 0.45, 0.4}), {2.0 * k, 0, 0});
    row.add(shapes::sphere(Vec3::Zero(), 0.6, 12), {2.0 * k + 1, 0.1, 0.05});
  }
  const RepairResult result = repaired(row);
  ASSERT_EQ(result.status, Status::embedded);
  const Positions x = Eigen::Map<const Positions>(result.positions.data(), 3, row.positions().cols());
  for (std::size_t t = 0; t < row.triangles.size();) {
    const std::vector<Triangle> box(row.triangles.begin() + t, row.triangles.begin() + t + 12);
    EXPECT_GT(signed_volume(x, box), 0.9 * signed_volume(row.positions(), box)) << t;
    t += row.triangles.size() / boxes;
  }
}

TEST(HoldParts, what_is_entered_as_moved_is_all_that_has_moved) {
  StagedRepair repair(box_and_balls().surface());
  untangle_stage(repair.task, repair.control, repair.finders, repair.state);
  EXPECT_EQ(repair.pairs(), 0u);
  EXPECT_EQ(repair.state.recovered, repair.state.moved.size());
  std::vector<std::uint8_t> may_move(static_cast<std::size_t>(repair.state.scene.vertex_count()), 0);
  for (const RepairState::Moved& moved : repair.state.moved) {
    ASSERT_LT(moved.region, repair.state.regions.size());
    EXPECT_GT(repair.state.regions[moved.region].pairs, 0u);
    for (const Index v : moved.vertices) may_move[v] = 1;
  }
  for (Index v = 0; v < repair.state.scene.vertex_count(); ++v)
    EXPECT_TRUE(may_move[v] || repair.state.scene.x.col(v) == repair.state.scene.rest.col(v)) << v;
}

TEST(HoldParts, goes_no_farther_than_is_allowed) {
  const shapes::Shape shape = box_and_balls();
  const RepairResult free = repaired(shape);
  RepairOptions options;
  options.max_displacement_rel = 1.01 * free.report.displacement_max_rel;
  const RepairResult bounded = repaired(shape, options);
  EXPECT_EQ(bounded.status, Status::embedded);
  EXPECT_LE(bounded.report.displacement_max_rel, options.max_displacement_rel);
}

TEST(HoldParts, the_recording_ends_where_the_result_is) {
  RepairOptions options;
  options.record.frames = 5;
  options.record.history = true;
  const Surface surface = box_and_balls().surface();
  const RepairResult result = repair(surface, options);
  std::vector<double> positions = surface.positions;
  for (const RecordedFrame& frame : result.frames)
    for (std::size_t k = 0; k < frame.displacements.size(); ++k) {
      const std::size_t at = 3 * static_cast<std::size_t>(frame.vertices[k / 3]) + k % 3;
      positions[at] = surface.positions[at] + frame.displacements[k];
    }
  ASSERT_NE(positions, surface.positions);
  for (std::size_t k = 0; k < positions.size(); ++k) EXPECT_NEAR(positions[k], result.positions[k], 1e-12);
  for (const RegionHistory& history : result.report.history) {
    if (history.phase != "untangle") continue;
    ASSERT_LT(history.region, result.report.regions.size());
    EXPECT_EQ(history.strategy, result.report.regions[history.region].strategy);
  }
}

TEST(HoldParts, the_same_bytes_at_any_number_of_threads) {
  RepairOptions one, two;
  one.find.threads = 1;
  two.find.threads = 2;
  EXPECT_EQ(repaired(box_and_balls(), one).positions, repaired(box_and_balls(), two).positions);
}

TEST(HoldParts, components_that_are_alike_are_repaired_once) {
  StagedRepair repair(shapes::two_spheres(12).surface());
  untangle_stage(repair.task, repair.control, repair.finders, repair.state);
  const Positions x = repair.state.scene.x;
  repair.state.recovered = 0;
  SceneIndex index(repair.state.scene, repair.finders.as_is);
  EXPECT_TRUE(hold_parts(repair.task, repair.control, {}, index, repair.state).empty());
  EXPECT_EQ(repair.state.scene.x, x);
}

}  // namespace
}  // namespace unsnarl
