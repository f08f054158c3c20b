#include "applications/routes/proven_bounds.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "applications/routes/segments.h"
#include "contact/distances.h"
#include "energy/finite_differences.h"

namespace unsnarl {
namespace {

TEST(ProvenBounds, touching_is_exactly_enough) {
  const std::array<Vec3, 2> a = {Vec3(0, 0, 0), Vec3(1, 0, 0)}, b = {Vec3(0.5, 0.3, -1), Vec3(0.5, 0.3, 1)};
  EXPECT_EQ(proven_clearance(a, b, Vec3(0, -1, 0), 0.3, 0), 1);
  EXPECT_LT(proven_clearance(a, b, Vec3(0, -1, 0), std::nextafter(0.3, 1), 0), 1);
  EXPECT_GT(proven_clearance(a, b, Vec3(0, -1, 0), 0.3 - 1e-12, 0), 1 - 1e-15);
  EXPECT_EQ(proven_clearance(a, b, Vec3(1, 0, 0), 0.3, 0), 0);  // not across
  EXPECT_EQ(proven_clearance(a, b, Vec3(0, 0, 0), 0.3, 0), 0);
  EXPECT_TRUE(is_as_far(Vec3(0, 0, 0), Vec3(3, 4, 0), 2, 3));
  EXPECT_FALSE(is_as_far(Vec3(0, 0, 0), Vec3(3, 4, 0), 2, std::nextafter(3, 4)));
}

TEST(ProvenBounds, is_the_distance_of_segments_and_never_more) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const Positions x = random_positions(seed, 4);
    const Closest closest = closest_edge_edge(x.col(0), x.col(1), x.col(2), x.col(3));
    const std::array<Vec3, 2> a = {x.col(0), x.col(1)}, b = {x.col(2), x.col(3)};
    const double bound = proven_clearance(a, b, closest.direction, 0.25, 0.5);
    EXPECT_LE(bound, closest.distance / 0.75 * (1 + 1e-14));
    EXPECT_GE(bound, closest.distance / 0.75 - 1e-12);
    EXPECT_LE(proven_clearance(a, b, x.col(0), 0.25, 0.5), closest.distance / 0.75 * (1 + 1e-14));
  }
}

TEST(ProvenBounds, in_time_only_what_moves_together_counts) {
  // Two that follow each other on one line, 0.75 apart: the segments lie on each other.
  const std::array<Vec3, 2> a = {Vec3(0.75, 0, 0), Vec3(1.75, 0, 0)}, b = {Vec3(0, 0, 0), Vec3(1, 0, 0)};
  EXPECT_EQ(proven_clearance(a, b, Vec3(1, 0, 0), 0.5, 0.25), 0);
  EXPECT_EQ(proven_clearance_in_time(a, b, Vec3(1, 0, 0), 0.5, 0.25), 1);
  EXPECT_LT(proven_clearance_in_time(a, b, Vec3(1, 0, 0), 0.5, std::nextafter(0.25, 1)), 1);
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const Positions x = random_positions(seed, 4);
    const Closest closest = closest_in_time(x.col(0), x.col(1), x.col(2), x.col(3));
    const std::array<Vec3, 2> p = {x.col(0), x.col(1)}, q = {x.col(2), x.col(3)};
    const double bound = proven_clearance_in_time(p, q, closest.direction, 0.25, 0.5);
    EXPECT_NEAR(bound, closest.distance / 0.75, 1e-12);
    Vec3 between = Vec3::Zero();
    for (int k = 0; k < 4; ++k) between += closest.weights[k] * x.col(k);
    EXPECT_NEAR(between.norm(), closest.distance, 1e-14);
    for (const double t : {0.0, 0.3, 0.6, 1.0})
      EXPECT_LE(bound * 0.75, ((1 - t) * (p[0] - q[0]) + t * (p[1] - q[1])).norm() * (1 + 1e-14));
  }
}

TEST(ProvenBounds, a_polygon_turns_as_its_inscribed_circle) {
  for (const int sides : {4, 6, 30, 1000}) {
    const auto corner = [&](int k) {
      const double angle = 2 * std::numbers::pi * k / sides;
      return Vec3(std::cos(angle), std::sin(angle), 0);
    };
    const double inscribed = std::cos(std::numbers::pi / sides);
    EXPECT_NEAR(proven_turn(corner(0), corner(1), corner(2), 0.5), 0.5 / inscribed, 1e-12);
    EXPECT_LE(proven_turn(corner(0), corner(1), corner(2), inscribed * (1 - 1e-9)), 1);
    EXPECT_GT(proven_turn(corner(0), corner(1), corner(2), inscribed * (1 + 1e-9)), 1);
  }
  EXPECT_EQ(proven_turn(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0), 5), 0);
  EXPECT_GT(proven_turn(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 0, 0), 1e-9), 1e300);
  EXPECT_GT(proven_turn(Vec3(0, 0, 0), Vec3(0, 0, 0), Vec3(1, 0, 0), 1e-9), 1e300);
  // A right angle between edges of one length: exactly as tight as half of it.
  EXPECT_EQ(proven_turn(Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(2, 0, 0) + Vec3(0, 2, 0), 1), 1);
}

}  // namespace
}  // namespace unsnarl
