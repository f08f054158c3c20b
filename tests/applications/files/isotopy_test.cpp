#include "unsnarl/isotopy.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

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

Isotopy expect_isotopy(const std::vector<Curve>& start, const std::vector<Curve>& end,
                       const IsotopyOptions& wanted = {}) {
  Isotopy made = planar_isotopy(start, end, wanted);
  EXPECT_EQ(made.status, Status::embedded);
  if (made.status != Status::embedded) return made;
  FindOptions options;
  options.weld = Weld::none;
  EXPECT_TRUE(find_intersections(made.surface, options).empty());
  EXPECT_EQ(made.rings.front().time, 0);
  EXPECT_EQ(made.rings.back().time, 1);
  for (std::size_t c = 0; c < start.size(); ++c) {
    EXPECT_EQ(made.rings.front().curves[c], start[c].points);
    EXPECT_EQ(made.rings.back().curves[c], end[made.partner[c]].points);
    EXPECT_EQ(made.on_start[c].size(), static_cast<std::size_t>(made.points[c]));
    EXPECT_EQ(made.on_end[c].size(), static_cast<std::size_t>(made.points[c]));
  }
  for (int k = 0; k <= 60; ++k) EXPECT_EQ(oracle::count_crossings(isotopy_slice(made, k / 60.0), {}), 0U) << k;
  for (const IsotopyRing& ring : made.rings)
    EXPECT_EQ(oracle::count_crossings(isotopy_slice(made, ring.time), {}), 0U) << ring.time;
  const std::string animation = isotopy_animation_svg(made);
  EXPECT_NE(animation.find("<animate attributeName=\"points\""), std::string::npos);
  return made;
}

/// A comb of teeth that point upward, counter-clockwise.
Curve comb(int teeth) {
  std::vector<double> points{0, 0, 2.0 * teeth - 1, 0};
  for (int k = teeth - 1; k >= 0; --k) {
    points.insert(points.end(), {2.0 * k + 1, 10, 2.0 * k, 10});
    if (k > 0) points.insert(points.end(), {2.0 * k, 1, 2.0 * k - 1, 1});
  }
  return polygon(points);
}

Curve square(double x, double y, double half) {
  return polygon({x - half, y - half, x + half, y - half, x + half, y + half, x - half, y + half});
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
  IsotopyOptions exchange;
  exchange.pairs = {{0, 1}, {1, 0}};
  const Isotopy made = expect_isotopy({letter(-3), letter(3)}, {letter(-3), letter(3)}, exchange);
  EXPECT_EQ(made.partner, (std::vector<std::int32_t>{1, 0}));
}

TEST(PlanarIsotopy, curves_become_those_that_are_near) {
  const Isotopy made = expect_isotopy({square(0, 0, 1), square(9, 0, 1)}, {square(9, 1, 2), square(0, 1, 2)});
  EXPECT_EQ(made.partner, (std::vector<std::int32_t>{1, 0}));
  EXPECT_EQ(made.method, IsotopyMethod::annulus);
}

TEST(PlanarIsotopy, what_lies_in_a_curve_stays_in_it) {
  const std::vector<Curve> start{square(0, 0, 5), square(-2, 0, 1), square(2, 0, 1), square(20, 0, 3)};
  IsotopyOptions exchange;
  exchange.pairs = {{1, 2}, {2, 1}};
  const Isotopy made = expect_isotopy(start, start, exchange);
  EXPECT_EQ(made.partner, (std::vector<std::int32_t>{0, 2, 1, 3}));
}

TEST(PlanarIsotopy, a_comb_keeps_its_length_on_the_way_to_a_square) {
  const Isotopy made = expect_isotopy({comb(12)}, {square(0, 0, 9)});
  EXPECT_EQ(made.method, IsotopyMethod::annulus);
  EXPECT_GT(made.length_kept, 0.75);
  EXPECT_GT(made.area_kept, 0.75);
}

/// A band that winds up: `width` wide, its turns at a distance of 1.
Curve spiral(int turns, double width, int points_a_turn = 30) {
  std::vector<double> points;
  const int n = turns * points_a_turn;
  const auto add = [&](int k, double side) {
    const double angle = 2 * std::numbers::pi * k / points_a_turn;
    const double r = 0.3 + static_cast<double>(k) / points_a_turn + side * width / 2;
    points.insert(points.end(), {r * std::cos(angle), r * std::sin(angle)});
  };
  for (int k = 0; k <= n; ++k) add(k, 1);
  for (int k = n; k >= 0; --k) add(k, -1);
  return polygon(points);
}

/// The drawing seen in a mirror, in the same orientation.
Curve mirrored(const Curve& curve) {
  std::vector<double> points;
  for (std::size_t k = curve.size(); k-- > 0;)
    points.insert(points.end(), {-curve.points[2 * k], curve.points[2 * k + 1]});
  return polygon(points);
}

TEST(PlanarIsotopy, a_thin_spiral_of_fifteen_turns_unwinds_and_winds_the_other_way) {
  const Isotopy made = expect_isotopy({spiral(15, 0.04)}, {mirrored(spiral(15, 0.04))});
  EXPECT_EQ(made.method, IsotopyMethod::shortening);
  // Drawings have their own numbers of points: one replaces the other.
  EXPECT_NE(isotopy_animation_svg(made, 3).find("calcMode=\"discrete\""), std::string::npos);
  EXPECT_GT(made.shortened, 0);
  // Corners that are gone take no room: rings of all points would be several times as many faces.
  EXPECT_LT(made.surface.view().face_count(), 200000U);
}

