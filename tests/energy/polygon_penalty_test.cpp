#include "energy/polygon_penalty.h"

#include <gtest/gtest.h>

#include <cmath>

namespace unsnarl {
namespace {

/// Two squares of side 2, cut into triangles, that cross at the height `height` of the upright one; generic.
struct Crossing {
  Positions x = Positions(3, 8);
  std::vector<Triangle> triangles = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}};
  std::vector<Index> face_of = {0, 0, 1, 1};

  explicit Crossing(double height) {
    x.leftCols(4) << -1, 1, 1, -1,  //
        -1, -1, 1, 1,               //
        0, 0, 0, 0;
    x.rightCols(4) << -0.4, 1.6, 1.5, -0.5,  //
        0.10, 0.12, 0.13, 0.11,              //
        height - 1, height - 1.1, height + 1, height + 1.1;
  }
};

TEST(PolygonPenalty, takes_flat_convex_faces_whole) {
  Crossing crossing(0.7);
  EXPECT_EQ(convex_faces(crossing.triangles, crossing.face_of, crossing.x),
            (std::vector<std::vector<Index>>{{0, 1, 2, 3}, {4, 5, 6, 7}}));
  crossing.x.col(2) = Vec3(-0.5, -0.5, 0);  // concave
  EXPECT_EQ(convex_faces(crossing.triangles, crossing.face_of, crossing.x),
            (std::vector<std::vector<Index>>{{0, 1, 2}, {0, 2, 3}, {4, 5, 6, 7}}));
  crossing.x.col(6)[1] += 3;  // bent
  EXPECT_EQ(convex_faces(crossing.triangles, crossing.face_of, crossing.x).size(), 4u);
}

TEST(PolygonPenalty, gradient_matches_finite_differences) {
  const Crossing crossing(0.7);
  PolygonPenalty penalty(convex_faces(crossing.triangles, crossing.face_of, crossing.x));
  penalty.pairs = {{0, 1}};
  Positions gradient = Positions::Zero(3, 8);
  EXPECT_NEAR(penalty.value_and_gradient(crossing.x, gradient, 2.5), 2.5 * 0.3, 0.3);
  for (Index v = 0; v < 8; ++v)
    for (int axis = 0; axis < 3; ++axis) {
      const auto at = [&](double offset) {
        Positions moved = crossing.x, unused = Positions::Zero(3, 8);
        moved(axis, v) += offset;
        return penalty.value_and_gradient(moved, unused, 2.5);
      };
      EXPECT_NEAR((at(1e-7) - at(-1e-7)) / 2e-7, gradient(axis, v), 1e-6);
    }
}

TEST(PolygonPenalty, faces_that_are_apart_or_share_a_vertex_cost_nothing) {
  const Crossing apart(1.5);
  Positions gradient = Positions::Zero(3, 8);
  PolygonPenalty penalty({{0, 1, 2, 3}, {4, 5, 6, 7}});
  penalty.pairs = {{0, 1}};
  EXPECT_EQ(penalty.value_and_gradient(apart.x, gradient), 0);
  const Crossing crossing(0.7);
  PolygonPenalty joined({{0, 1, 2, 3}, {0, 5, 6, 7}});
  joined.pairs = {{0, 1}};
  EXPECT_EQ(joined.value_and_gradient(crossing.x, gradient), 0);
  EXPECT_EQ(gradient.norm(), 0);
}

}  // namespace
}  // namespace unsnarl
