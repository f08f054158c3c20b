#include "contact/sheet_gaps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "contact/smallest_gap.h"
#include "rigid/boxes.h"

namespace unsnarl {
namespace {

using shapes::grid;
using shapes::Shape;

SheetGap smallest(const Shape& shape, double wanted) {
  const Positions x = shape.positions();
  return SheetGaps(shape.triangles, x, {.wanted = wanted, .counts = {}, .stop = {}}).smallest(x, wanted);
}

std::vector<SheetGap> narrow(const Shape& shape, double wanted) {
  const Positions x = shape.positions();
  return SheetGaps(shape.triangles, x, {.wanted = wanted, .counts = {}, .stop = {}}).narrow(x, wanted);
}

Shape flat(Index cells, double cell, double z) {
  return grid(cells, cells, false, [=](double i, double j) { return Vec3(cell * i, cell * j, z); });
}

/// Two flat squares of side 1 that meet at an edge at this angle, of n x n cells each.
Shape crease(Index n, double degrees) {
  const double angle = degrees * 3.14159265358979 / 180;
  return grid(2 * n, n, false, [=](double i, double j) {
    const double along = std::abs(i - n) / n;
    return i < n ? Vec3(along, j / n, 0) : Vec3(along * std::cos(angle), j / n, along * std::sin(angle));
  });
}

/// A strip that turns back at distance `gap` and runs beside itself for the length 1; cells of a side of 1 / n.
Shape fold(Index n, double gap) {
  const auto turn = static_cast<Index>(std::ceil(gap * n * 1.5708)) + 2;
  return grid(2 * n + turn, n / 2, false, [=](double i, double j) {
    const double r = 0.5 * gap, along = i < n ? i - n : i > n + turn ? n + turn - i : 0;
    const double angle = 3.14159265358979 * std::clamp((i - n) / turn, 0.0, 1.0);
    return Vec3(along / n + r * std::sin(angle), j / n, r * (1 - std::cos(angle)));
  });
}

TEST(SheetGaps, are_those_of_triangles_where_each_is_a_sheet) {
  std::mt19937 random(7);
  const auto number = [&random] { return static_cast<double>(random()) / 4294967296.0; };
  Shape shape;
  for (Index t = 0; t < 40; ++t) {
    const Vec3 place(number(), number(), number());
    for (int k = 0; k < 3; ++k) shape.points.push_back(place + 0.02 * Vec3(number(), number(), number()));
    shape.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  const SmallestGap expected = smallest_gap(shape.triangles, shape.positions());
  const SheetGap found = smallest(shape, 1);
  EXPECT_EQ(found.distance, expected.distance);
  EXPECT_EQ(found.first, expected.first);
  EXPECT_EQ(found.second, expected.second);
}

TEST(SheetGaps, of_equal_ones_that_of_the_smallest_numbers_is_found_and_its_place) {
  Shape shape = flat(40, 0.125, 0);  // numbers without rounding
  const auto count = static_cast<Index>(shape.triangles.size());
  shape.add(flat(40, 0.125, 0.0625));
  const SheetGap found = smallest(shape, 0.125);
  EXPECT_EQ(found.distance, 0.0625);
  EXPECT_EQ(found.first, 0);
  EXPECT_EQ(found.second, count);
  EXPECT_EQ(found.place[2], 0.03125);
  EXPECT_EQ(narrow(shape, 0.125).size(), shape.triangles.size());
  EXPECT_EQ(smallest(shape, 0.0625).first, -1);
  EXPECT_TRUE(narrow(shape, 0.0625).empty());
}

TEST(SheetGaps, are_not_looked_for_along_a_surface_or_around_its_creases) {
  const Shape sheet = flat(12, 1, 0), box = shapes::box({12, 12, 12}, 12);
  const Shape sharp = crease(24, 30), sharper = crease(24, 8);
  for (const double gap : {0.3, 1.0, 3.0}) {
    EXPECT_TRUE(narrow(sheet, gap).empty()) << gap;
    EXPECT_TRUE(narrow(box, gap).empty()) << gap;
    EXPECT_TRUE(narrow(sharp, gap / 24).empty()) << gap;
  }
  EXPECT_FALSE(narrow(sharper, 3.0 / 24).empty());
}

TEST(SheetGaps, a_surface_has_beside_itself) {
  const Shape narrow_fold = fold(40, 0.05);
  const SheetGap found = smallest(narrow_fold, 0.06);
  EXPECT_NEAR(found.distance, 0.05, 1e-12);
  EXPECT_LT(found.place[0], -0.05);  // in the legs, not in the turn
  EXPECT_NEAR(found.place[2], 0.025, 1e-12);
  EXPECT_EQ(smallest(fold(40, 0.07), 0.06).first, -1);
}

TEST(SheetGaps, faces_that_a_third_one_joins_have_none) {
  Shape flat_double_pyramid;  // around the corners of a square, with apexes 0.002 apart
  for (const Vec3& p :
       {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(-1, 0, 0), Vec3(0, -1, 0), Vec3(0, 0, 1e-3), Vec3(0, 0, -1e-3)})
    flat_double_pyramid.points.push_back(p);
  for (Index k = 0; k < 4; ++k) {
    flat_double_pyramid.triangles.push_back({k, (k + 1) % 4, 4});
    flat_double_pyramid.triangles.push_back({(k + 1) % 4, k, 5});
  }
  EXPECT_TRUE(narrow(flat_double_pyramid, 0.1).empty());
  EXPECT_FALSE(narrow(shapes::box({1, 1, 1e-3}, 8), 0.1).empty());
}

TEST(SheetGaps, are_of_sheets_at_rest_wherever_they_are) {
  Shape shape = fold(40, 0.05);
  const Positions rest = shape.positions();
  Positions x = rest;
  x.row(2) *= 0.1;
  const SheetGaps gaps(shape.triangles, rest, {.wanted = 0.06, .counts = {}, .stop = {}});
  EXPECT_NEAR(gaps.smallest(x, 0.06).distance, 0.005, 1e-12);
}

TEST(SheetGaps, only_those_count_that_are_said_to) {
  Shape shape = flat(4, 1, 0);
  const auto count = static_cast<Index>(shape.triangles.size());
  shape.add(flat(4, 1, 0.1)).add(flat(4, 1, 0.3));
  const Positions x = shape.positions();
  const auto piece = [count](Index t) { return t / count; };
  const SheetGaps gaps(
      shape.triangles, x,
      {.wanted = 0.5, .counts = [&](Index s, Index t) { return piece(s) + piece(t) != 1; }, .stop = {}});
  EXPECT_NEAR(gaps.smallest(x, 0.5).distance, 0.2, 1e-12);
}

}  // namespace
}  // namespace unsnarl
