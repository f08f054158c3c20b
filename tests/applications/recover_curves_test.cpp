#include "applications/curves/recover_curves.h"

#include <gtest/gtest.h>

namespace unsnarl {
namespace {

TEST(RecoverCurves, never_passes_through_anything) {
  // A stick that wants to be on the other side of a wall.
  std::vector<Curve> curves(2);
  curves[0] = {.points = {0, 0, 0, 10}, .closed = false, .fixed = {1, 1}, .name = {}};
  curves[1] = {.points = {1, 4, 1, 5, 1, 6}, .closed = false, .fixed = {}, .name = {}};
  const CurveNet net = make_net(curves, {}, false);
  CurveState state{net.rest, net.rest, std::vector<std::uint8_t>(net.vertex_count(), 0)};
  for (Index v = 0; v < net.vertex_count(); ++v)
    if (!net.fixed[v]) state.target(0, v) = -3;
  const double gap = 0.1;
  EXPECT_GT(recover_curves(net, state, gap, {}, [] { return false; }), 1);
  for (Index v = 0; v < net.vertex_count(); ++v)
    if (!net.fixed[v]) {
      EXPECT_GT(state.x(0, v), 0);
      EXPECT_LT(state.x(0, v), gap);
    }
}

TEST(RecoverCurves, reaches_targets_that_nothing_bars) {
  const Curve curve{.points = {0, 0, 1, 0, 2, 1, 3, 1}, .closed = false, .fixed = {}, .name = {}};
  const CurveNet net = make_net({&curve, 1}, {}, false);
  CurveState state{net.rest, net.rest, std::vector<std::uint8_t>(net.vertex_count(), 0)};
  state.x.colwise() += Vec2(0.2, -0.1);
  recover_curves(net, state, 0.01, {}, [] { return false; });
  EXPECT_LT((state.x - state.target).colwise().norm().maxCoeff(), 1e-3);
}

TEST(RecoverCurves, a_strong_pull_does_not_press_gaps_shut) {
  // Nearly on a wall, and pulled to nearly a diagonal behind it: harder than the barrier of a gap so small can push.
  std::vector<Curve> curves(2);
  curves[0] = {.points = {0, 0, 0, 10}, .closed = false, .fixed = {1, 1}, .name = {}};
  curves[1] = {.points = {1e-4, 4, 1e-4, 5, 1e-4, 6}, .closed = false, .fixed = {}, .name = {}};
  const CurveNet net = make_net(curves, {}, false);
  CurveState state{net.rest, net.rest, std::vector<std::uint8_t>(net.vertex_count(), 0)};
  for (Index v = 0; v < net.vertex_count(); ++v)
    if (!net.fixed[v]) state.target(0, v) = -9.5;
  recover_curves(net, state, 0.04, {}, [] { return false; });
  for (Index v = 0; v < net.vertex_count(); ++v)
    if (!net.fixed[v]) {
      EXPECT_GT(state.x(0, v), 1e-6);
    }
}

}  // namespace
}  // namespace unsnarl
