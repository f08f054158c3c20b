#include "untangle/alone_first.h"

#include <gtest/gtest.h>

#include "untangle/escalation.h"
#include "untangle/strategies.h"
#include "untangle/tangled_shapes.h"

namespace unsnarl {
namespace {

int solve(Patch& patch) {
  return untangle_alone_first(patch, Task{.untangle = make_untangler({}, {})}, tiers_before_last_resorts());
}

/// A sheet of 2 x 2 around `middle`.
shapes::Shape sheet_at(const Vec3& middle) {
  return shapes::unit_grid(6, 6, false, false,
                           [&](double u, double v) { return Vec3(middle + Vec3(2 * u - 1, 2 * v - 1, 0)); });
}

TEST(AloneFirst, resolves_a_component_that_intersects_itself_and_what_it_meets) {
  shapes::Shape shape = shapes::thick_trefoil();
  shape.add(sheet_at({0, 0, 0.1}));
  shape.add(sheet_at({1.5, -1, 0.9}));
  Patch patch = shapes::patch_of(shape);
  const Positions rest = patch.rest;
  ASSERT_GT(shapes::count_pairs(patch), 0u);
  EXPECT_GT(solve(patch), 0);
  EXPECT_EQ(shapes::count_pairs(patch), 0u);
  EXPECT_TRUE(patch.rest == rest);
}

TEST(AloneFirst, leaves_alone_what_is_one_component) {
  Patch patch = shapes::patch_of(shapes::thick_trefoil());
  const Positions start = patch.x;
  EXPECT_EQ(solve(patch), 0);
  EXPECT_TRUE(patch.x == start);
}

TEST(AloneFirst, leaves_alone_components_that_intersect_only_each_other) {
  Patch patch = shapes::patch_of(shapes::two_spheres(8));
  const Positions start = patch.x;
  EXPECT_EQ(solve(patch), 0);
  EXPECT_TRUE(patch.x == start);
}

TEST(AloneFirst, keeps_nothing_where_pairs_are_left) {
  shapes::Shape shape = shapes::thick_trefoil();
  const auto knot = static_cast<Index>(shape.points.size());
  shape.add(sheet_at({1.5, -1, 0}));
  // The knot alone is free; the sheet crosses its tube.
  Patch patch = shapes::patch_of(shape, knot, static_cast<Index>(shapes::thick_trefoil().triangles.size()));
  const Positions start = patch.x;
  solve(patch);
  EXPECT_TRUE(patch.x == start || shapes::count_pairs(patch) == 0);
  EXPECT_TRUE(patch.x.rightCols(start.cols() - knot) == start.rightCols(start.cols() - knot));
}

}  // namespace
}  // namespace unsnarl
