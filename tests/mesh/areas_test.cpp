#include "mesh/areas.h"

#include <gtest/gtest.h>

#include "mesh/shapes.h"
#include "mesh/triangulation.h"

namespace unsnarl {
namespace {

TEST(Areas, of_the_unit_cube) {
  const Surface s = shapes::cube();
  const std::vector<Triangle> triangles = triangulate(s).triangles;
  Positions x = Eigen::Map<const Positions>(s.positions.data(), 3, 8);
  EXPECT_DOUBLE_EQ(total_area(x, triangles), 6);
  EXPECT_DOUBLE_EQ(signed_volume(x, triangles), 1);
  EXPECT_NEAR(mean_edge_length(x, triangles), (2 + std::sqrt(2.0)) / 3, 1e-15);
  EXPECT_EQ(triangle_areas(x, triangles), std::vector<double>(12, 0.5));
  // Moving, turning inside out, scaling.
  x.colwise() += Vec3(1e6, -2e6, 3e6);
  EXPECT_DOUBLE_EQ(signed_volume(x, triangles), 1);
  x *= -2;
  EXPECT_DOUBLE_EQ(signed_volume(x, triangles), -8);
}

TEST(Areas, squared_motion_integrates_over_the_triangle) {
  Positions rest(3, 3), x;
  rest << 0, 2, 0, 0, 0, 3, 1, 1, 1;  // area 3
  x = rest;
  x.colwise() += Vec3(1, -2, 2);
  EXPECT_DOUBLE_EQ(squared_motion(rest, x, {0, 1, 2}), 3 * 9.0);
  // The mean of the squares of a linear function is d^2 / 6 where one corner moves by d.
  x = rest;
  x.col(2) += Vec3(0, 0, 4);
  EXPECT_DOUBLE_EQ(squared_motion(rest, x, {0, 1, 2}), 3 * 16.0 / 6);
  EXPECT_EQ(squared_motion(rest, rest, {0, 1, 2}), 0);
}

TEST(Areas, normals_point_outward_and_vanish_without_area) {
  Positions x(3, 4);
  x << 0, 1, 0, 2, 0, 0, 1, 0, 0, 0, 0, 0;
  EXPECT_EQ(triangle_normal(x, {0, 1, 2}), Vec3(0, 0, 1));
  EXPECT_EQ(triangle_normal(x, {1, 0, 2}), Vec3(0, 0, -1));
  EXPECT_EQ(triangle_normal(x, {0, 1, 3}), Vec3(0, 0, 0));
}

TEST(Areas, of_nothing) {
  const Positions x(3, 0);
  EXPECT_EQ(total_area(x, {}), 0);
  EXPECT_EQ(signed_volume(x, {}), 0);
  EXPECT_EQ(mean_edge_length(x, {}), 0);
}

}  // namespace
}  // namespace unsnarl
