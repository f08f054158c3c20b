#include "contact/motion_frames.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "contact/dice.h"
#include "contact/intersection_finder.h"
#include "geometry/triangle_intersection.h"

namespace unsnarl {
namespace {

const std::vector<Triangle> two = {{0, 1, 2}, {3, 4, 5}};

/// Two triangles above each other.
Positions stacked(double apart, const Vec3& at) {
  Positions x(3, 6);
  x << 0, 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0, apart, apart, apart;
  x.colwise() += at;
  return x;
}

TEST(MotionFrames, nothing_is_known_at_first) {
  MotionFrames frames(two);
  frames.update(stacked(1, Vec3::Zero()));
  EXPECT_FALSE(frames.holds(0, 1, {}));
}

TEST(MotionFrames, holds_until_the_triangles_may_have_met) {
  for (const Vec3& at : {Vec3(0, 0, 0), Vec3(1e6, -3e5, 7e7)}) {
    Positions x = stacked(0.25, at);
    MotionFrames frames(two);
    frames.update(x);
    const auto clearance = frames.clearance(0, 1, 0.25);
    EXPECT_TRUE(frames.holds(0, 1, clearance));
    for (int step = 1; step <= 16; ++step) {
      x.row(2).tail(3).array() -= 0.25 / 16;
      frames.update(x);
      if (step == 12) {
        EXPECT_TRUE(frames.holds(0, 1, clearance));
      }
    }
    EXPECT_FALSE(frames.holds(0, 1, clearance)) << "they touch";
  }
}

TEST(MotionFrames, triangles_that_move_together_keep_their_clearance) {
  Positions x = stacked(0.25, Vec3::Zero());
  MotionFrames frames(two);
  frames.update(x);
  const auto clearance = frames.clearance(1, 0, 0.25);
  Dice dice(1);
  for (int step = 0; step < 1000; ++step) {
    x.colwise() += dice.vector();
    frames.update(x);
    ASSERT_TRUE(frames.holds(1, 0, clearance)) << step;
  }
}

TEST(MotionFrames, a_corner_that_moves_alone_counts) {
  Positions x = stacked(0.25, Vec3::Zero());
  MotionFrames frames(two);
  frames.update(x);
  const auto clearance = frames.clearance(0, 1, 0.25);
  x(2, 5) = -0.25;
  frames.update(x);
  EXPECT_FALSE(frames.holds(0, 1, clearance));
}

TEST(MotionFrames, nothing_holds_after_positions_that_are_no_numbers) {
  Positions x = stacked(0.25, Vec3::Zero());
  MotionFrames frames(two);
  frames.update(x);
  const auto clearance = frames.clearance(0, 1, 0.25);
  Positions lost = x;
  for (const double value : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    lost(1, 4) = value;
    frames.update(lost);
    EXPECT_FALSE(frames.holds(0, 1, clearance));
    frames.update(x);
    EXPECT_FALSE(frames.holds(0, 1, clearance));
  }
}

// Wherever a clearance holds, the exact test finds the two apart. Far from the origin, as slivers, in drifts of all
// lengths.
TEST(MotionFrames, no_clearance_holds_of_two_that_meet) {
  Dice dice(7);
  int held = 0, met = 0;
  for (int round = 0; round < 4000; ++round) {
    const double flat = round % 3 == 0 ? 1e-5 : 1, far = round % 4 == 0 ? 1e5 : 1, jump = std::pow(0.1, round % 5);
    Positions x(3, 6);
    for (Index v = 0; v < 6; ++v) x.col(v) = far * Vec3(1, 2, -1) + dice.vector().cwiseProduct(Vec3(1, 1, flat));
    MotionFrames frames(two);
    frames.update(x);
    MotionFrames::Clearance clearance;
    for (int step = 0; step < 12; ++step) {
      const TrianglePoints a = points_of(x, two[0]), b = points_of(x, two[1]);
      PairClass kind;
      const bool meet = intersects(x, two[0], two[1], kind);
      if (frames.holds(0, 1, clearance)) {
        ++held;
        ASSERT_FALSE(meet) << round << ", step " << step;
      } else if (const double apart = separation(a, b); apart > 0) {
        clearance = frames.clearance(0, 1, apart);
      }
      met += meet;
      const Vec3 drift = dice.vector();
      for (Index v = 0; v < 6; ++v) x.col(v) += drift + 0.3 * jump * dice.vector();
      frames.update(x);
    }
  }
  EXPECT_GT(held, 2000);
  EXPECT_GT(met, 2000);
}

}  // namespace
}  // namespace unsnarl
