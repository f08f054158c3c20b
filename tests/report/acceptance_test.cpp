// The statuses that the positions reached by a repair get.
#include "report/acceptance.h"

#include <gtest/gtest.h>

namespace unsnarl {
namespace {

/// A fan of two faces at vertex 0, in the plane z = 0 and upright, that share that vertex alone; and a third face, that
/// the upright one runs through.
const std::vector<double> fan_with_crossing = {0, 0, 0, 2, -1, 0, 2, 1, 0,   2, 5, -1,
                                               2, 5, 1, 1, 2,  0, 1, 3, 0.1, 2, 2, -0.1};
const std::vector<std::int32_t> fan_corners = {0, 1, 2, 0, 3, 4, 5, 6, 7};

class GoalTest : public ::testing::Test {
 protected:
  Status status_at(Goal goal, const std::vector<double>& positions) const {
    RepairOptions options;
    options.goal = goal;
    const SurfaceView surface{fan_with_crossing, fan_corners};
    const PreparedSurface prepared = prepare(surface, options.find);
    Finders finders(prepared.triangles());
    const Diagnosis diagnosis =
        diagnose(surface, prepared, std::vector<std::uint8_t>(prepared.weld_map.count, 0), finders.as_is);
    EXPECT_EQ(diagnosis.pairs.size(), 1u);
    Acceptance acceptance(prepared, diagnosis, options, finders);
    const Positions x = prepared.gather(positions);
    return acceptance.status(acceptance.pairs_at(x), x);
  }
};

TEST_F(GoalTest, a_new_pair_of_faces_that_share_a_vertex_counts_for_all_only) {
  // The upright face turns into the other one of the fan, away from the third: they meet beyond their vertex.
  std::vector<double> moved = fan_with_crossing;
  for (const std::size_t v : {3u, 4u}) moved[3 * v + 1] = 0;
  EXPECT_EQ(status_at(Goal::disjoint, fan_with_crossing), Status::no_progress);
  EXPECT_EQ(status_at(Goal::disjoint, moved), Status::embedded);
  EXPECT_NE(status_at(Goal::all, moved), Status::embedded);
}

}  // namespace
}  // namespace unsnarl
