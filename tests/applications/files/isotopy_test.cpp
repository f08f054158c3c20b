#include "unsnarl/isotopy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "oracle/crossings_by_brute_force.h"

namespace unsnarl {
namespace {

Curve polygon(std::vector<double> points) {
  Curve curve;
  curve.points = std::move(points);
  curve.closed = true;
  return curve;
}

/// A letter C, counter-clockwise, that opens to the right, or to the left where flip is -1.
Curve letter(double x = 0, double flip = 1, double y = 0) {
  std::vector<double> outer, inner;
  const int n = 30;
  for (int k = 0; k <= n; ++k) {
    const double angle = 0.8 + (2 * std::numbers::pi - 1.6) * k / n;
    outer.insert(outer.end(), {x + flip * 1.1 * std::cos(angle), y + 1.1 * std::sin(angle)});
    const double back = 2 * std::numbers::pi - angle;
    inner.insert(inner.end(), {x + flip * 0.9 * std::cos(back), y + 0.9 * std::sin(back)});
  }
  outer.insert(outer.end(), inner.begin(), inner.end());
  Curve curve = polygon(outer);
  if (flip < 0)
    for (std::size_t a = 0, b = curve.size() - 1; a < b; ++a, --b)
      std::swap_ranges(&curve.points[2 * a], &curve.points[2 * a] + 2, &curve.points[2 * b]);
  return curve;
}

void expect_isotopy(const std::vector<Curve>& start, const std::vector<Curve>& end) {
  const Isotopy made = planar_isotopy(start, end);
  ASSERT_EQ(made.status, Status::embedded);
  FindOptions options;
  options.weld = Weld::none;
  EXPECT_TRUE(find_intersections(made.surface, options).empty());
  EXPECT_EQ(made.rings.front().time, 0);
  EXPECT_EQ(made.rings.back().time, 1);
  for (std::size_t c = 0; c < start.size(); ++c) {
    EXPECT_EQ(made.rings.front().curves[c], start[c].points);
    EXPECT_EQ(made.rings.back().curves[c], end[c].points);
    EXPECT_EQ(made.on_start[c].size(), static_cast<std::size_t>(made.points[c]));
    EXPECT_EQ(made.on_end[c].size(), static_cast<std::size_t>(made.points[c]));
  }
  for (int k = 0; k <= 60; ++k) EXPECT_EQ(oracle::count_crossings(isotopy_slice(made, k / 60.0), {}), 0U) << k;
  for (const IsotopyRing& ring : made.rings)
    EXPECT_EQ(oracle::count_crossings(isotopy_slice(made, ring.time), {}), 0U) << ring.time;
  const std::string animation = isotopy_animation_svg(made);
  EXPECT_NE(animation.find("<animate attributeName=\"points\""), std::string::npos);
}

std::string refusal(const std::vector<Curve>& start, const std::vector<Curve>& end) {
  try {
    planar_isotopy(start, end);
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "";
}

TEST(PlanarIsotopy, a_letter_turns_into_its_mirror_image) {
  expect_isotopy({letter()}, {letter(0, -1)});
}

TEST(PlanarIsotopy, a_triangle_turns_into_a_letter_of_more_points) {
  expect_isotopy({polygon({0, 0, 3, 0, 0, 4})}, {letter()});
}

TEST(PlanarIsotopy, clockwise_curves_go_the_same_way) {
  expect_isotopy({polygon({0, 0, 0, 4, 3, 0})}, {polygon({0, 0, 0, 1, 5, 1, 5, 0})});
}

TEST(PlanarIsotopy, locked_letters_come_apart_and_change_places) {
  expect_isotopy({letter(), letter(1, -1, 0.9)}, {letter(-3), letter(3, -1)});
  expect_isotopy({letter(-3), letter(3)}, {letter(3), letter(-3)});
}

TEST(IsotopyFrame, curves_are_simple_as_they_are_read_back_far_from_the_origin_too) {
  const double x = 1e6, far = x + 1e-3;
  const std::vector<Curve> square{polygon({x, x, far, x, far, far, x, far})};
  const Isotopy made = planar_isotopy(square, square);
  ASSERT_EQ(made.status, Status::embedded);
  for (const double time : {0.0, 0.4, 1.0}) {
    const std::vector<Curve> back = CurveDocument::parse(isotopy_frame_svg(made, time), CurveFormat::svg).curves();
    ASSERT_EQ(back.size(), 1U);
    EXPECT_EQ(back[0].points, isotopy_slice(made, time)[0].points);
    EXPECT_EQ(oracle::count_crossings(back, {}), 0U);
  }
}

TEST(PlanarIsotopy, refuses_what_cannot_be) {
  const Curve square = polygon({0, 0, 1, 0, 1, 1, 0, 1}), backwards = polygon({0, 0, 0, 1, 1, 1, 1, 0});
  EXPECT_NE(refusal({square}, {backwards}).find("runs around the other way"), std::string::npos);
  EXPECT_NE(refusal({square}, {polygon({0, 0, 1, 1, 1, 0, 0, 1})}).find("cross"), std::string::npos);
  EXPECT_NE(refusal({square}, {square, letter()}).find("equally many"), std::string::npos);
  EXPECT_NE(refusal({letter(), polygon({-1.05, 0, -0.95, 0, -1, 0.05})}, {square, letter(9)}).find("lies within"),
            std::string::npos);
  Curve open = square;
  open.closed = false;
  EXPECT_NE(refusal({open}, {square}).find("is open"), std::string::npos);
  EXPECT_EQ(planar_isotopy(std::vector{letter()}, std::vector{square}, {.time_limit_s = 1e-9}).status,
            Status::time_limit);
}

}  // namespace
}  // namespace unsnarl
