#include "mesh/simplification.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "mesh/adjacency.h"
#include "repair/shapes.h"

namespace unsnarl {
namespace {

double area_of(const Positions& x, std::span<const Triangle> triangles) {
  double sum = 0;
  for (const Triangle& t : triangles)
    sum += 0.5 * Vec3(x.col(t[1]) - x.col(t[0])).cross(Vec3(x.col(t[2]) - x.col(t[0]))).norm();
  return sum;
}

TEST(Simplification, leaves_a_quarter_of_a_flat_sheet_and_all_of_its_border) {
  const shapes::Shape sheet = shapes::bumpy_sheet(24, 0);
  const Positions x = sheet.positions();
  const std::vector<Triangle> coarse = simplify(x, sheet.triangles, sheet.triangles.size() / 4, 0.25);
  EXPECT_LE(coarse.size(), sheet.triangles.size() / 3);
  EXPECT_NEAR(area_of(x, coarse), 24 * 24, 1e-9);
  std::set<Index> left;
  for (const Triangle& t : coarse) left.insert(t.begin(), t.end());
  const EdgeTable edges = build_edges(sheet.triangles);
  for (std::size_t e = 0; e < edges.edges.size(); ++e)
    if (edges.triangles_of_edge[static_cast<Index>(e)].size() == 1) {
      for (const Index v : edges.edges[e]) EXPECT_TRUE(left.count(v)) << v;
    }
}

TEST(Simplification, does_not_leave_the_surface_by_more_than_the_tolerance) {
  const shapes::Shape sheet = shapes::bumpy_sheet(24, 6, 3);
  const Positions x = sheet.positions();
  const auto count = [&](double tolerance) { return simplify(x, sheet.triangles, 10, tolerance).size(); };
  EXPECT_LT(count(0.5), count(0.05));
  EXPECT_LE(count(0.05), sheet.triangles.size());
}

TEST(Simplification, nothing_stays_nothing) {
  EXPECT_TRUE(simplify(Positions(3, 0), {}, 0, 1).empty());
  const Positions points = Positions::Zero(3, 3);  // without any size
  const std::vector<Triangle> triangles = {{0, 1, 2}};
  EXPECT_EQ(simplify(points, triangles, 1, 1), triangles);
}

}  // namespace
}  // namespace unsnarl
