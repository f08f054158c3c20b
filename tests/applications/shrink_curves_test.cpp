#include "applications/curves/shrink_curves.h"

#include <gtest/gtest.h>

namespace unsnarl {
namespace {

TEST(ShrinkCurves, frees_a_curve_that_meets_another) {
  std::vector<Curve> curves(2);
  curves[0] = {.points = {0, 0, 4, 0, 4, 4, 0, 4}, .closed = true, .fixed = {1, 1, 1, 1}, .name = {}};
  curves[1] = {.points = {3, 1, 5, 1, 5, 2, 3, 2}, .closed = true, .fixed = {}, .name = {}};
  const CurveNet net = make_net(curves, {}, false);
  CurveState state{net.rest, net.rest, std::vector<std::uint8_t>(net.vertex_count(), 0)};
  EXPECT_TRUE(shrink_curves(net, state, {}).empty());
}

}  // namespace
}  // namespace unsnarl
