// Polygons that a reader of the result cuts otherwise than the input was cut.
#include "pipeline/triangulation_stage.h"

#include <gtest/gtest.h>

#include "pipeline/stages.h"
#include "scene/pair_census.h"

namespace unsnarl {
namespace {

/// A quad and a thin triangle beside it. With the quad's last corner at (0.6, 0.4, 0.2) a reader cuts it along the
/// other diagonal, and the triangle runs through that cut alone.
Surface quad_and_needle() {
  Surface surface;
  surface.positions = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.9, 0.4, 0.01, 0.9, 0.4, 1, 0.95, 0.4, 1};
  surface.corners = {0, 1, 2, 3, 4, 5, 6};
  surface.offsets = {0, 4, 7};
  return surface;
}

class TriangulationStage : public ::testing::Test {
 protected:
  PairCensus::Pairs pairs_at(StagedRepair& repair, const Positions& x) const {
    PairCensus census(repair.task.surface, repair.task.prepared, repair.options.find, repair.finders,
                      repair.task.diagnosis.pairs);
    return census.at(x);
  }
};

TEST_F(TriangulationStage, embeds_the_cut_that_a_reader_makes_too) {
  StagedRepair repair(quad_and_needle());
  repair.state.scene.x.col(3) = Vec3(0.6, 0.4, 0.2);
  const PairCensus::Pairs before = pairs_at(repair, repair.state.scene.x);
  ASSERT_TRUE(before.triangles.empty()) << "the input's cut alone is embedded";
  ASSERT_FALSE(before.by_other_cuts.empty());
  triangulation_stage(repair.task, repair.control, repair.finders, repair.state);
  EXPECT_EQ(pairs_at(repair, repair.state.scene.x).faces.total(), 0u);
  EXPECT_TRUE(repair.finders.are_of(repair.state.scene.triangles)) << "the scene has the input's triangles again";
}

TEST_F(TriangulationStage, leaves_what_both_cuts_hold_alone) {
  StagedRepair repair(quad_and_needle());
  const Positions before = repair.state.scene.x;
  triangulation_stage(repair.task, repair.control, repair.finders, repair.state);
  ASSERT_EQ(pairs_at(repair, before).faces.total(), 0u);
  EXPECT_EQ(repair.state.scene.x, before);
}

TEST_F(TriangulationStage, gives_up_components_that_were_not_resolved_before) {
  // The needle runs through the quad by the input's cut, and nothing has been untangled.
  Surface crossing = quad_and_needle();
  crossing.positions[3 * 4 + 2] = -1;
  StagedRepair repair(crossing);
  ASSERT_GT(repair.pairs(), 0u);
  const Positions before = repair.state.scene.x;
  triangulation_stage(repair.task, repair.control, repair.finders, repair.state);
  EXPECT_EQ(repair.state.scene.x, before);
  for (Index c = 0; c < repair.task.diagnosis.components.count(); ++c)
    EXPECT_TRUE(repair.state.policy.is_given_up(c)) << c;
}

}  // namespace
}  // namespace unsnarl
