#include "mesh/simplification.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "mesh/adjacency.h"
#include "scene/shapes.h"

namespace unsnarl {
namespace {

double area_of(const Positions& x, std::span<const Triangle> triangles) {
  double sum = 0;
  for (const Triangle& t : triangles)
    sum += 0.5 * Vec3(x.col(t[1]) - x.col(t[0])).cross(Vec3(x.col(t[2]) - x.col(t[0]))).norm();
  return sum;
}

/// How far vertex v is above or below triangles that lie over the plane as its sheet does.
double height_difference(const Positions& x, std::span<const Triangle> triangles, Index v) {
  double least = std::numeric_limits<double>::infinity();
  for (const Triangle& t : triangles) {
    Eigen::Matrix3d corners;
    for (int k = 0; k < 3; ++k) corners.col(k) = Vec3(x(0, t[k]), x(1, t[k]), 1);
    const Vec3 weights = corners.inverse() * Vec3(x(0, v), x(1, v), 1);
    if (weights.minCoeff() < -1e-9) continue;
    const double height = weights.dot(Vec3(x(2, t[0]), x(2, t[1]), x(2, t[2])));
    least = std::min(least, std::abs(height - x(2, v)));
  }
  return least;
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
  std::size_t fewer = sheet.triangles.size();
  for (const double tolerance : {0.05, 0.5}) {
    const std::vector<Triangle> coarse = simplify(x, sheet.triangles, 10, tolerance);
    EXPECT_LT(coarse.size(), fewer);
    fewer = coarse.size();
    for (Index v = 0; v < x.cols(); ++v) EXPECT_LE(height_difference(x, coarse, v), 4 * tolerance) << v;
  }
}

TEST(Simplification, nothing_stays_nothing) {
  EXPECT_TRUE(simplify(Positions(3, 0), {}, 0, 1).empty());
  const Positions points = Positions::Zero(3, 3);  // without any size
  const std::vector<Triangle> triangles = {{0, 1, 2}};
  EXPECT_EQ(simplify(points, triangles, 1, 1), triangles);
}

}  // namespace
}  // namespace unsnarl
