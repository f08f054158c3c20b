// The statuses that the positions reached by a repair get.
#include "pipeline/conclude.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <utility>

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
    RepairTask task(surface, options, nullptr);
    Finders finders(task.prepared.triangles(), task.prepared.scale);
    task.diagnose(finders.as_is, {});
    EXPECT_EQ(task.diagnosis.pairs.size(), 1u);
    PairCensus census(surface, task.prepared, options.find, finders, task.diagnosis.pairs);
    const Positions x = task.prepared.gather(positions);
    return unsnarl::status_at(task, census, census.at(x), x);
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

// Once a corner of the quad lies across its diagonal, a program that reads it splits it along the other one.
TEST(ConcludeOfPolygons, what_meets_as_a_reader_splits_them_counts) {
  const std::vector<std::int32_t> corners = {0, 1, 2, 3, 4, 5, 6}, offsets = {0, 4, 7};
  std::vector<double> input = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.9, 0.4, -1, 0.9, 0.4, 1, 0.95, 0.4, 1};
  const SurfaceView surface{input, corners, offsets};
  const RepairOptions options;
  RepairTask task(surface, options, nullptr);
  Finders finders(task.prepared.triangles(), task.prepared.scale);
  task.diagnose(finders.as_is, {});
  PairCensus census(surface, task.prepared, options.find, finders, task.diagnosis.pairs);

  std::vector<double> moved = input;
  std::copy_n(std::array{0.6, 0.4, 0.2}.begin(), 3, moved.begin() + 9);
  for (const auto& [tip, status] : {std::pair{0.03, Status::no_progress}, std::pair{0.1, Status::embedded}}) {
    moved[14] = tip;
    const Positions x = task.prepared.gather(moved);
    const PairCensus::Pairs pairs = census.at(x);
    EXPECT_TRUE(pairs.triangles.empty()) << "the input's split alone says embedded";
    EXPECT_EQ(pairs.by_other_cuts.size(), status == Status::embedded ? 0u : 1u);
    EXPECT_EQ(pairs.faces.total(), pairs.by_other_cuts.size());
    EXPECT_EQ(status_at(task, census, pairs, x), status);
    EXPECT_EQ(census.is_embedded_in_float32(x), status == Status::embedded);
  }
}

}  // namespace
}  // namespace unsnarl
