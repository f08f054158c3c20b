#include "energy/orientation_barrier.h"

#include <gtest/gtest.h>

#include <cmath>

#include "energy/finite_differences.h"
#include "mesh/areas.h"

namespace unsnarl {
namespace {

const std::vector<Triangle> one = {{0, 1, 2}};

Positions corner(double height) {
  Positions x(3, 3);
  x.col(0) = Vec3(0, 0, 0);
  x.col(1) = Vec3(2, 0, 0);
  x.col(2) = Vec3(0.5, height, 0);
  return x;
}

/// c of the formula.
double area_share(const Positions& rest, const Positions& x) {
  const Vec3 at_rest = area_vector(rest, one[0]);
  return at_rest.dot(area_vector(x, one[0])) / at_rest.squaredNorm();
}

TEST(OrientationBarrier, RestShapeAndItsSurroundingsHaveNoEnergy) {
  const OrientationBarrier barrier(corner(1), corner(1), one, {});
  OrientationBarrier::Term term;
  for (double height : {1.0, 0.5, 0.2, 3.0}) {
    EXPECT_EQ(barrier.value(corner(height), 0), 0);
    EXPECT_FALSE(barrier.evaluate(corner(height), 0, term));
  }
  EXPECT_GT(barrier.value(corner(0.19), 0), 0);
}

TEST(OrientationBarrier, IsInfiniteFromTheEdgeOn) {
  const OrientationBarrier barrier(corner(1), corner(1), one, {});
  EXPECT_TRUE(std::isinf(barrier.value(corner(0), 0)));
  EXPECT_TRUE(std::isinf(barrier.value(corner(-0.5), 0)));
  EXPECT_GT(barrier.value(corner(0.01), 0), barrier.value(corner(0.1), 0));
}

TEST(OrientationBarrier, PullsBackWhatWasTurnedAndThenKeepsIt) {
  OrientationBarrier barrier(corner(1), corner(-0.3), one, {});
  const double turned = barrier.value(corner(-0.3), 0);
  EXPECT_TRUE(std::isfinite(turned));
  EXPECT_GT(turned, barrier.value(corner(-0.1), 0));
  EXPECT_GT(barrier.value(corner(-0.1), 0), barrier.value(corner(0.1), 0));
  barrier.update(corner(-0.1));
  EXPECT_TRUE(std::isfinite(barrier.value(corner(-0.1), 0)));
  barrier.update(corner(0.1));
  EXPECT_TRUE(std::isinf(barrier.value(corner(-0.1), 0)));
}

TEST(OrientationBarrier, TrianglesWithoutAreaAtRestAreFree) {
  const OrientationBarrier barrier(corner(0), corner(0), one, {});
  EXPECT_EQ(barrier.value(corner(-1), 0), 0);
}

TEST(OrientationBarrier, DerivativesAgreeWithFiniteDifferences) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Positions rest = corner(1) + 0.1 * random_positions(seed, 3);
    const Positions start = seed % 2 ? corner(0.1) : corner(-0.1);
    const Positions x = start + 0.03 * random_positions(seed + 100, 3);
    const OrientationBarrier barrier(rest, start, one, {.scale = 3, .activation = 0.3});
    OrientationBarrier::Term term;
    ASSERT_TRUE(barrier.evaluate(x, 0, term));
    EXPECT_DOUBLE_EQ(term.value, barrier.value(x, 0));
    expect_gradient([&](const Positions& y) { return barrier.value(y, 0); }, x, term.force * term.gradient, 1e-7, 1e-5);
    // The second derivative along the gradient of the share, by differences of the force.
    const double step = 1e-6;
    const Positions ahead = x + step * term.gradient, behind = x - step * term.gradient;
    OrientationBarrier::Term a, b;
    ASSERT_TRUE(barrier.evaluate(ahead, 0, a) && barrier.evaluate(behind, 0, b));
    const double travelled = area_share(rest, ahead) - area_share(rest, behind);
    EXPECT_NEAR((a.force - b.force) / travelled, term.stiffness, 1e-4 * std::abs(term.stiffness));
  }
}

}  // namespace
}  // namespace unsnarl
