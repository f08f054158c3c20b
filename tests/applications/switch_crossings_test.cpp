#include "applications/curves/switch_crossings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace unsnarl {
namespace {

CurveState at_rest(const CurveNet& net) {
  return {net.rest, net.rest, std::vector<std::uint8_t>(net.vertex_count(), 0)};
}

TEST(SwitchCrossings, crossings_at_the_ends_of_segments_are_in_order) {
  // Three strands pass through about one point; two have a vertex there that is a few units in the last place beside
  // it. They cross so near the ends of segments that the computed places are the ends.
  const double ulp = 0x1p-46;
  const Curve curve{
      .points = {0, -1, 2 * ulp, -ulp, 0, 1, -0.25, -1, 2 * ulp, -2 * ulp, 0.25, 1, -1, 0.25, 0, 0, 1, -0.25},
      .closed = true,
      .fixed = {},
      .name = {}};
  // Far from the origin: places that were never set would be seen.
  const Vec2 middle(101, 101);
  Curve moved = curve;
  for (double& c : moved.points) c += 101;
  const CurveNet net = make_net({&moved, 1}, {}, false);
  CurveState state = at_rest(net);
  EXPECT_TRUE(switch_crossings(net, state, {}, [](std::size_t) { return false; }).empty());
  EXPECT_LT((state.x.colwise() - middle).cwiseAbs().maxCoeff(), 1.1);
  EXPECT_LT((state.target.colwise() - middle).cwiseAbs().maxCoeff(), 1.1);
}

TEST(SwitchCrossings, points_that_nearly_touch_are_moved_apart) {
  // A bow tie, and a tip that is one unit in the last place above a line.
  const std::vector<Curve> curves{
      {.points = {0, 0, 1, 1, 1, 0, 0, 1}, .closed = true, .fixed = {}, .name = {}},
      {.points = {5, 1, 9, 1}, .closed = false, .fixed = {}, .name = {}},
      {.points = {6, 3, 7, std::nextafter(1.0, 2.0), 8, 3}, .closed = false, .fixed = {}, .name = {}}};
  const CurveNet net = make_net(curves, {}, false);
  const SwitchOptions options;
  CurveState state = at_rest(net);
  EXPECT_TRUE(switch_crossings(net, state, options, [](std::size_t) { return false; }).empty());
  SegmentTree tree(net);
  tree.refit(state.x);
  const auto close = vertices_closer_than(net, tree, state.x, options.least_gap_rel * net.diagonal);
  EXPECT_EQ(std::count(close.begin(), close.end(), 1), 0);
  EXPECT_LT((state.x - net.rest).rightCols(5).cwiseAbs().maxCoeff(), 1e-3);
}

}  // namespace
}  // namespace unsnarl
