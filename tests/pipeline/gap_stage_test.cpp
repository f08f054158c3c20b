// Gaps that are kept everywhere; distances are measured anew, by measure_clearance().
#include "pipeline/gap_stage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <vector>

#include "pipeline/judged.h"
#include "rigid/boxes.h"
#include "unsnarl/certify.h"
#include "unsnarl/clearance.h"
#include "unsnarl/exit_code.h"
#include "unsnarl/repair.h"

namespace unsnarl {
namespace {

using shapes::Shape;

/// Boxes of side 1 beside each other in x, `gap` apart.
Surface boxes(int count, double gap, Index cells) {
  Shape shape;
  for (int k = 0; k < count; ++k) shape.add(shapes::box({1, 1, 1}, cells), {k * (1 + gap), 0, 0});
  return shape.surface();
}

RepairOptions with_gap(const Surface& surface, double length) {
  RepairOptions options;
  options.min_gap_rel = length / diagonal_of(surface);
  return options;
}

/// A strip that turns back at distance `gap` and runs beside itself for the length 1; cells of a side of 1 / n.
Surface folded_strip(Index n, double gap) {
  const auto turn = static_cast<Index>(std::ceil(gap * n * 1.5708)) + 2;
  return shapes::grid(2 * n + turn, n / 2, false,
                      [=](double i, double j) {
                        const double r = 0.5 * gap, along = i < n ? i - n : i > n + turn ? n + turn - i : 0;
                        const double angle = 3.14159265358979 * std::clamp((i - n) / turn, 0.0, 1.0);
                        return Vec3(along / n + r * std::sin(angle), j / n, r * (1 - std::cos(angle)));
                      })
      .surface();
}

double component_gap(const Surface& surface, const RepairResult& result) {
  return measure_clearance(surface, result.positions).component_gap;
}

TEST(GapStage, gaps_are_opened_where_nothing_intersects) {
  for (const Index cells : {2, 6}) {
    const Surface surface = boxes(2, 0.001, cells);
    const RepairResult result = repair(surface, with_gap(surface, 0.05));
    EXPECT_EQ(result.status, Status::embedded) << to_string(result.status);
    EXPECT_GE(component_gap(surface, result), 0.99 * 0.05);
    ASSERT_TRUE(result.report.gap);
    EXPECT_TRUE(result.report.gap->is_met());
    EXPECT_NEAR(result.report.gap->smallest_rel * result.report.diagonal, component_gap(surface, result), 1e-12);
    EXPECT_LT(result.report.displacement_max_rel * result.report.diagonal, 0.06);
    EXPECT_LT(result.report.untouched_share, 1);
    EXPECT_GT(result.report.untouched_share, 0.3);  // the far sides stay
    EXPECT_TRUE(judged(surface, result.positions).empty());
  }
}

TEST(GapStage, what_is_wide_enough_stays_bit_for_bit) {
  const Surface surface = boxes(2, 0.06, 6);
  const RepairResult result = repair(surface, with_gap(surface, 0.05));
  EXPECT_EQ(result.status, Status::embedded);
  EXPECT_EQ(result.positions, surface.positions);
  ASSERT_TRUE(result.report.gap);
  EXPECT_NEAR(result.report.gap->smallest_rel * result.report.diagonal, 0.06, 1e-12);
  const Surface alone = boxes(1, 0, 6);
  const RepairResult of_alone = repair(alone, with_gap(alone, 0.3));
  EXPECT_EQ(of_alone.positions, alone.positions);
  EXPECT_TRUE(std::isinf(of_alone.report.gap->smallest_rel));
}

TEST(GapStage, near_conflicts_alone_nothing_else_moves_and_nothing_is_measured) {
  const Surface surface = boxes(2, 0.001, 6);
  RepairOptions options = with_gap(surface, 0.05);
  options.gap_near_conflicts = true;
  const RepairResult result = repair(surface, options);
  EXPECT_EQ(result.status, Status::embedded);
  EXPECT_EQ(result.positions, surface.positions);
  EXPECT_FALSE(result.report.gap);
}

TEST(GapStage, between_what_is_fixed_it_is_named) {
  const Surface surface = boxes(2, 0.001, 4);
  RepairOptions options = with_gap(surface, 0.05);
  options.fixed.assign(surface.view().vertex_count(), 1);
  const RepairResult held = repair(surface, options);
  EXPECT_EQ(held.status, Status::gap_not_met);
  EXPECT_EQ(exit_code_of(held.status), 10);
  EXPECT_EQ(held.positions, surface.positions);
  ASSERT_TRUE(held.report.gap);
  EXPECT_TRUE(held.report.gap->is_between_held);
  EXPECT_NEAR(held.report.gap->smallest_rel * held.report.diagonal, 0.001, 1e-12);
  EXPECT_NEAR(held.report.gap->position[0], 0.5005, 1e-12);
  EXPECT_NE(held.report.gap->faces[0], held.report.gap->faces[1]);

  std::fill_n(options.fixed.begin(), options.fixed.size() / 2, std::uint8_t{0});
  const RepairResult one_moves = repair(surface, options);
  EXPECT_EQ(one_moves.status, Status::embedded);
  EXPECT_GE(component_gap(surface, one_moves), 0.99 * 0.05);
  EXPECT_TRUE(std::equal(surface.positions.begin() + static_cast<std::ptrdiff_t>(surface.positions.size() / 2),
                         surface.positions.end(),
                         one_moves.positions.begin() + static_cast<std::ptrdiff_t>(surface.positions.size() / 2)));
}

/// Which box each face of boxes(count, ..., cells) is of.
std::vector<std::int32_t> box_of_face(const Surface& surface, int count) {
  const std::size_t faces = surface.view().face_count();
  std::vector<std::int32_t> boxes(faces);
  for (std::size_t f = 0; f < faces; ++f) boxes[f] = static_cast<std::int32_t>(f * count / faces);
  return boxes;
}

TEST(GapStage, progress_names_the_stage) {
  const Surface surface = boxes(2, 0.001, 4);
  std::vector<std::string_view> phases;
  std::vector<double> fractions;
  Context context;
  context.on_progress = [&](const Context::Progress& progress) {
    phases.push_back(progress.phase);
    fractions.push_back(progress.fraction);
  };
  const RepairResult result = repair(surface, with_gap(surface, 0.05), &context);
  EXPECT_NE(std::find(phases.begin(), phases.end(), "open_gaps"), phases.end());
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  const auto is_named = [](const StageReport& stage) { return stage.name == "open_gaps"; };
  EXPECT_TRUE(std::any_of(result.report.stages.begin(), result.report.stages.end(), is_named));
}

TEST(GapStage, what_may_pass_keeps_no_gap_and_others_do) {
  const Surface surface = boxes(3, 0.001, 4);
  const std::size_t size = surface.positions.size() / 3;
  RepairOptions options = with_gap(surface, 0.05);
  options.find.allowed = {box_of_face(surface, 3), {{0, 1}}};
  const RepairResult result = repair(surface, options);
  EXPECT_EQ(result.status, Status::embedded) << to_string(result.status);
  EXPECT_TRUE(std::equal(surface.positions.begin(), surface.positions.begin() + static_cast<std::ptrdiff_t>(size),
                         result.positions.begin()));
  EXPECT_NEAR(component_gap(surface, result), 0.001, 1e-12);  // of the two that may pass
  ASSERT_TRUE(result.report.gap);
  EXPECT_TRUE(result.report.gap->is_met());
  const GapReport left =
      measure_gap({result.positions, surface.corners, surface.offsets}, options.min_gap_rel, options.find);
  EXPECT_TRUE(left.is_met());
  EXPECT_FALSE(measure_gap(surface, options.min_gap_rel, options.find).is_met());

  options.find.allowed.parts.push_back({1, 2});
  const RepairResult of_all = repair(surface, options);
  EXPECT_EQ(of_all.status, Status::embedded);
  EXPECT_EQ(of_all.positions, surface.positions);
}

TEST(GapStage, what_passes_comes_before_a_gap_that_is_not_met) {
  Surface surface = boxes(3, 0.001, 4);
  const std::size_t size = surface.positions.size() / 3;
  for (std::size_t k = 0; k < size; k += 3) surface.positions[k] += 0.1;  // into the second
  RepairOptions options = with_gap(surface, 0.05);
  options.find.allowed = {box_of_face(surface, 3), {{0, 1}}};
  const RepairResult result = repair(surface, options);
  EXPECT_EQ(result.status, Status::allowed) << to_string(result.status);
  ASSERT_TRUE(result.report.gap);
  EXPECT_TRUE(result.report.gap->is_met());
  options.fixed.assign(surface.view().vertex_count(), 1);
  const RepairResult held = repair(surface, options);
  EXPECT_EQ(held.status, Status::allowed) << to_string(held.status);
  EXPECT_EQ(held.positions, surface.positions);
  ASSERT_TRUE(held.report.gap);
  EXPECT_FALSE(held.report.gap->is_met());
  EXPECT_NEAR(held.report.gap->smallest_rel * held.report.diagonal, 0.001, 1e-12);
}

TEST(GapStage, rigid_parts_go_apart_as_bodies) {
  const Surface surface = boxes(3, 0.001, 2);
  RepairOptions options = with_gap(surface, 0.05);
  const std::size_t n = surface.view().vertex_count() / 3;
  options.rigid.resize(3 * n);
  for (std::size_t v = 0; v < 3 * n; ++v) options.rigid[v] = static_cast<std::int32_t>(v / n);
  const RepairResult result = repair(surface, options);
  EXPECT_EQ(result.status, Status::embedded) << to_string(result.status);
  EXPECT_GE(component_gap(surface, result), 0.99 * 0.05);
  for (const RigidPartReport& part : result.report.rigid_parts) EXPECT_LT(part.residual_rel, 1e-6);
}

TEST(GapStage, a_sheet_keeps_the_gap_to_itself) {
  const Surface surface = folded_strip(24, 0.04);
  const RepairResult result = repair(surface, with_gap(surface, 0.06));
  EXPECT_EQ(result.status, Status::embedded) << to_string(result.status);
  const GapReport before = measure_gap(surface, with_gap(surface, 0.06).min_gap_rel);
  EXPECT_FALSE(before.is_met());
  EXPECT_TRUE(result.report.gap->is_met());
  EXPECT_LT(result.report.displacement_max_rel * result.report.diagonal, 0.06);
}

TEST(GapStage, nothing_goes_farther_than_allowed) {
  const Surface surface = boxes(2, 0.001, 6);
  RepairOptions options = with_gap(surface, 0.05);
  options.max_displacement_rel = 0.2 * options.min_gap_rel;
  const RepairResult result = repair(surface, options);
  EXPECT_EQ(result.status, Status::gap_not_met) << to_string(result.status);
  EXPECT_LE(result.report.displacement_max_rel, options.max_displacement_rel);
  EXPECT_FALSE(result.report.gap->is_between_held);
}

TEST(GapStage, components_that_are_each_alone_need_no_gap_between_them) {
  const Surface surface = boxes(2, 0.001, 6);
  RepairOptions options = with_gap(surface, 0.05);
  options.each_component = true;
  const RepairResult result = repair(surface, options);
  EXPECT_EQ(result.status, Status::embedded);
  EXPECT_EQ(result.positions, surface.positions);
}

TEST(GapStage, what_cannot_be_repaired_is_said_before_a_gap) {
  Surface surface = boxes(2, 0.001, 2);
  const std::vector<std::int32_t> face(surface.corners.begin(), surface.corners.begin() + 3);
  surface.corners.insert(surface.corners.end(), face.begin(), face.end());  // twice the same
  RepairOptions options = with_gap(surface, 0.05);
  options.fixed.assign(surface.view().vertex_count(), 1);
  EXPECT_EQ(repair(surface, options).status, Status::obstructed);
}

TEST(GapStage, gaps_beside_conflicts_are_opened_too) {
  Surface surface = shapes::crossing_bumps(12, 0.3).surface();
  const Surface pair = boxes(2, 0.001, 4);
  const auto first = static_cast<std::int32_t>(surface.view().vertex_count());
  for (std::size_t k = 0; k < pair.positions.size(); ++k)
    surface.positions.push_back(pair.positions[k] + (k % 3 == 0 ? 30 : 0));
  for (const std::int32_t v : pair.corners) surface.corners.push_back(first + v);
  const RepairResult result = repair(surface, with_gap(surface, 0.05));
  EXPECT_EQ(result.status, Status::embedded) << to_string(result.status);
  EXPECT_GT(result.report.before.total(), 0u);
  EXPECT_GE(component_gap(surface, result), 0.99 * 0.05);
  EXPECT_TRUE(judged(surface, result.positions).empty());
}

TEST(GapStage, gives_the_same_bytes_at_any_number_of_threads) {
  const Surface surface = boxes(3, 0.001, 6);
  RepairOptions options = with_gap(surface, 0.05);
  options.find.threads = 1;
  const RepairResult one = repair(surface, options);
  options.find.threads = 4;
  const RepairResult four = repair(surface, options);
  EXPECT_EQ(one.positions, four.positions);
  EXPECT_EQ(one.report.gap->smallest_rel, four.report.gap->smallest_rel);
  EXPECT_EQ(one.report.gap->faces, four.report.gap->faces);
}

TEST(GapStage, a_gap_that_is_no_number_is_refused) {
  const Surface surface = boxes(1, 0, 1);
  for (const double gap : {-1.0, std::nan("")}) EXPECT_THROW(measure_gap(surface, gap), std::invalid_argument);
}

}  // namespace
}  // namespace unsnarl