TEST(PlanarIsotopy, combs_whose_teeth_differ) {
  expect_isotopy({comb(30)}, {mirrored(comb(7))});
  expect_isotopy({comb(5)}, {spiral(2, 0.2)});
}

TEST(PlanarIsotopy, what_lies_in_a_bent_curve_is_not_left_behind) {
  // The squares lie at both ends of the letter, in which neither end can be cut off.
  const std::vector<Curve> start{letter(), square(0.5, 0.866, 0.05), square(0.5, -0.866, 0.05), square(-1, 0, 0.05)};
  const std::vector<Curve> end{square(0, 0, 1), square(-0.5, 0, 0.1), square(0.5, 0, 0.1), square(0, 0.5, 0.1)};
  IsotopyOptions around;
  around.pairs = {{1, 1}, {2, 2}, {3, 3}};
  const Isotopy made = expect_isotopy(start, end, around);
  EXPECT_EQ(made.method, IsotopyMethod::shortening);
  expect_isotopy(end, start, around);
}

TEST(PlanarIsotopy, what_lies_in_a_curve_along_the_axes_changes_places_from_every_first_point) {
  // A plus, in whose corners squares stand, with a square in each arm. Many corners and middles are in line.
  const std::vector<double> plus{-1, 3, -1, 1, -3, 1, -3, -1, -1, -1, -1, -3, 1, -3, 1, -1, 3, -1, 3, 1, 1, 1, 1, 3};
  for (std::size_t first = 0; first < plus.size(); first += 6) {
    std::vector<double> points = plus;
    std::rotate(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(first), points.end());
    std::vector<Curve> start{polygon(points)};
    for (const auto& [x, y] : {std::pair{0.0, 2.1}, std::pair{0.0, -2.1}, std::pair{2.1, 0.0}, std::pair{-2.1, 0.0}})
      start.push_back(square(x, y, 0.7));
    for (const double x : {-1.4, 1.4})
      for (const double y : {-1.4, 1.4}) start.push_back(square(x, y, 0.3));
    IsotopyOptions exchange;
    exchange.pairs = {{1, 3}, {3, 1}};
    EXPECT_EQ(planar_isotopy(start, start, exchange).status, Status::embedded) << first;
  }
}

TEST(PlanarIsotopy, rungs_lead_around_every_curve) {
  const Isotopy made = expect_isotopy({spiral(4, 0.1)}, {square(0, 0, 1)});
  ASSERT_EQ(made.rungs.size() + 1, made.rings.size());
  for (std::size_t k = 0; k < made.rungs.size(); ++k) {
    const auto lower = static_cast<std::int32_t>(made.rings[k].curves[0].size() / 2);
    const auto upper = static_cast<std::int32_t>(made.rings[k + 1].curves[0].size() / 2);
    std::int32_t lower_steps = 0, upper_steps = 0;
    const std::vector<IsotopyRung>& rungs = made.rungs[k][0];
    for (std::size_t i = 0; i < rungs.size(); ++i) {
      const IsotopyRung &at = rungs[i], &next = rungs[(i + 1) % rungs.size()];
      const std::int32_t by_lower = (next.lower - at.lower + lower) % lower,
                         by_upper = (next.upper - at.upper + upper) % upper;
      EXPECT_LE(by_lower, 1);
      EXPECT_LE(by_upper, 1);
      lower_steps += by_lower;
      upper_steps += by_upper;
    }
    EXPECT_EQ(lower_steps, lower);
    EXPECT_EQ(upper_steps, upper);
  }
}

TEST(PlanarIsotopy, the_animation_has_as_many_drawings_as_frames_there_and_back) {
  const Isotopy made = planar_isotopy(std::vector{square(0, 0, 1)}, std::vector{square(1, 0, 2)});
  const std::string text = isotopy_animation_svg(made, 5);
  const std::size_t from = text.find("values=\"") + 8;
  const std::string values = text.substr(from, text.find('"', from) - from);
  EXPECT_EQ(std::count(values.begin(), values.end(), ';'), 9);
  // All of as many points, so that browsers move from one to the next.
  EXPECT_NE(text.find("calcMode=\"linear\""), std::string::npos);
  std::istringstream drawings(values);
  for (std::string drawing; std::getline(drawings, drawing, ';');)
    EXPECT_EQ(std::count(drawing.begin(), drawing.end(), ','), 2 * made.points[0]);
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
  const Curve inner = polygon({-1.05, 0, -0.95, 0, -1, 0.05});
  EXPECT_NE(refusal({letter(), inner}, {square, letter(9)}).find("at the start 1 in none, 1 in curve 0; at the end 2"),
            std::string::npos);
  const auto with_pairs = [&](std::vector<std::array<std::int32_t, 2>> pairs) {
    IsotopyOptions options;
    options.pairs = std::move(pairs);
    try {
      planar_isotopy(std::vector{letter(), inner}, std::vector{letter(), inner}, options);
    } catch (const std::invalid_argument& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_NE(with_pairs({{0, 1}}).find("only the latter lies in another curve"), std::string::npos)
      << with_pairs({{0, 1}});
  EXPECT_NE(with_pairs({{0, 2}}).find("a pair names curve 2 of the end, which has 2"), std::string::npos);
  EXPECT_NE(with_pairs({{0, 0}, {0, 1}}).find("two pairs name curve 0 of the start"), std::string::npos);
  Curve open = square;
  open.closed = false;
  EXPECT_NE(refusal({open}, {square}).find("is open"), std::string::npos);
  IsotopyOptions soon;
  soon.time_limit_s = 1e-9;
  EXPECT_EQ(planar_isotopy(std::vector{letter()}, std::vector{square}, soon).status, Status::time_limit);
}

}  // namespace
}  // namespace unsnarl
