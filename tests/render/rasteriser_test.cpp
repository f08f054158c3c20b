#include "render/rasteriser.h"

#include <gtest/gtest.h>

#include <limits>
#include <numeric>
#include <vector>

namespace unsnarl {
namespace {

TEST(Rasteriser, covers_every_sample_of_a_mesh_once_or_more_and_nothing_else) {
  // A square cut along a diagonal that passes through samples.
  const std::vector<ScreenPoint> points = {{2, 2, 1}, {12, 2, 1}, {12, 12, 1}, {2, 12, 1}};
  const std::vector<Triangle> triangles = {{0, 1, 2}, {0, 2, 3}};
  VisibilityBuffer buffer(16, 16);
  rasterise(points, triangles, std::vector<Index>{0, 1}, buffer);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x)
      EXPECT_EQ(buffer.triangle[buffer.at(x, y)] >= 0, x >= 2 && x < 12 && y >= 2 && y < 12) << x << ' ' << y;
}

TEST(Rasteriser, nearest_wins_whatever_the_order) {
  const std::vector<ScreenPoint> points = {{0, 0, 1}, {20, 0, 1}, {0, 20, 1}, {0, 0, 2}, {20, 0, 2}, {0, 20, 2}};
  const std::vector<Triangle> triangles = {{0, 1, 2}, {3, 4, 5}};
  for (const auto& order : {std::vector<Index>{0, 1}, std::vector<Index>{1, 0}}) {
    VisibilityBuffer buffer(8, 8);
    rasterise(points, triangles, order, buffer);
    EXPECT_EQ(buffer.triangle[buffer.at(3, 3)], 1);
    EXPECT_EQ(buffer.inverse_depth[buffer.at(3, 3)], 2);
  }
}

TEST(Rasteriser, crossing_triangles_are_split_where_they_cross) {
  const std::vector<ScreenPoint> points = {{0, -8, 1}, {16, 8, 3}, {0, 24, 1}, {0, -8, 3}, {16, 8, 1}, {0, 24, 3}};
  const std::vector<Triangle> triangles = {{0, 1, 2}, {3, 4, 5}};
  VisibilityBuffer buffer(16, 16);
  rasterise(points, triangles, std::vector<Index>{0, 1}, buffer);
  EXPECT_EQ(buffer.triangle[buffer.at(3, 8)], 1);
  EXPECT_EQ(buffer.triangle[buffer.at(12, 8)], 0);
}

TEST(Rasteriser, leaves_out_what_is_behind_the_eye_degenerate_or_not_a_number) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  const std::vector<ScreenPoint> points = {{0, 0, 1}, {20, 0, 1}, {0, 20, 0}, {10, 10, 1}, {nan, 3, 1}, {0, inf, 1}};
  const std::vector<Triangle> triangles = {{0, 1, 2}, {0, 3, 3}, {0, 1, 4}, {0, 0, 0}};
  VisibilityBuffer buffer(8, 8);
  rasterise(points, triangles, std::vector<Index>{0, 1, 2, 3}, buffer);
  for (Index t : buffer.triangle) EXPECT_EQ(t, -1);
}

}  // namespace
}  // namespace unsnarl
