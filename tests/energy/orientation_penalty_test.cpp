#include "energy/orientation_penalty.h"

#include <gtest/gtest.h>

#include <cmath>

#include "energy/energy_checks.h"
#include "mesh/areas.h"

namespace unsnarl {
namespace {

const std::vector<Triangle> one = {{0, 1, 2}};
const std::vector<Index> first = {0};

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

TEST(OrientationPenalty, rest_shape_and_its_surroundings_have_no_energy) {
  const OrientationPenalty penalty(corner(1), one, {});
  for (double height : {1.0, 0.5, 0.2, 3.0}) {
    EXPECT_EQ(penalty.value(corner(height), 0), 0);
    EXPECT_TRUE(linearise_all(penalty, corner(height), 1).hessian.rank_ones.empty());
  }
  EXPECT_GT(penalty.value(corner(0.19), 0), 0);
}

TEST(OrientationPenalty, grows_the_farther_a_face_is_flipped) {
  const OrientationPenalty penalty(corner(1), one, {});
  EXPECT_GT(penalty.value(corner(-0.1), 0), penalty.value(corner(0.1), 0));
  EXPECT_GT(penalty.value(corner(-0.3), 0), penalty.value(corner(-0.1), 0));
  EXPECT_TRUE(std::isfinite(penalty.value(corner(-100), 0)));
}

TEST(OrientationPenalty, triangles_without_area_at_rest_are_free) {
  const OrientationPenalty penalty(corner(0), one, {});
  EXPECT_EQ(penalty.value(corner(-1), 0), 0);
  Positions p = corner(-1);
  penalty.filter(corner(1), first, 0.2, 0.5, p);
  EXPECT_EQ(p, corner(-1));
}

TEST(OrientationPenalty, derivatives_agree_with_finite_differences) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Positions rest = corner(1) + 0.1 * random_positions(seed, 3);
    const Positions x = corner(seed % 2 ? 0.1 : -0.1) + 0.03 * random_positions(seed + 100, 3);
    const OrientationPenalty penalty(rest, one, {.activation = 0.3});
    EXPECT_EQ(penalty.is_flipped(x, 0), area_share(rest, x) < 0);
    expect_derivatives(penalty, x, 1e-7, 1e-5);
    // The second derivative in the area share, by differences of the force along its gradient.
    const HessianTerms::RankOne term = linearise_all(penalty, x, 1).hessian.rank_ones.at(0);
    const Positions along = term.g.leftCols<3>();
    const double step = 1e-6;
    const Positions ahead = x + step * along, behind = x - step * along;
    const auto force = [&](const Positions& y) {
      const Linearised at = linearise_all(penalty, y, 1);
      const Positions g = at.hessian.rank_ones.at(0).g.leftCols<3>();
      return at.gradient.cwiseProduct(g).sum() / g.squaredNorm();
    };
    const double travelled = area_share(rest, ahead) - area_share(rest, behind);
    EXPECT_NEAR((force(ahead) - force(behind)) / travelled, term.stiffness, 1e-3 * term.stiffness);
  }
}

// A needle at rest that has become wide.
TEST(OrientationPenalty, grows_linearly_where_a_face_is_many_times_flipped) {
  const OrientationPenalty penalty(corner(1), one, {.linear = 30});
  const auto growth = [&](double height) {
    return penalty.value(corner(height - 1), 0) - penalty.value(corner(height), 0);
  };
  EXPECT_NEAR(growth(-31), growth(-1000), 1e-6 * growth(-31));
  EXPECT_LT(growth(-20), 0.9 * growth(-31));
  const Positions x = corner(-50);
  expect_derivatives(penalty, x, 1e-6, 1e-4);
  EXPECT_GT(linearise_all(penalty, x, 1).hessian.rank_ones.at(0).stiffness, 0);
}

TEST(OrientationPenalty, filter_stops_what_would_flip_a_face) {
  const OrientationPenalty penalty(corner(1), one, {});
  Positions p = Positions::Zero(3, 3);
  p(1, 2) = -0.7;  // keeps 0.3 of its share
  Positions kept = p;
  EXPECT_FALSE(penalty.filter(corner(1), first, 0.2, 0.5, kept));
  EXPECT_EQ(kept, p);
  p(1, 2) = -3;
  EXPECT_TRUE(penalty.filter(corner(1), first, 0.2, 0.5, p));
  EXPECT_EQ(p(1, 2), -0.75);
  const double share = area_share(corner(1), Positions(corner(1) + p));
  EXPECT_GE(share, 0.2);
}

TEST(OrientationPenalty, filter_lets_flipped_faces_move) {
  const OrientationPenalty penalty(corner(1), one, {});
  Positions p = Positions::Zero(3, 3);
  p(1, 2) = -3;
  const Positions whole = p;
  penalty.filter(corner(-0.1), first, 0.2, 0.5, p);
  EXPECT_EQ(p, whole);
}

TEST(OrientationPenalty, projects_a_flip_onto_the_share_that_is_kept) {
  const Positions x = corner(1);
  const OrientationPenalty penalty(x, one, {});
  Positions p = Positions::Zero(3, 3);
  p.col(2) = Vec3(0.3, -1.5, 0.7);
  ASSERT_LT(area_share(x, x + p), 0);
  const std::vector<std::uint8_t> moves = {0, 1, 1};
  int sweeps = 0;
  while (penalty.project(x, first, 0.2, moves, p)) ASSERT_LT(++sweeps, 20);
  EXPECT_GE(area_share(x, x + p), 0.2);
  EXPECT_LT(area_share(x, x + p), 0.21);
  EXPECT_TRUE(p.col(0).isZero(0));
  EXPECT_NEAR(p(2, 2), 0.7, 1e-12);  // along the face it may go
}

TEST(OrientationPenalty, projection_leaves_alone_what_keeps_its_share) {
  const Positions x = corner(1);
  const OrientationPenalty penalty(x, one, {});
  Positions p = Positions::Zero(3, 3);
  p.col(2) = Vec3(5, -0.7, 2);
  const Positions wanted = p;
  EXPECT_FALSE(penalty.project(x, first, 0.2, std::vector<std::uint8_t>(3, 1), p));
  EXPECT_EQ(p, wanted);
}

}  // namespace
}  // namespace unsnarl
