#include "scene/solids.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "scene/diagnose.h"
#include "scene/shapes.h"

namespace unsnarl {
namespace {

/// A scene of a box, a triangle and a box twice as large.
shapes::Shape boxes_and_sheet() {
  shapes::Shape shape = shapes::box({1, 2, 3}), sheet;
  sheet.points = {{5, 0, 0}, {6, 0, 0}, {5, 1, 0}};
  sheet.triangles = {{0, 1, 2}};
  return shape.add(sheet).add(shapes::box({2, 4, 6}), {10, 0, 0});
}

Solids solids_in(const shapes::Shape& shape) {
  const PreparedSurface prepared = prepare(shape.surface(), {});
  const Diagnosis diagnosis = diagnose_topology(shape.surface(), prepared);
  return find_solids(prepared.rest, prepared.triangles(), diagnosis.components);
}

TEST(Solids, are_the_closed_components) {
  const shapes::Shape shape = boxes_and_sheet();
  const Solids solids = solids_in(shape);
  ASSERT_EQ(solids.list.size(), 2u);
  EXPECT_NEAR(solids.list[0].volume, 6, 1e-12);
  EXPECT_NEAR(solids.list[0].area, 22, 1e-12);
  EXPECT_NEAR(solids.list[1].volume, 48, 1e-12);
  EXPECT_NEAR(solids.list[1].area, 88, 1e-12);
  ASSERT_EQ(solids.of_triangle.size(), shape.triangles.size());
  EXPECT_EQ(solids.of_triangle.front(), 0);
  EXPECT_EQ(solids.of_triangle.back(), 1);
  EXPECT_EQ(std::count(solids.of_triangle.begin(), solids.of_triangle.end(), -1), 1);
}

TEST(Solids, triangles_that_disagree_on_what_is_inside_bound_none) {
  shapes::Shape shape = boxes_and_sheet();
  std::swap(shape.triangles[3][0], shape.triangles[3][1]);
  const Solids solids = solids_in(shape);
  ASSERT_EQ(solids.list.size(), 1u);
  EXPECT_EQ(solids.of_triangle.front(), -1);
}

TEST(Solids, of_some_triangles_are_numbered_anew) {
  const Solids solids = solids_in(boxes_and_sheet());
  const Index last = static_cast<Index>(solids.of_triangle.size()) - 1;
  const auto sheet = std::find(solids.of_triangle.begin(), solids.of_triangle.end(), -1) - solids.of_triangle.begin();
  const std::vector<Index> some = {static_cast<Index>(sheet), last, last + 1};  // the last one is of no component
  const Solids of_some = solids_of(solids, some);
  ASSERT_EQ(of_some.list.size(), 1u);
  EXPECT_EQ(of_some.list[0].volume, solids.list[1].volume);
  EXPECT_EQ(of_some.of_triangle, (std::vector<Index>{-1, 0, -1}));
  EXPECT_TRUE(solids_of(solids, {}).list.empty());
}

}  // namespace
}  // namespace unsnarl
