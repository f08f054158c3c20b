#include "untangle/recession.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "scene/shapes.h"
#include "untangle/recede.h"

namespace unsnarl {
namespace {

using shapes::Shape;

// A hemisphere without a cap around its pole, opposite points of the equator identified: a Moebius band,
// non-orientable, one boundary. `f` takes opposite points of the sphere to one.
Shape punctured_projective_plane(Index rows, Index columns, double hole, const std::function<Vec3(const Vec3&)>& f) {
  const Vec3 pole = Vec3(0.5, 0.62, 0.6).normalized();
  const Vec3 east = pole.cross(Vec3::UnitX()).normalized(), north = pole.cross(east);
  Shape shape;
  for (Index i = 0; i <= rows; ++i) {
    const double polar = hole + (0.5 * std::numbers::pi - hole) * i / rows;
    for (Index j = 0; j < (i < rows ? columns : columns / 2); ++j) {
      const double angle = 2 * std::numbers::pi * j / columns;
      shape.points.push_back(
          f(std::cos(polar) * pole + std::sin(polar) * (std::cos(angle) * east + std::sin(angle) * north)));
    }
  }
  const auto id = [&](Index i, Index j) { return i * columns + j % (i < rows ? columns : columns / 2); };
  for (Index i = 0; i < rows; ++i) {
    for (Index j = 0; j < columns; ++j) {
      shape.triangles.push_back({id(i, j), id(i + 1, j), id(i + 1, j + 1)});
      shape.triangles.push_back({id(i, j), id(i + 1, j + 1), id(i, j + 1)});
    }
  }
  return shape;
}

Vec3 cross_cap(const Vec3& p) {
  return Vec3(p[0] * p[2], p[1] * p[2], 0.5 * (p[2] * p[2] - p[0] * p[0]));
}

Vec3 roman(const Vec3& p) {
  return Vec3(p[1] * p[2], p[2] * p[0], p[0] * p[1]);
}

Shape octahedron() {
  Shape shape;
  shape.points = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (const Index pole : {4, 5}) {
    for (const auto& [u, v] : {std::pair{0, 2}, std::pair{2, 1}, std::pair{1, 3}, std::pair{3, 0}}) {
      shape.triangles.push_back({u, v, pole});
    }
  }
  return shape;
}

void expect_resolved(Patch patch) {
  ASSERT_GT(shapes::pairs_at(patch.x, patch.triangles).size(), 0u);
  EXPECT_TRUE(recede(patch).clean);
  EXPECT_TRUE(shapes::pairs_at(patch.x, patch.triangles).empty());
  for (const Triangle& t : patch.triangles) {
    EXPECT_GE(triangle_area(patch.x, t), 1e-3 * triangle_area(patch.rest, t));
  }
}

TEST(Recession, EmbedsAPuncturedCrossCap) {
  expect_resolved(shapes::patch_of(punctured_projective_plane(14, 40, 0.4, cross_cap)));
}

TEST(Recession, EmbedsAPuncturedRomanSurface) {
  expect_resolved(shapes::patch_of(punctured_projective_plane(14, 40, 0.4, roman)));
}

TEST(Recession, ShrinksADiscOntoAPoint) {
  const Shape disc = shapes::grid(12, 12, false, [](double i, double j) { return Vec3(i - 6, j - 6, 0); });
  const Positions rest = disc.positions();
  const Recession recession(disc.triangles, rest, static_cast<Index>(rest.cols()));
  ASSERT_TRUE(recession.possible());
  double before = total_area(rest, disc.triangles);
  for (const double share : {0.25, 0.5, 0.75, 1.0}) {
    Positions x = rest;
    recession.positions(share, x);
    double area = 0;  // signed: the map keeps the side up
    for (const Triangle& t : disc.triangles)
      area += 0.5 * area_vector(x, t)[2] * (area_vector(rest, t)[2] > 0 ? 1 : -1);
    EXPECT_GT(area, 0);
    EXPECT_LT(area, before);
    EXPECT_EQ(x.row(2).cwiseAbs().maxCoeff(), 0);
    EXPECT_LE(x.cwiseAbs().maxCoeff(), 6 + 1e-12);
    before = area;
  }
  EXPECT_LT(before, 0.05 * total_area(rest, disc.triangles));
  Positions x = rest;
  recession.positions(0, x);
  EXPECT_EQ(x, rest);
}

TEST(Recession, KeepsVerticesOnTheSurface) {
  // Of a cylinder the middle circle stays; nothing turns around the axis.
  const Shape tube = shapes::tube(20, 24, 2);
  const Positions rest = tube.positions();
  const Recession recession(tube.triangles, rest, static_cast<Index>(rest.cols()));
  Positions x = rest;
  recession.positions(0.5, x);
  for (Index v = 0; v < x.cols(); ++v) {
    const double radius = x.col(v).tail<2>().norm();
    EXPECT_LE(radius, 2 + 1e-9);
    EXPECT_GE(radius, 2 * std::cos(std::numbers::pi / 24) - 1e-9);
    EXPECT_NEAR(x(0, v), 0.5 * rest(0, v), 0.8);
    EXPECT_LT((x.col(v) - rest.col(v)).tail<2>().norm(), 0.8);
  }
}

TEST(Recession, LeavesClosedSurfacesAndFixedBoundariesAlone) {
  const Shape closed = octahedron();
  const Positions rest = closed.positions();
  EXPECT_FALSE(Recession(closed.triangles, rest, 6).possible());
  const Shape sheet = shapes::bumpy_sheet(6, 1);
  const Positions sheet_rest = sheet.positions();
  EXPECT_FALSE(Recession(sheet.triangles, sheet_rest, 0).possible());

  // Next to each other: only the sheet moves.
  Shape both = closed;
  both.add(sheet, Vec3(0, 0, 5));
  const Positions both_rest = both.positions();
  Positions x = both_rest;
  const Recession recession(both.triangles, both_rest, static_cast<Index>(x.cols()));
  ASSERT_TRUE(recession.possible());
  recession.positions(0.5, x);
  EXPECT_EQ(x.leftCols(6), both_rest.leftCols(6));
  EXPECT_NE(x, both_rest);
}

TEST(Recession, GivesUpAtOnceWithoutABoundary) {
  Shape two = octahedron();
  two.add(octahedron(), Vec3(0.7, 0.1, 0.05));
  Patch patch = shapes::patch_of(two);
  const RecedeResult result = recede(patch);
  EXPECT_FALSE(result.clean);
  EXPECT_EQ(result.iterations, 0);
  EXPECT_EQ(patch.x, patch.rest);
}

}  // namespace
}  // namespace unsnarl
