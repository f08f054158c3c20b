#include "report/measure.h"

#include <gtest/gtest.h>

#include <limits>

#include "scene/shapes.h"

namespace unsnarl {
namespace {

Surface cube() {
  return {{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1, 1, 1, 1},
          {0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5},
          {0, 4, 8, 12, 16, 20, 24}};
}

RepairReport measured(const Surface& surface, const std::vector<double>& positions) {
  const PreparedSurface prepared = prepare(surface, {});
  IntersectionFinder finder(prepared.triangles());
  RepairReport report;
  measure_change(surface, prepared, diagnose(surface, prepared, {}, finder), positions, report);
  return report;
}

TEST(Measure, nothing_moved) {
  const Surface surface = cube();
  const RepairReport report = measured(surface, surface.positions);
  EXPECT_DOUBLE_EQ(report.diagonal, std::sqrt(3.0));
  EXPECT_EQ(report.displacement_max_rel, 0);
  EXPECT_EQ(report.displacement_mean_rel, 0);
  EXPECT_EQ(report.displacement_rms_rel, 0);
  EXPECT_EQ(report.untouched_share, 1);
  EXPECT_EQ(report.flipped_triangles, 0u);
  EXPECT_EQ(report.volume_change_rel, 0);
  EXPECT_EQ(report.area_change_rel, 0);
  EXPECT_EQ(report.edge_stretch_max, 1);
  EXPECT_EQ(report.edge_stretch_p999, 1);
  EXPECT_EQ(report.displacement_lower_bound_rel, 0);
}

TEST(Measure, displacement_relative_to_the_diagonal) {
  const Surface surface = cube();
  std::vector<double> moved = surface.positions;
  moved[0] -= 0.3, moved[1] -= 0.4;  // by 0.5
  const RepairReport report = measured(surface, moved);
  const double unit = 1 / std::sqrt(3.0);
  EXPECT_DOUBLE_EQ(report.displacement_max_rel, 0.5 * unit);
  EXPECT_DOUBLE_EQ(report.displacement_mean_rel, 0.5 / 8 * unit);
  EXPECT_DOUBLE_EQ(report.displacement_rms_rel, 0.5 / std::sqrt(8.0) * unit);
  EXPECT_DOUBLE_EQ(report.untouched_share, 7.0 / 8);
}

TEST(Measure, the_motion_by_area_does_not_depend_on_where_vertices_are) {
  const auto square_and_fine = [](Index cells) {
    return shapes::grid(cells, cells, false, [&](double i, double j) { return Vec3(i / cells, j / cells, 0); });
  };
  for (const Index cells : {1, 8}) {  // one of two squares goes up by 0.5
    const shapes::Shape still = square_and_fine(3), lifted = square_and_fine(cells);
    const Surface surface = shapes::Shape(still).add(lifted, Vec3(2, 0, 0)).surface();
    std::vector<double> moved = surface.positions;
    for (std::size_t v = still.points.size(); v < moved.size() / 3; ++v) moved[3 * v + 2] += 0.5;
    const RepairReport report = measured(surface, moved);
    EXPECT_NEAR(report.displacement_area_rms_rel * report.diagonal, 0.5 / std::sqrt(2.0), 1e-12);
  }
}

TEST(Measure, volume_and_area) {
  const Surface surface = cube();
  std::vector<double> grown = surface.positions;
  for (double& c : grown) c = 2 * c - 7;
  const RepairReport report = measured(surface, grown);
  EXPECT_NEAR(report.volume_change_rel, 7, 1e-12);
  EXPECT_NEAR(report.area_change_rel, 3, 1e-12);
  EXPECT_EQ(report.flipped_triangles, 0u);
}

TEST(Measure, flipped_triangles_and_whether_they_had_to) {
  // A crossing pair far from a flat sheet; turning a corner of the sheet over has no conflict for an excuse.
  const shapes::Shape shape = shapes::Shape(shapes::bumpy_sheet(2, 0)).add(shapes::crossed_squares(), {30, 0, 0});
  const Surface surface = shape.surface();
  std::vector<double> positions = surface.positions;
  positions[0] = 0.6, positions[1] = 0.5;  // vertex 0 over the diagonal of its cell
  RepairReport report = measured(surface, positions);
  EXPECT_EQ(report.flipped_triangles, 2u);
  EXPECT_EQ(report.flipped_triangles_without_conflict, 2u);
  for (std::size_t v = 9; v < 13; ++v) positions[3 * v] = 60 - positions[3 * v];  // mirrors the square that is pierced
  report = measured(surface, positions);
  EXPECT_EQ(report.flipped_triangles, 4u);
  EXPECT_LE(report.flipped_triangles_without_conflict, 3u);
}

TEST(Measure, edge_stretch_counts_both_ways) {
  const Surface surface = cube();
  std::vector<double> wide = surface.positions, narrow = surface.positions;
  for (std::size_t v = 0; v < 8; ++v) wide[3 * v] *= 4, narrow[3 * v] *= 0.25;
  for (const auto& positions : {wide, narrow}) {
    EXPECT_DOUBLE_EQ(measured(surface, positions).edge_stretch_max, 4);
    EXPECT_DOUBLE_EQ(measured(surface, positions).edge_stretch_p999, 4) << "19 edges: none may be left out";
  }
  for (int k = 0; k < 3; ++k) narrow[k] = narrow[3 + k];  // vertex 0 onto vertex 1
  EXPECT_EQ(measured(surface, narrow).edge_stretch_max, std::numeric_limits<double>::infinity());
}

TEST(Measure, one_needle_does_not_decide_the_percentile) {
  const Surface surface = shapes::bumpy_sheet(30, 0).surface();  // 2760 edges, 2 of them at the corner 30
  std::vector<double> moved = surface.positions;
  moved[3 * 30] -= 9;
  const RepairReport report = measured(surface, moved);
  EXPECT_GT(report.edge_stretch_max, 5);
  EXPECT_EQ(report.edge_stretch_p999, 1);
}

TEST(Measure, lower_bound_is_half_the_deepest_overlap) {
  // A triangle in the plane z = 0 and one through its middle that reaches 0.2 below it.
  const Surface surface = shapes::Shape{
      {{-3, -3, 0}, {3, -3, 0}, {0, 5, 0}, {-0.5, 0, -0.2}, {0.5, 0, -0.2}, {0, 0, 3}},
      {{0, 1, 2}, {3, 4, 5}}}.surface();
  const RepairReport report = measured(surface, surface.positions);
  EXPECT_NEAR(report.displacement_lower_bound_rel * report.diagonal, 0.1, 1e-12);
  const RepairResult repaired = repair(surface);
  ASSERT_EQ(repaired.status, Status::embedded);
  EXPECT_GE(repaired.report.displacement_max_rel, report.displacement_lower_bound_rel);
}

}  // namespace
}  // namespace unsnarl
