#include "render/camera.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

namespace unsnarl {
namespace {

std::vector<double> corners_of_box(double x, double y, double z) {
  std::vector<double> p;
  for (int k = 0; k < 8; ++k) p.insert(p.end(), {(k & 1) * x + 5, (k >> 1 & 1) * y - 3, (k >> 2 & 1) * z});
  return p;
}

TEST(Camera, shows_everything_and_fills_the_image_one_way) {
  for (const auto& [x, y, z] :
       {std::array{1.0, 1.0, 1.0}, std::array{9.0, 1.0, 0.1}, std::array{0.1, 1.0, 20.0}, std::array{1.0, 30.0, 2.0}}) {
    const std::vector<double> p = corners_of_box(x, y, z);
    const Camera camera = three_quarter_view(p, 1.5, 0.05);
    double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
    for (std::size_t k = 0; k < p.size(); k += 3) {
      const Vec3 q = camera.project({p[k], p[k + 1], p[k + 2]}, 300, 200);
      EXPECT_GT(q[2], 0);
      left = std::min(left, q[0]), right = std::max(right, q[0]);
      top = std::min(top, q[1]), bottom = std::max(bottom, q[1]);
    }
    EXPECT_GE(left, 15 - 1e-6);
    EXPECT_LE(right, 285 + 1e-6);
    EXPECT_GE(top, 10 - 1e-6);
    EXPECT_LE(bottom, 190 + 1e-6);
    EXPECT_TRUE(right - left > 269 || bottom - top > 179) << "could be larger";
  }
}

TEST(Camera, frame_is_right_handed_and_looks_from_above) {
  for (const auto& box :
       {corners_of_box(3, 1, 1), corners_of_box(1, 1, 3), corners_of_box(1, 3, 1), corners_of_box(1, 1.1, 1.2)}) {
    const Camera c = three_quarter_view(box, 1, 0);
    EXPECT_NEAR((c.right.cross(c.up) - c.toward).norm(), 0, 1e-12);
    EXPECT_NEAR(c.right.norm(), 1, 1e-12);
    EXPECT_NEAR(c.up.norm(), 1, 1e-12);
  }
  EXPECT_GT(three_quarter_view(corners_of_box(3, 1, 1), 1, 0).toward[1], 0.1);
}

TEST(Camera, up_is_y_except_for_figures_that_stand_along_z) {
  EXPECT_GT(three_quarter_view(corners_of_box(1, 2, 1), 1, 0).up[1], 0.7);
  EXPECT_GT(three_quarter_view(corners_of_box(2, 1, 1), 1, 0).up[1], 0.7);
  EXPECT_GT(three_quarter_view(corners_of_box(1, 0.5, 3), 1, 0).up[2], 0.7);
}

TEST(Camera, up_is_what_a_file_says) {
  const auto long_along_z = corners_of_box(1, 0.5, 3), tall = corners_of_box(1, 2, 1);
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {1.0, -1.0})
      for (const auto& box : {long_along_z, tall}) {
        const Camera c = three_quarter_view(box, 1, 0, sign * Vec3::Unit(axis));
        EXPECT_GT(sign * c.up[axis], 0.7);
        EXPECT_GT(sign * c.toward[axis], 0.1) << "seen from above";
        EXPECT_NEAR((c.right.cross(c.up) - c.toward).norm(), 0, 1e-12);
      }
  const std::array<SceneFile, 3> files = {
      SceneFile{.name = "a.obj"}, {.name = "b.glb", .up = {{0, 1, 0}}}, {.name = "c.3mf", .up = {{0, 0, 1}}}};
  EXPECT_EQ(up_of(files), Vec3::UnitY());
  EXPECT_FALSE(up_of(std::span(files).first(1)));
}

TEST(Camera, longer_horizontal_axis_runs_to_the_right) {
  EXPECT_GT(three_quarter_view(corners_of_box(3, 1, 1), 1, 0).right[0], 0.8);
  EXPECT_GT(std::abs(three_quarter_view(corners_of_box(1, 3, 2.5), 1, 0).right[2]), 0.8);
}

}  // namespace
}  // namespace unsnarl
