#include "applications/curves/reroute_crossings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace unsnarl {
namespace {

CrossedCurves crossed(const std::vector<Curve>& curves, double beside) {
  const CurveNet net = make_net(curves, {}, false);
  return with_crossing_points(net, net.rest, find_meetings(net, net.rest), beside);
}

TEST(CrossingPoints, lie_beside_the_crossings_of_their_segments) {
  const std::vector<Curve> curves{{.points = {0, 0, 10, 0}, .closed = false, .fixed = {}, .name = {}},
                                  {.points = {5, -5, 5, 5}, .closed = false, .fixed = {}, .name = {}},
                                  {.points = {5.1, -5, 5.1, 5}, .closed = false, .fixed = {}, .name = {}}};
  const CrossedCurves result = crossed(curves, 0.5);
  ASSERT_EQ(result.crossings.size(), 2U);
  // One on either side, and one in the middle between the two.
  ASSERT_EQ(result.net.chains[0].size(), 5);
  std::vector<double> x;
  for (const Index v : result.net.chains[0].vertices) x.push_back(result.x(0, v));
  for (const auto& [found, expected] :
       {std::pair{x[1], 4.5}, std::pair{x[2], 5.05}, std::pair{x[3], 5.6}, std::pair{x[4], 10.0}})
    EXPECT_NEAR(found, expected, 1e-12);
  EXPECT_EQ(result.ways[0].size(), 7U);
}

TEST(RerouteCrossings, one_closed_curve_stays_one_and_keeps_its_points) {
  const Curve bow{.points = {0, 0, 4, 2, 4, 0, 0, 2}, .closed = true, .fixed = {}, .name = {}};
  const CrossedCurves before = crossed({bow}, 0.1);
  const ReroutedCurves after = reroute_crossings(before, [] { return false; });
  EXPECT_TRUE(find_meetings(after.net, before.x).empty());
  std::vector<Index> one = before.net.chains[0].vertices, other = after.net.chains[0].vertices;
  std::sort(one.begin(), one.end());
  std::sort(other.begin(), other.end());
  EXPECT_EQ(one, other);
}

TEST(RerouteCrossings, what_is_left_when_it_is_stopped_crosses_as_before) {
  const CrossedCurves before = crossed({random_closed_curve("chaos", 1, 30)}, 0.01);
  int asked = 0;
  const ReroutedCurves after = reroute_crossings(before, [&] { return ++asked > 20; });
  const std::size_t left = find_meetings(after.net, before.x).size();
  EXPECT_GT(left, 0U);
  EXPECT_LT(left, before.crossings.size());
}

TEST(RerouteCrossings, no_exchange_leaves_a_curve_that_crosses_itself_whenever_it_is_stopped) {
  std::vector<Curve> circles;
  for (int c = 0; c < 7; ++c) {
    Curve& circle = circles.emplace_back();
    circle.closed = true;
    for (int k = 0; k < 40; ++k) {
      const double t = 2 * std::numbers::pi * k / 40, squeeze = c % 2 == 0 ? 1 : 0.3;
      circle.points.insert(circle.points.end(), {0.31 * c + squeeze * std::cos(t), 0.17 * (c % 3) + std::sin(t)});
    }
  }
  const CrossedCurves before = crossed(circles, 0.01);
  std::size_t least = before.crossings.size(), most = 0;
  for (int asked_most = 0; asked_most < 60; asked_most += 3) {
    int asked = 0;
    const ReroutedCurves after = reroute_crossings(before, [&] { return ++asked > asked_most; });
    const std::vector<SegmentPair> left = find_meetings(after.net, before.x);
    for (const SegmentPair& pair : left)
      EXPECT_NE(after.net.chain_of[pair.i], after.net.chain_of[pair.j]) << asked_most;
    least = std::min(least, left.size());
    most = std::max(most, left.size());
  }
  EXPECT_EQ(most, before.crossings.size());
  EXPECT_LT(least, most / 2);
}

TEST(RerouteCrossings, a_line_that_ends_within_a_curve_takes_the_part_of_it_with_the_odd_crossing) {
  // A line through both arms of a letter U into a bar that both belong to: it crosses three times, at x = 10, 12
  // and 20.
  Curve letter{
      .points = {10, 0, 30, 0, 30, 9, 20, 9, 20, 3, 12, 3, 12, 9, 10, 9}, .closed = true, .fixed = {}, .name = {}};
  const auto left_of = [&](double end) {
    const Curve line{.points = {end, 6, 27, 6}, .closed = false, .fixed = {}, .name = {}};
    const CrossedCurves before = crossed({letter, line}, 0.1);
    EXPECT_EQ(before.crossings.size(), 3U);
    const ReroutedCurves after = reroute_crossings(before, [] { return false; });
    EXPECT_TRUE(after.net.chains[0].closed);
    EXPECT_FALSE(after.net.chains[1].closed);
    return find_meetings(after.net, before.x).size();
  };
  for (const double end : {-1.0, 9.0}) EXPECT_EQ(left_of(end), 0U) << end;
  // A part with a fixed corner is not exchanged: two crossings are opened, and one stays.
  letter.fixed = {0, 1, 0, 0, 0, 0, 0, 0};
  EXPECT_EQ(left_of(-1), 1U);
}

TEST(RerouteCrossings, the_shortest_parts_are_exchanged_and_pinned_ones_are_not) {
  // A long bar and a small square that reaches into it.
  const Curve bar{.points = {0, 0, 20, 0, 20, 2, 0, 2}, .closed = true, .fixed = {}, .name = {}};
  Curve square{.points = {9, 1, 11, 1, 11, 4, 9, 4}, .closed = true, .fixed = {}, .name = {}};
  const auto rerouted = [&] {
    const CrossedCurves before = crossed({bar, square}, 0.1);
    const ReroutedCurves after = reroute_crossings(before, [] { return false; });
    EXPECT_TRUE(find_meetings(after.net, before.x).empty());
    return after.net.chains[1].vertices;
  };
  const std::vector<Index> outside = rerouted();  // what is left of the square: its corners above the bar, at 6 and 7
  EXPECT_NE(std::find(outside.begin(), outside.end(), 6), outside.end());
  EXPECT_EQ(std::find(outside.begin(), outside.end(), 4), outside.end());
  square.fixed = {1, 0, 0, 0};
  const std::vector<Index> inside = rerouted();
  EXPECT_NE(std::find(inside.begin(), inside.end(), 4), inside.end());
}

}  // namespace
}  // namespace unsnarl
