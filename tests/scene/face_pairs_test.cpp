#include "scene/face_pairs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "unsnarl/certify.h"
#include "unsnarl/repair.h"

namespace unsnarl {
namespace {

const FindOptions both = {.both_diagonals = true};

/// A saddle whose diagonals pass each other at a distance of 1, and an upright face that ends between them.
Surface saddle_and_blade() {
  return {
      {0, 0, 0, 4, 0, 1, 4, 4, 0, 0, 4, 1, 1.9, 2.1, 0.6, 2.2, 1.9, 0.5, 2, 2, 3}, {0, 1, 2, 3, 4, 5, 6}, {0, 4, 7}};
}

TEST(FacePairs, the_other_diagonal_of_a_quad_counts_where_asked_for) {
  const Surface surface = saddle_and_blade();
  EXPECT_TRUE(find_intersections(surface).empty());
  EXPECT_EQ(find_intersections(surface, both), (std::vector<IntersectingPair>{{0, 1, PairClass::disjoint}}));
  EXPECT_FALSE(certify(surface, surface.positions, both).embedded());
}

TEST(FacePairs, flat_and_concave_quads_are_no_trouble) {
  // Two flat quads side by side, and one whose other diagonal lies outside.
  const Surface surface = {
      {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 2, 0, 0, 2, 1, 0, 9, 0, 0, 11, 0, 0, 9.3, 0.3, 0, 9, 2, 0},
      {0, 1, 2, 3, 1, 4, 5, 2, 6, 7, 8, 9},
      {0, 4, 8, 12}};
  EXPECT_TRUE(find_intersections(surface, both).empty());
  RepairOptions options;
  options.find = both;
  const RepairResult result = repair(surface, options);
  EXPECT_EQ(result.status, Status::embedded);
  EXPECT_TRUE(result.positions == surface.positions);
}

TEST(FacePairs, repair_holds_for_either_diagonal) {
  const Surface surface = saddle_and_blade();
  RepairOptions options;
  options.find = both;
  const RepairResult result = repair(surface, options);
  EXPECT_EQ(result.status, Status::embedded) << to_string(result.status);
  EXPECT_EQ(result.report.before.total(), 1u);
  EXPECT_EQ(find_intersections({result.positions, surface.corners, surface.offsets}, both).size(), 0u);
  // Nobody asked: it is embedded as it is cut.
  EXPECT_TRUE(repair(surface).positions == surface.positions);
}

/// Polygons of 3 to 6 corners in one heap.
Surface heap_of_polygons() {
  Surface surface;
  surface.offsets.push_back(0);
  std::uint64_t state = 1;
  const auto random = [&] {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return static_cast<double>(state >> 33) / static_cast<double>(std::uint64_t{1} << 31);
  };
  for (int f = 0; f < 60; ++f) {
    const double x = 3 * random(), y = 3 * random(), z = random();
    const int corners = 3 + f % 4;
    for (int k = 0; k < corners; ++k) {
      const double angle = 2 * 3.14159265358979 * k / corners;
      surface.corners.push_back(static_cast<std::int32_t>(surface.positions.size() / 3));
      surface.positions.insert(surface.positions.end(),
                               {x + std::cos(angle), y + std::sin(angle), z + 0.4 * random() * std::cos(2 * angle)});
    }
    surface.offsets.push_back(static_cast<std::int32_t>(surface.corners.size()));
  }
  return surface;
}

TEST(FacePairs, visits_the_pairs_that_it_finds_each_once) {
  const Surface surface = heap_of_polygons();
  for (const FindOptions& options : {FindOptions{}, both}) {
    const PreparedSurface prepared = prepare(surface, options);
    const std::vector<IntersectingPair> found = FacePairFinder(prepared).find(prepared.rest);
    std::vector<IntersectingPair> visited;
    FacePairFinder(prepared).visit(prepared.rest, {}, [&](std::span<const IntersectingPair> pairs) {
      visited.insert(visited.end(), pairs.begin(), pairs.end());
    });
    std::sort(visited.begin(), visited.end());
    EXPECT_GT(found.size(), 100u);
    EXPECT_EQ(visited, found);
  }
}

/// Two bands of many corners each; the second runs through the far end of the first many times.
Surface long_bands() {
  constexpr int steps = 1500;
  Surface surface;
  surface.offsets = {0};
  const auto add = [&](double x, double y, double z) {
    surface.corners.push_back(static_cast<std::int32_t>(surface.positions.size() / 3));
    surface.positions.insert(surface.positions.end(), {x, y, z});
  };
  for (int i = 0; i < steps; ++i) add(i, 0, 0);
  for (int i = steps; i-- > 0;) add(i, 1, 0);
  surface.offsets.push_back(static_cast<std::int32_t>(surface.corners.size()));
  const auto second = [&](int i, double y) { add(steps - 1 - 0.2 * i, y, 0.3 * std::sin(1.3 * i)); };
  for (int i = 0; i < steps; ++i) second(i, 0.5);
  for (int i = steps; i-- > 0;) second(i, 0.7);
  surface.offsets.push_back(static_cast<std::int32_t>(surface.corners.size()));
  return surface;
}

/// To decide all pieces of two such faces again for each pair of pieces that meet would take hours.
TEST(FacePairs, visits_polygons_of_many_corners_at_no_greater_cost) {
  const PreparedSurface prepared = prepare(long_bands(), {});
  std::vector<IntersectingPair> visited;
  FacePairFinder(prepared).visit(prepared.rest, {}, [&](std::span<const IntersectingPair> pairs) {
    visited.insert(visited.end(), pairs.begin(), pairs.end());
  });
  EXPECT_EQ(visited, (std::vector<IntersectingPair>{{0, 1, PairClass::disjoint}}));
}

}  // namespace
}  // namespace unsnarl
