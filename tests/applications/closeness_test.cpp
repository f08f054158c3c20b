#include "applications/curves/closeness.h"

#include <gtest/gtest.h>

namespace unsnarl {
namespace {

CurveNet net_of(std::vector<double> points, bool closed) {
  const Curve curve{.points = std::move(points), .closed = closed, .fixed = {}, .name = {}};
  return make_net({&curve, 1}, {}, false);
}

TEST(Closeness, is_measured_along_segments_and_in_one_direction) {
  // A square with a diagonal of 1, and the same without its top: all points of the latter are on the former.
  const double side = 0.70710678118654752;
  const CurveNet square = net_of({0, 0, side, 0, side, side, 0, side}, true);
  const CurveNet cup = net_of({0, side, 0, 0, side, 0, side, side}, false);
  const Closeness there = closeness_of(square, square.rest, cup, cup.rest, 0.005);
  EXPECT_NEAR(there.largest, side / 2, 1e-3);
  EXPECT_NEAR(there.mean, side / 4 / 4, 1e-3);
  EXPECT_NEAR(there.lost, 0.25, 0.01);
  const Closeness back = closeness_of(cup, cup.rest, square, square.rest, 0.005);
  EXPECT_EQ(back.largest, 0);
  EXPECT_EQ(back.lost, 0);
}

TEST(Closeness, does_not_depend_on_points_along_a_line) {
  const CurveNet coarse = net_of({0, 0, 1, 0}, false), fine = net_of({0, 0.25, 0.3, 0.25, 0.9, 0.25, 1, 0.25}, false);
  const Closeness result = closeness_of(coarse, coarse.rest, fine, fine.rest, 0.3);
  EXPECT_NEAR(result.mean, 0.25, 1e-12);
  EXPECT_NEAR(result.largest, 0.25, 1e-12);
  EXPECT_EQ(result.lost, 0);
}

}  // namespace
}  // namespace unsnarl
