#include "untangle/placement.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scene/shapes.h"
#include "untangle/tangled_shapes.h"

namespace unsnarl {
namespace {

using shapes::Shape;

double motion_of(const Patch& patch) {
  return (patch.x - patch.rest).colwise().norm().maxCoeff();
}

TEST(Placement, a_strip_leaves_a_sheet_by_the_shortest_way) {
  const Shape shape = shapes::sheet_with_strips(1, 0.2);
  Patch patch = shapes::patch_of(shape);
  EXPECT_EQ(place(patch, {}, {}), 2);  // the sheet, where it is, and the strip
  EXPECT_TRUE(shapes::pairs_at(patch.x, patch.triangles).empty());
  EXPECT_TRUE(patch.x.leftCols(121) == patch.rest.leftCols(121));
  EXPECT_NEAR(motion_of(patch), 0.2, 0.03);
}

TEST(Placement, many_strips_each_by_its_own_way) {
  const Shape shape = shapes::sheet_with_strips(4, 0.3);
  Patch patch = shapes::patch_of(shape);
  EXPECT_EQ(place(patch, {}, {}), 5);
  EXPECT_TRUE(shapes::pairs_at(patch.x, patch.triangles).empty());
  EXPECT_LT(motion_of(patch), 0.35);
}

// Between two sheets that it pierces both, a strip has nowhere to go but smaller.
TEST(Placement, what_is_hemmed_in_shrinks) {
  Shape shape;
  for (const double z : {0.0, 1.0})
    shape.add(shapes::grid(40, 40, false, [=](double i, double j) { return Vec3(i, j, z); }));
  const Index strip = static_cast<Index>(shape.points.size());
  shape.add(shapes::grid(1, 1, false, [](double i, double j) { return Vec3(0.2 * i, 0, 1.4 * j - 0.2); }),
            Vec3(20.13, 20.37, 0));
  Patch patch = shapes::patch_of(shape);
  place(patch, {}, {});
  EXPECT_TRUE(shapes::pairs_at(patch.x, patch.triangles).empty());
  const double length = (patch.x.col(strip) - patch.x.col(strip + 1)).norm();
  EXPECT_LT(length, 1.3);
  EXPECT_GT(length, 0.5);
  EXPECT_LT(motion_of(patch), 0.8);
}

TEST(Placement, what_went_astray_goes_back_to_rest_first) {
  const Shape shape = shapes::sheet_with_strips(1, 0.2);
  Patch patch = shapes::patch_of(shape);
  patch.x.rightCols(6).colwise() += Vec3(0, 0, -7);
  place(patch, {}, {});
  EXPECT_TRUE(shapes::pairs_at(patch.x, patch.triangles).empty());
  EXPECT_LT(motion_of(patch), 0.25);
}

TEST(Placement, tolerated_pairs_are_no_obstacle) {
  const Shape shape = shapes::sheet_with_strips(1, 0.2);
  Patch patch = shapes::patch_of(shape);
  const std::vector<IntersectingPair> pairs = shapes::pairs_of(shape);
  ASSERT_FALSE(pairs.empty());
  place(patch, pairs, {});
  EXPECT_TRUE(patch.x == patch.rest);
}

}  // namespace
}  // namespace unsnarl
