// Faces that are folded together are opened, as far as nothing is in the way.
#include "pipeline/dihedral_stage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mesh/dihedral_angles.h"
#include "pipeline/stages.h"
#include "scene/shapes.h"

namespace unsnarl {
namespace {

using shapes::Shape;

/// Two triangles at the edge along y, folded together but for this angle.
Surface hinge(double degrees) {
  const double angle = degrees * std::numbers::pi / 180;
  return Shape{{{0, 0, 0}, {0, 1, 0}, {1, 0.5, 0}, {std::cos(angle), 0.5, std::sin(angle)}}, {{0, 1, 2}, {1, 0, 3}}}
      .surface();
}

double smallest_angle_deg(const StagedRepair& repair) {
  return smallest_angle(repair.state.scene.x, hinges_of(repair.state.scene.triangles)).radians * 180 / std::numbers::pi;
}

RepairOptions open_to(double degrees) {
  RepairOptions options;
  options.min_dihedral_deg = degrees;
  return options;
}

TEST(DihedralStage, opens_what_is_folded_closer) {
  StagedRepair repair(hinge(0.2), open_to(2));
  dihedral_stage(repair.task, repair.control, repair.state);
  EXPECT_GE(smallest_angle_deg(repair), 2);
  EXPECT_LT(smallest_angle_deg(repair), 4);
  EXPECT_EQ(repair.pairs(), 0u);
}

TEST(DihedralStage, leaves_what_is_open_or_not_asked_for) {
  for (const double degrees : {0.0, 2.0}) {
    StagedRepair repair(hinge(degrees == 0 ? 0.2 : 3), open_to(degrees));
    dihedral_stage(repair.task, repair.control, repair.state);
    EXPECT_EQ(repair.state.scene.x, repair.state.scene.rest) << degrees;
  }
}

TEST(DihedralStage, keeps_fixed_vertices_where_they_are) {
  RepairOptions options = open_to(2);
  options.fixed = {1, 1, 1, 0};
  StagedRepair repair(hinge(0.2), options);
  dihedral_stage(repair.task, repair.control, repair.state);
  EXPECT_GE(smallest_angle_deg(repair), 2);
  for (Index v = 0; v < 3; ++v) EXPECT_EQ(repair.state.scene.x.col(v), repair.state.scene.rest.col(v));
  options.fixed = {1, 1, 1, 1};
  StagedRepair held(hinge(0.2), options);
  dihedral_stage(held.task, held.control, held.state);
  EXPECT_EQ(held.state.scene.x, held.state.scene.rest);
}

}  // namespace
}  // namespace unsnarl
