// The statuses that the positions reached by a repair get.
#include "report/acceptance.h"

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
    const PreparedSurface prepared = prepare(surface, options.find);
    Finders finders(prepared.triangles(), prepared.scale);
    const Diagnosis diagnosis =
        diagnose(surface, prepared, std::vector<std::uint8_t>(prepared.weld_map.count, 0), finders.as_is);
    EXPECT_EQ(diagnosis.pairs.size(), 1u);
    Acceptance acceptance(surface, prepared, diagnosis, options, finders);
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

// Once a corner of the quad lies across its diagonal, a program that reads it splits it along the other one.
TEST(AcceptanceOfPolygons, what_meets_as_a_reader_splits_them_counts) {
  const std::vector<std::int32_t> corners = {0, 1, 2, 3, 4, 5, 6}, offsets = {0, 4, 7};
  std::vector<double> input = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.9, 0.4, -1, 0.9, 0.4, 1, 0.95, 0.4, 1};
  const SurfaceView surface{input, corners, offsets};
  const RepairOptions options;
  const PreparedSurface prepared = prepare(surface, options.find);
  Finders finders(prepared.triangles(), prepared.scale);
  const Diagnosis diagnosis = diagnose(surface, prepared, {}, finders.as_is);
  Acceptance acceptance(surface, prepared, diagnosis, options, finders);

  std::vector<double> moved = input;
  std::copy_n(std::array{0.6, 0.4, 0.2}.begin(), 3, moved.begin() + 9);
  for (const auto& [tip, status] : {std::pair{0.03, Status::no_progress}, std::pair{0.1, Status::embedded}}) {
    moved[14] = tip;
    const Positions x = prepared.gather(moved);
    const Acceptance::Pairs pairs = acceptance.pairs_at(x);
    EXPECT_TRUE(pairs.triangles.empty()) << "the input's split alone says embedded";
    EXPECT_EQ(pairs.by_other_cuts.size(), status == Status::embedded ? 0u : 1u);
    EXPECT_EQ(pairs.faces.total(), pairs.by_other_cuts.size());
    EXPECT_EQ(acceptance.status(pairs, x), status);
    EXPECT_EQ(acceptance.is_embedded_in_float32(x), status == Status::embedded);
  }
}

}  // namespace
}  // namespace unsnarl
