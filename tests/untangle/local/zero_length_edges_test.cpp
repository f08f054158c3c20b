#include "untangle/local/zero_length_edges.h"

#include <gtest/gtest.h>

#include "contact/intersection_finder.h"
#include "scene/shapes.h"

namespace unsnarl {
namespace {

constexpr double share = 0.05;

/// A flat sheet of n x n cells of which those less than `size` from the middle are in one point, all vertices free.
Patch sheet_with_a_point(Index n, double size) {
  shapes::Shape sheet = shapes::bumpy_sheet(n, 0);
  for (Vec3& p : sheet.points)
    if (p.cwiseAbs().maxCoeff() < size) p.setZero();
  return shapes::patch_of(sheet);
}

void open(const Patch& patch, Positions& x) {
  open_zero_length_edges(patch, build_edges(patch.triangles).edges, share, x);
}

TEST(ZeroLengthEdges, a_disc_in_a_point_opens_without_overlap) {
  const Patch patch = sheet_with_a_point(12, 3.5);
  IntersectionFinder finder(patch.triangles);
  ASSERT_FALSE(finder.find(patch.x).empty());
  Positions x = patch.x;
  open(patch, x);
  EXPECT_TRUE(finder.find(x).empty());
  const Vec3 up(0, 0, 1);
  for (const Triangle& t : patch.triangles) EXPECT_GT(area_vector(x, t).dot(up), 0);
  // As far as its neighbours are times the share, and not farther.
  for (Index v = 0; v < x.cols(); ++v) EXPECT_LE((x.col(v) - patch.x.col(v)).cwiseAbs().maxCoeff(), share * 4);
}

TEST(ZeroLengthEdges, nothing_else_moves) {
  const Patch patch = sheet_with_a_point(6, 1.5);
  Positions x = patch.x;
  open(patch, x);
  EXPECT_FALSE(x == patch.x);
  for (Index v = 0; v < x.cols(); ++v) EXPECT_TRUE(patch.x.col(v) == x.col(v) || patch.x.col(v).isZero()) << v;
  const Positions opened = x;
  open(patch, x);
  EXPECT_TRUE(opened == x);
}

TEST(ZeroLengthEdges, vertices_that_are_not_free_stay) {
  Patch patch = sheet_with_a_point(6, 1.5);
  patch.free_count = 24;  // four of the nine vertices in the point
  Positions x = patch.x;
  open(patch, x);
  EXPECT_TRUE(x.rightCols(x.cols() - 24) == patch.x.rightCols(x.cols() - 24));
  EXPECT_FALSE(x == patch.x);
}

TEST(ZeroLengthEdges, a_component_in_one_point_stays) {
  Patch patch = sheet_with_a_point(2, 2);
  Positions x = patch.x;
  open(patch, x);
  EXPECT_TRUE(x == patch.x);
}

}  // namespace
}  // namespace unsnarl
