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
