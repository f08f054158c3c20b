// Parts that move as bodies, judged by CGAL.
#include "pipeline/rigid_stage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "pipeline/judged.h"
#include "rigid/boxes.h"
#include "unsnarl/parts.h"
#include "unsnarl/samples.h"

namespace unsnarl {
namespace {

using shapes::Shape;

/// How far the vertices of a part are from R p + t, as its report says, at most: measured anew.
double residual(const Surface& surface, const RepairResult& result, const RepairOptions& options, std::int32_t part) {
  const RigidPartReport& motion = result.report.rigid_parts[static_cast<std::size_t>(part)];
  const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> rotation(motion.rotation.data());
  const Eigen::Map<const Vec3> translation(motion.translation.data());
  double largest = 0;
  for (std::size_t v = 0; v < options.rigid.size(); ++v) {
    if (options.rigid[v] != part) continue;
    const Eigen::Map<const Vec3> before(&surface.positions[3 * v]), after(&result.positions[3 * v]);
    largest = std::max(largest, (after - (rotation * before + translation)).norm());
  }
  EXPECT_LT((rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-12);
  EXPECT_NEAR(rotation.determinant(), 1, 1e-12);
  return largest;
}

/// One number a vertex, those of components; the component `fixed` is flagged instead.
RepairOptions components_rigid(const Surface& surface, std::int32_t count, std::int32_t fixed) {
  RepairOptions options;
  options.rigid.assign(surface.view().vertex_count(), -1);
  for (std::int32_t c = 0; c < count; ++c) {
    const auto flags = vertices_of_faces(surface, faces_in_parts(surface, {}, {.components = {c}}));
    if (c == fixed) options.fixed = flags;
    for (std::size_t v = 0; v < flags.size(); ++v)
      if (flags[v] && c != fixed) options.rigid[v] = c - (fixed >= 0 && c > fixed);
  }
  return options;
}

TEST(RigidParts, two_boxes_are_parted_by_about_the_least_motion) {
  Shape shape = shapes::box({1, 1, 1}, 4);
  shape.add(shapes::box({1, 1, 1}, 4), {0.9, 0.02, 0.03});
  const Surface surface = shape.surface();
  const RepairOptions options = components_rigid(surface, 2, -1);
  const RepairResult result = repair(surface, options);
  ASSERT_EQ(result.status, Status::embedded) << to_string(result.status);
  EXPECT_TRUE(judged(surface, result.positions).empty());
  ASSERT_EQ(result.report.rigid_parts.size(), 2u);
  const double diagonal = result.report.diagonal;
  for (std::int32_t part = 0; part < 2; ++part) {
    const RigidPartReport& report = result.report.rigid_parts[static_cast<std::size_t>(part)];
    EXPECT_EQ(report.name, std::to_string(part));
    EXPECT_EQ(report.vertices, surface.view().vertex_count() / 2);
    EXPECT_LT(report.residual_rel, 4e-7);  // 32 bits
    EXPECT_NEAR(report.residual_rel * diagonal, residual(surface, result, options, part), 1e-12);
  }
  const double sum = result.report.rigid_parts[0].translation_rel + result.report.rigid_parts[1].translation_rel;
  EXPECT_GE(sum * diagonal, 0.095);
  EXPECT_LT(sum * diagonal, 0.105);
  EXPECT_LT(result.report.before.total(), 1000u);
  EXPECT_GT(result.report.before.total(), 0u);
  EXPECT_GT(result.report.displacement_max_rel, 0);
}

TEST(RigidParts, soft_regions_are_measured_by_the_diagonal_of_the_input) {
  // Two boxes that go apart, so that the diagonal grows, and two soft ones that run through each other elsewhere.
  Shape shape = shapes::box({1, 1, 1}, 4);
  shape.add(shapes::box({1, 1, 1}, 4), {0.5, 0.02, 0.03});
  shape.add(shapes::box({0.2, 0.2, 0.2}, 4), {0.1, 1.2, 0});
  shape.add(shapes::box({0.2, 0.2, 0.2}, 4), {0.28, 1.21, 0.03});
  const Surface surface = shape.surface();
  RepairOptions options = components_rigid(surface, 2, -1);
  options.precision = Precision::float64;  // regions are measured before rounding
  const RepairResult result = repair(surface, options);
  ASSERT_EQ(result.status, Status::embedded);
  const RepairReport& report = result.report;
  ASSERT_EQ(report.regions.size(), 1u);
  const double diagonal = diagonal_of(surface.view());
  EXPECT_EQ(report.diagonal, diagonal);
  EXPECT_GT(diagonal_of({result.positions, surface.corners, surface.offsets}), 1.05 * diagonal)
      << "the test tests nothing";
  double largest = 0;
  for (std::size_t v = 0; v < surface.view().vertex_count(); ++v)
    if (options.rigid[v] < 0)
      largest = std::max(largest, (Eigen::Map<const Vec3>(&result.positions[3 * v]) -
                                   Eigen::Map<const Vec3>(&surface.positions[3 * v]))
                                      .norm());
  EXPECT_GT(largest, 0);
  EXPECT_NEAR(report.regions[0].displacement_rel * diagonal, largest, 1e-12);
}

TEST(RigidParts, double_precision_is_rigid_to_its_last_digits) {
  Shape shape = shapes::box({1, 1, 1}, 3);
  shape.add(shapes::turned(shapes::box({1, 1, 1}, 3), 0.3), {0.9, 0.02, 0.03});
  const Surface surface = shape.surface();
  RepairOptions options = components_rigid(surface, 2, 0);
  options.precision = Precision::float64;
  const RepairResult result = repair(surface, options);
  ASSERT_EQ(result.status, Status::embedded) << to_string(result.status);
  EXPECT_LT(result.report.rigid_parts[0].residual_rel, 1e-15);
}

TEST(RigidParts, a_scene_of_fixed_rigid_and_soft_parts) {
  const Surface surface = make_sample("anchor_scene");
  RepairOptions options = components_rigid(surface, 5, 0);
  options.rigid_names = {"link", "hoop", "crate", "barrel"};
  std::vector<double> one_thread;
  for (const int threads : {1, 2}) {
    options.find.threads = threads;
    const RepairResult result = repair(surface, options);
    ASSERT_EQ(result.status, Status::embedded) << to_string(result.status);
    EXPECT_TRUE(judged(surface, result.positions).empty());
    ASSERT_EQ(result.report.rigid_parts.size(), 4u);
    EXPECT_EQ(result.report.rigid_parts[2].name, "crate");
    for (std::int32_t part = 0; part < 4; ++part) {
      EXPECT_GT(result.report.rigid_parts[static_cast<std::size_t>(part)].translation_rel, 1e-4);
      EXPECT_LT(residual(surface, result, options, part), 1e-6);
    }
    for (std::size_t v = 0; v < options.fixed.size(); ++v) {
      const double *const before = &surface.positions[3 * v], *const after = &result.positions[3 * v];
      EXPECT_TRUE(!options.fixed[v] || std::equal(before, before + 3, after)) << v;
    }
    if (threads == 1) one_thread = result.positions;
    EXPECT_EQ(result.positions, one_thread);
  }
  // What is embedded stays.
  Surface again = surface;
  again.positions = one_thread;
  const RepairResult second = repair(again, options);
  EXPECT_EQ(second.status, Status::embedded);
  EXPECT_EQ(second.positions, again.positions);
}

TEST(RigidParts, what_is_soft_gives_way) {
  Shape shape = shapes::bumpy_sheet(16, 1.3);
  const std::size_t soft = shape.points.size();
  shape.add(shapes::box({3, 3, 1.0}, 3), {0.21, 0.13, 1.4});
  const Surface surface = shape.surface();
  RepairOptions options;
  options.rigid.assign(surface.view().vertex_count(), -1);
  std::fill(options.rigid.begin() + static_cast<std::ptrdiff_t>(soft), options.rigid.end(), 0);
  const RepairResult result = repair(surface, options);
  ASSERT_EQ(result.status, Status::embedded) << to_string(result.status);
  EXPECT_TRUE(judged(surface, result.positions).empty());
  EXPECT_EQ(result.report.rigid_parts[0].translation_rel, 0);
  EXPECT_EQ(result.report.rigid_parts[0].residual_rel, 0);
  EXPECT_TRUE(std::equal(surface.positions.begin() + 3 * static_cast<std::ptrdiff_t>(soft), surface.positions.end(),
                         result.positions.begin() + 3 * static_cast<std::ptrdiff_t>(soft)));
}

TEST(RigidParts, move_where_what_is_soft_cannot_give_way) {
  // A sheet through the middle of a box, held at three of four vertices: no triangle is fixed, but none can leave.
  Shape shape = shapes::bumpy_sheet(8, 0.0);
  const std::size_t sheet = shape.points.size();
  shape.add(shapes::box({3.1, 3.3, 1}, 3), {0.21, 0.13, 0.4});
  const Surface surface = shape.surface();
  RepairOptions options;
  options.fixed.assign(surface.view().vertex_count(), 0);
  options.rigid.assign(surface.view().vertex_count(), 0);
  for (std::size_t v = 0; v < sheet; ++v) {
    options.rigid[v] = -1;
    const auto row = v / 9, column = v % 9;
    options.fixed[v] = (row + column) % 2 == 0 || row % 2 == 0;
  }
  const RepairResult result = repair(surface, options);
  EXPECT_EQ(result.status, Status::embedded) << to_string(result.status);
  EXPECT_TRUE(judged(surface, result.positions).empty());
  EXPECT_GT(result.report.rigid_parts[0].translation_rel, 0);
}

TEST(RigidParts, what_intersects_within_one_is_named_and_blocks_nothing) {
  Shape shape = shapes::crossed_squares();
  const std::size_t part = shape.points.size();
  shape.add(shapes::crossing_bumps(8, 0.3), {30, 0, 0});
  const Surface surface = shape.surface();
  RepairOptions options;
  options.rigid.assign(surface.view().vertex_count(), -1);
  std::fill_n(options.rigid.begin(), part, 0);
  options.rigid_names = {"cross"};
  const RepairResult result = repair(surface, options);
  EXPECT_EQ(result.status, Status::obstructed) << to_string(result.status);
  ASSERT_EQ(result.report.obstructions.size(), 1u);
  EXPECT_EQ(result.report.obstructions[0].kind, Obstruction::Kind::rigid_faces);
  EXPECT_NE(result.report.obstructions[0].message.find("cross"), std::string::npos);
  for (const IntersectingPair& pair : judged(surface, result.positions)) EXPECT_LT(std::max(pair.a, pair.b), 4);
  EXPECT_EQ(result.report.left_by_reason[static_cast<std::size_t>(LeftReason::rigid_faces)],
            result.report.after.total());
}

TEST(RigidParts, go_no_farther_than_allowed) {
  Shape shape = shapes::box({1, 1, 1}, 3);
  shape.add(shapes::box({1, 1, 1}, 3), {0.7, 0.02, 0.03});
  const Surface surface = shape.surface();
  RepairOptions options = components_rigid(surface, 2, -1);
  options.max_displacement_rel = 0.01;
  const RepairResult result = repair(surface, options);
  EXPECT_EQ(result.status, Status::displacement_exceeded) << to_string(result.status);
  EXPECT_EQ(result.positions, surface.positions);
  EXPECT_EQ(result.report.left_by_reason[static_cast<std::size_t>(LeftReason::displacement)],
            result.report.after.total());
}

TEST(RigidParts, recordings_begin_with_the_input) {
  Shape shape = shapes::box({1, 1, 1}, 3);
  shape.add(shapes::box({1, 1, 1}, 3), {0.9, 0.02, 0.03});
  const Surface surface = shape.surface();
  RepairOptions options = components_rigid(surface, 2, 0);
  options.record = {.history = true, .frames = 10};
  const RepairResult result = repair(surface, options);
  ASSERT_GE(result.frames.size(), 3u);
  EXPECT_EQ(result.frames[0].phase, "input");
  EXPECT_EQ(result.frames[0].pairs, result.report.before.total());
  EXPECT_EQ(result.frames[1].strategy, "place");
  EXPECT_EQ(result.frames[1].vertices.size(), surface.view().vertex_count() / 2);
  EXPECT_EQ(result.frames.back().pairs, 0u);
}

TEST(RigidParts, what_makes_no_sense_is_refused) {
  const Surface surface = shapes::box({1, 1, 1}, 2).surface();
  RepairOptions options;
  options.rigid = {0};
  EXPECT_THROW(repair(surface, options), std::invalid_argument);
  options.rigid.assign(surface.view().vertex_count(), 0);
  options.rigid[3] = -2;
  EXPECT_THROW(repair(surface, options), std::invalid_argument);
  options.rigid[3] = 0;
  options.fixed.assign(surface.view().vertex_count(), 0);
  options.fixed[3] = 1;
  EXPECT_THROW(repair(surface, options), std::invalid_argument);
  options.fixed.clear();
  options.each_component = true;
  EXPECT_THROW(repair(surface, options), std::invalid_argument);
}

}  // namespace
}  // namespace unsnarl
