#include "scene/prepared_surface.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "scene/shapes.h"

namespace unsnarl {
namespace {

// A flat strip of two quads whose common edge is doubled, as along a seam: vertices 1, 2 and 4, 5 coincide.
Surface seamed_quads() {
  return {
      {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 2, 1, 0, 2, 0, 0}, {0, 1, 2, 3, 4, 7, 6, 5}, {0, 4, 8}};
}

TEST(PreparedSurface, seams_count_as_one_and_move_together) {
  const Surface surface = seamed_quads();
  const PreparedSurface prepared = prepare(surface, {});
  EXPECT_EQ(prepared.weld_map.count, 6);
  EXPECT_EQ(prepared.triangles().size(), 4u);
  EXPECT_EQ(prepared.rest.cols(), 6);
  Positions x = prepared.gather(surface.positions);
  EXPECT_TRUE(x == prepared.rest);
  EXPECT_EQ(prepared.scatter(surface.positions, x), surface.positions);
  x(2, prepared.weld_map.vertex_of[1]) = 0.25;
  const std::vector<double> moved = prepared.scatter(surface.positions, x);
  std::vector<double> expected = surface.positions;
  expected[3 * 1 + 2] = expected[3 * 4 + 2] = 0.25;
  EXPECT_EQ(moved, expected);
  EXPECT_TRUE(prepared.gather(moved) == x);
}

TEST(PreparedSurface, without_welding_every_vertex_is_its_own) {
  EXPECT_EQ(prepare(seamed_quads(), {.weld = Weld::none}).weld_map.count, 8);
}

// Within a tolerance the vertices of one seam differ in the file; those that do not move keep their own digits.
TEST(PreparedSurface, coordinates_that_did_not_move_keep_their_digits) {
  Surface surface = seamed_quads();
  surface.positions[3 * 4] = 1 + 1e-9;
  const PreparedSurface prepared = prepare(surface, {.weld_tolerance = 1e-6});
  ASSERT_EQ(prepared.weld_map.count, 6);
  EXPECT_EQ(prepared.scatter(surface.positions, prepared.rest), surface.positions);
  Positions x = prepared.rest;
  x(1, prepared.weld_map.vertex_of[4]) = -0.5;
  const std::vector<double> moved = prepared.scatter(surface.positions, x);
  EXPECT_EQ(moved[3 * 4], 1 + 1e-9);
  EXPECT_EQ(moved[3 * 4 + 1], -0.5);
  EXPECT_EQ(moved[3 * 1 + 1], -0.5);
}

TEST(PreparedSurface, pairs_of_triangles_become_pairs_of_faces) {
  PreparedSurface prepared;
  prepared.triangulation.polygon = {0, 0, 1, 1, 2};
  const std::vector<IntersectingPair> pairs = {{0, 1, PairClass::folded},
                                               {0, 2, PairClass::one_vertex},
                                               {0, 3, PairClass::disjoint},
                                               {1, 2, PairClass::one_vertex},
                                               {3, 4, PairClass::disjoint}};
  const std::vector<IntersectingPair> expected = {
      {0, 0, PairClass::folded}, {0, 1, PairClass::disjoint}, {1, 2, PairClass::disjoint}};
  EXPECT_TRUE(pairs_of_faces(prepared.triangulation.polygon, pairs) == expected);
}

TEST(PreparedSurface, senseless_input_is_refused) {
  Surface surface = seamed_quads();
  surface.corners[2] = 8;
  EXPECT_THROW(prepare(surface, {}), std::invalid_argument);
  surface = seamed_quads();
  surface.positions[4] = INFINITY;
  EXPECT_THROW(prepare(surface, {}), std::invalid_argument);
}

}  // namespace
}  // namespace unsnarl
