#include "applications/curves/repel_curves.h"

#include <gtest/gtest.h>

#include <cmath>

namespace unsnarl {
namespace {

TEST(SegmentPenetration, is_the_shortest_way_apart) {
  // A stick through the middle of another, near its upper end.
  const SegmentPenetration p = segment_penetration({0, 0}, {10, 0}, {5, -3}, {5, 1});
  EXPECT_DOUBLE_EQ(p.depth, 1);
  EXPECT_NEAR((p.normal - Vec2(0, 1)).norm(), 0, 1e-12);
  // Moved so far, they only touch.
  const SegmentPenetration after = segment_penetration({0, 1}, {10, 1}, {5, -3}, {5, 1});
  EXPECT_NEAR(after.depth, 0, 1e-12);
  EXPECT_LT(segment_penetration({0, 2}, {10, 2}, {5, -3}, {5, 1}).depth, 0);
}

TEST(SegmentPenetration, gradient_is_that_of_the_depth) {
  const std::array<Vec2, 4> x{Vec2(0.1, 0.2), Vec2(3.0, 1.1), Vec2(1.4, -1.2), Vec2(1.1, 1.0)};
  const SegmentPenetration p = segment_penetration(x[0], x[1], x[2], x[3]);
  ASSERT_GT(p.depth, 0);
  const std::array<Vec2, 4> gradient{-p.weight_a[0] * p.normal, -p.weight_a[1] * p.normal, p.weight_b[0] * p.normal,
                                     p.weight_b[1] * p.normal};
  const double h = 1e-6;
  for (int v = 0; v < 4; ++v)
    for (int axis = 0; axis < 2; ++axis) {
      auto up = x, down = x;
      up[v][axis] += h;
      down[v][axis] -= h;
      const double slope = (segment_penetration(up[0], up[1], up[2], up[3]).depth -
                            segment_penetration(down[0], down[1], down[2], down[3]).depth) /
                           (2 * h);
      EXPECT_NEAR(gradient[v][axis], slope, 1e-6) << v << " " << axis;
    }
}

TEST(SegmentPenetration, points_are_no_problem) {
  const SegmentPenetration p = segment_penetration({0, 0}, {0, 0}, {1, 1}, {1, 1});
  EXPECT_TRUE(std::isfinite(p.depth));
}

TEST(ContactPairs, weight_is_the_distance_along_the_curve) {
  Curve square{.points = {0, 0, 1, 0, 1, 1, 0, 1}, .closed = true, .fixed = {}, .name = {}};
  const CurveNet net = make_net({&square, 1}, {}, false);
  const auto pairs = contact_pairs(net, 1.5);
  // Only the opposite corners are farther apart than 1.5 along the curve: half of it, so that w = 1, and every corner
  // stands for a length of 1.
  ASSERT_EQ(pairs.size(), 2U);
  for (const auto& pair : pairs) {
    EXPECT_EQ(pair.j - pair.i, 2);
    EXPECT_DOUBLE_EQ(pair.weight, 1);
  }
}

TEST(RepelCurves, separates_a_stick_that_reaches_through_a_line) {
  std::vector<Curve> curves(2);
  for (int k = 0; k <= 8; ++k) curves[0].points.insert(curves[0].points.end(), {0.5 * k, 0});
  curves[0].fixed = {1, 0, 0, 0, 0, 0, 0, 0, 1};
  curves[1] = {.points = {2.1, -1, 2.1, 0.05}, .closed = false, .fixed = {1, 0}, .name = {}};
  const CurveNet net = make_net(curves, {}, false);
  CurveState state{net.rest, net.rest, std::vector<std::uint8_t>(net.vertex_count(), 0)};
  EXPECT_TRUE(repel_curves(net, state, {}, [] { return false; }).empty());
  for (Index v = 0; v < net.vertex_count(); ++v) {
    if (net.fixed[v]) {
      EXPECT_EQ(state.x.col(v), net.rest.col(v));
    }
  }
}

}  // namespace
}  // namespace unsnarl
