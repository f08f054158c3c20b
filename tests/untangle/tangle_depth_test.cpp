#include "untangle/tangle_depth.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scene/shapes.h"
#include "untangle/conflict_regions.h"

namespace unsnarl {
namespace {

/// Of the only region.
int depth_of(const shapes::Shape& shape) {
  const Scene scene = shapes::scene_of(shape);
  const std::vector<ConflictRegion> regions = conflict_regions(scene, shapes::pairs_of(shape));
  EXPECT_EQ(regions.size(), 1u);
  return tangle_depth(scene, ConnectedParts(scene), regions.front().core);
}

TEST(TangleDepth, are_as_many_edges_deep_as_the_mesh_is_fine) {
  const int coarse = depth_of(shapes::crossing_wide_bumps(1, 1)), fine = depth_of(shapes::crossing_wide_bumps(2, 1));
  EXPECT_GE(coarse, 2);
  EXPECT_GE(fine, 2 * coarse - 1);
  EXPECT_LE(fine, 2 * coarse + 3);
}

TEST(TangleDepth, are_deeper_where_more_has_run_through) {
  EXPECT_GT(depth_of(shapes::crossing_wide_bumps(2, 2)), depth_of(shapes::crossing_wide_bumps(2, 0.3)));
}

// A wedge pushed into the side of a sheet cuts nothing off it, nor the sheet off the wedge.
TEST(TangleDepth, open_cuts_cut_nothing_off) {
  shapes::Shape shape = shapes::bumpy_sheet(20, 0);
  shape.add(shapes::grid(20, 20, false, [](double i, double j) { return Vec3(8.3 + 0.9 * i, 0.13, 0.7 * (j - 10)); }));
  EXPECT_EQ(depth_of(shape), 0);
}

// A thin needle through a sheet leaves by its side, however long it is.
TEST(TangleDepth, are_not_deeper_than_half_their_girth) {
  shapes::Shape shape = shapes::bumpy_sheet(30, 0);
  shape.add(shapes::grid(24, 4, true, [](double i, double j) {
    const double angle = 2 * M_PI * j / 4;
    return Vec3(0.21 + 0.3 * std::cos(angle), 0.13 + 0.3 * std::sin(angle), i - 16.37);
  }));
  EXPECT_LE(depth_of(shape), 2);
}

TEST(TangleDepth, do_not_depend_on_what_is_elsewhere) {
  shapes::Shape shape = shapes::bumpy_sheet(30, 0);
  shape.add(shapes::grid(40, 24, true, [](double i, double j) {
    const double angle = 2 * M_PI * j / 24;
    return Vec3(0.21 + 3 * std::cos(angle), 0.13 + 3 * std::sin(angle), i - 19.63);
  }));
  const int alone = depth_of(shape);
  shape.add(shapes::bumpy_sheet(200, 0), {1000, 0, 0});
  EXPECT_EQ(depth_of(shape), alone);
}

}  // namespace
}  // namespace unsnarl
