#include "repair/measure.h"

#include <gtest/gtest.h>

#include "repair/shapes.h"

namespace unsnarl {
namespace {

Surface cube() {
  return {{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1, 1, 1, 1},
          {0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5},
          {0, 4, 8, 12, 16, 20, 24}};
}

RepairReport measured(const Surface& surface, const std::vector<double>& positions) {
  const PreparedSurface prepared = prepare(surface, {});
  RepairReport report;
  measure_change(surface, prepared, diagnose(surface, prepared, {}), positions, report);
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
  EXPECT_EQ(report.turned_triangles, 0u);
  EXPECT_EQ(report.volume_change_rel, 0);
  EXPECT_EQ(report.area_change_rel, 0);
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

TEST(Measure, volume_and_area) {
  const Surface surface = cube();
  std::vector<double> grown = surface.positions;
  for (double& c : grown) c = 2 * c - 7;
  const RepairReport report = measured(surface, grown);
  EXPECT_NEAR(report.volume_change_rel, 7, 1e-12);
  EXPECT_NEAR(report.area_change_rel, 3, 1e-12);
  EXPECT_EQ(report.turned_triangles, 0u);
}

TEST(Measure, turned_triangles_and_whether_they_had_to) {
  // A crossing pair far from a flat sheet; turning a corner of the sheet over has no conflict for an excuse.
  const shapes::Shape shape = shapes::Shape(shapes::bumpy_sheet(2, 0)).add(shapes::crossed_squares(), {30, 0, 0});
  const Surface surface = shape.surface();
  std::vector<double> positions = surface.positions;
  positions[0] = 0.6, positions[1] = 0.5;  // vertex 0 over the diagonal of its cell
  RepairReport report = measured(surface, positions);
  EXPECT_EQ(report.turned_triangles, 2u);
  EXPECT_EQ(report.turned_triangles_without_conflict, 2u);
  for (std::size_t v = 9; v < 13; ++v) positions[3 * v] = 60 - positions[3 * v];  // mirrors the square that is pierced
  report = measured(surface, positions);
  EXPECT_EQ(report.turned_triangles, 4u);
  EXPECT_LE(report.turned_triangles_without_conflict, 3u);
}

TEST(Measure, memory) {
  EXPECT_GT(resident_memory_mb(), 1);
  EXPECT_GE(peak_memory_mb(), 0.5 * resident_memory_mb());
}

}  // namespace
}  // namespace unsnarl
