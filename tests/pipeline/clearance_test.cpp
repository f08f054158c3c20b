#include "unsnarl/clearance.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "unsnarl/certify.h"
#include "unsnarl/repair.h"
#include "unsnarl/samples.h"

namespace unsnarl {
namespace {

/// A tetrahedron of height `height` over a triangle: folded at three edges by an angle of about `height`.
Surface flat_tetrahedron(double height) {
  return {{0, 0, 0, 1, 0, 0, 0, 1, 0, 0.3, 0.3, height}, {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3}, {}};
}

TEST(Clearance, measures_angles_and_gaps) {
  Surface two = flat_tetrahedron(0.3);
  const Surface other = flat_tetrahedron(0.3);
  for (std::size_t i = 0; i < other.positions.size(); ++i)
    two.positions.push_back(other.positions[i] + (i % 3 == 2 ? -1 : 0));
  for (const std::int32_t v : other.corners) two.corners.push_back(v + 4);
  const Clearance clearance = measure_clearance(two, two.positions);
  // The faces at the edge on the x axis: the base, and one that rises by 0.3 over 0.3.
  EXPECT_NEAR(clearance.dihedral_deg, 45, 1e-12);
  EXPECT_NEAR(clearance.gap, 0.7, 1e-12);
  EXPECT_NEAR(clearance.component_gap, 0.7, 1e-12);
  EXPECT_NE(clearance.component_gap_faces[0], -1);
  std::vector<double> touching = two.positions;
  for (int v = 4; v < 8; ++v) touching[3 * v + 2] += 0.9;
  const Clearance none = measure_clearance(two, touching);
  EXPECT_EQ(none.gap, 0);
  EXPECT_EQ(none.component_gap, 0);
  EXPECT_NEAR(none.dihedral_deg, clearance.dihedral_deg, 1e-9);
}

TEST(Clearance, folded_faces_are_opened_to_the_angle_asked_for) {
  for (const double height : {1e-7, 1e-4, 2e-3}) {
    const Surface thin = flat_tetrahedron(height);
    RepairOptions options;
    options.min_dihedral_deg = 0.5;
    const RepairResult result = repair(thin, options);
    EXPECT_EQ(result.status, Status::embedded);
    EXPECT_LT(measure_clearance(thin, thin.positions).dihedral_deg, 0.5);
    const Clearance after = measure_clearance(thin, result.positions);
    EXPECT_GE(after.dihedral_deg, 0.5) << height;
    EXPECT_LT(after.dihedral_deg, 1) << height;
    EXPECT_LT(result.report.displacement_max_rel, 0.01);
    EXPECT_TRUE(certify(thin, result.positions).embedded());
  }
}

TEST(Clearance, where_each_component_is_alone_others_are_in_the_way_of_no_angle) {
  // Two triangles folded together, and one above and one below them, nearer than the gap once they are open.
  const Surface surface = {{0, 0,  0,    1,   0, 0,    0.5, 1,  0,     0.5, 1,  0.05,  -1,  -1, 0.65,
                            2, -1, 0.65, 0.5, 2, 0.65, -1,  -1, -0.65, 2,   -1, -0.65, 0.5, 2,  -0.65},
                           {0, 1, 2, 0, 3, 1, 4, 5, 6, 7, 8, 9},
                           {}};
  RepairOptions options;
  options.min_dihedral_deg = 60;
  options.min_gap_rel = 0.05;
  EXPECT_LT(measure_clearance(surface, repair(surface, options).positions).dihedral_deg, 60);
  options.each_component = true;
  EXPECT_GE(measure_clearance(surface, repair(surface, options).positions).dihedral_deg, 60);
}

TEST(Clearance, nothing_moves_where_nothing_is_folded_or_all_is_held) {
  RepairOptions options;
  options.min_dihedral_deg = 0.5;
  const Surface open = flat_tetrahedron(0.3);
  EXPECT_EQ(repair(open, options).positions, open.positions);
  const Surface thin = flat_tetrahedron(1e-4);
  options.fixed.assign(4, 1);
  EXPECT_EQ(repair(thin, options).positions, thin.positions);
  options.fixed = {1, 1, 1, 0};
  const RepairResult result = repair(thin, options);
  EXPECT_EQ(std::vector<double>(result.positions.begin(), result.positions.begin() + 9),
            std::vector<double>(thin.positions.begin(), thin.positions.begin() + 9));
  EXPECT_GE(measure_clearance(thin, result.positions).dihedral_deg, 0.5);
  options.min_dihedral_deg = 90;
  EXPECT_THROW(repair(thin, options), std::invalid_argument);
}

TEST(Clearance, repaired_samples_have_the_angle_asked_for) {
  for (const char* name : {"spindle_torus", "intersecting_spheres"}) {
    const Surface surface = make_sample(name, 24);
    RepairOptions options;
    options.min_dihedral_deg = 0.2;
    const RepairResult result = repair(surface, options);
    EXPECT_EQ(result.status, Status::embedded) << name;
    EXPECT_GE(measure_clearance(surface, result.positions).dihedral_deg, 0.2) << name;
    EXPECT_TRUE(certify(surface, result.positions).embedded()) << name;
  }
}

TEST(Clearance, opening_folds_keeps_the_other_diagonals_apart) {
  for (const char* name : {"overlapping_quads", "posed_limb"}) {
    const Surface surface = make_sample(name, 8);
    RepairOptions options;
    options.min_dihedral_deg = 2;
    options.find.both_diagonals = true;
    EXPECT_EQ(repair(surface, options).status, Status::embedded) << name;
  }
}

/// It is opened between two faces that leave it little more than the gap that is asked for.
TEST(Clearance, gaps_wider_than_faces_are_reached) {
  const Surface tubes = make_sample("crossing_tubes", 30);  // edges of 0.032 of the diagonal
  RepairOptions options;
  options.min_gap_rel = 0.035;
  const RepairResult result = repair(tubes, options);
  EXPECT_EQ(result.status, Status::embedded);
  const Clearance after = measure_clearance(tubes, result.positions);
  EXPECT_GE(after.component_gap, 0.9 * options.min_gap_rel * result.report.diagonal);
  EXPECT_LT(result.report.displacement_max_rel, 0.15);
}

TEST(Clearance, opening_folds_keeps_the_gap_asked_for) {
  Surface thin = flat_tetrahedron(1e-4);
  for (const double z : {-0.004, 0.004}) {
    const std::int32_t first = static_cast<std::int32_t>(thin.positions.size() / 3);
    thin.positions.insert(thin.positions.end(), {-5, -5, z, 6, -5, z, 0, 6, z});
    thin.corners.insert(thin.corners.end(), {first, first + 1, first + 2});
  }
  RepairOptions options;
  options.min_dihedral_deg = 0.5;
  options.fixed.assign(thin.positions.size() / 3, 1);
  std::fill_n(options.fixed.begin(), 4, 0);
  const RepairResult any_gap = repair(thin, options);
  ASSERT_LT(measure_clearance(thin, any_gap.positions).gap, 0.003);
  options.min_gap_rel = 0.003 / any_gap.report.diagonal;
  const RepairResult result = repair(thin, options);
  EXPECT_EQ(result.status, Status::embedded);
  EXPECT_GE(measure_clearance(thin, result.positions).gap, 0.003);
  EXPECT_GT(measure_clearance(thin, result.positions).dihedral_deg,
            measure_clearance(thin, thin.positions).dihedral_deg);
}

}  // namespace
}  // namespace unsnarl
