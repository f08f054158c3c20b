#include "recover/step_filter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "mesh/areas.h"

namespace unsnarl {
namespace {

const std::array<Triangle, 1> one = {{{0, 1, 2}}};
const std::array<Index, 1> first = {0};

/// A triangle that stands on its base (corners 0 and 1) over a floor (vertices 3 to 5) half its height below.
Positions over_floor() {
  Positions x(3, 6);
  x << 0, 1, 0.5, -9, 9, 0,       //
      0, 0, 1, -0.5, -0.5, -0.5,  //
      0, 0, 0, -9, -9, 9;
  return x;
}

/// It falls by twice its height.
Positions fall() {
  Positions p = Positions::Zero(3, 6);
  p.row(1).head(3).setConstant(-2);
  return p;
}

/// Only the base meets the floor.
std::vector<SeparatedStencil> base_on_floor() {
  return {{{StencilKind::vertex_face, {0, 3, 4, 5}}, 0.1}, {{StencilKind::vertex_face, {1, 3, 4, 5}}, 0.1}};
}

double share_kept(const Positions& x, const Positions& p) {
  return area_vector(x, one[0]).dot(area_vector(Positions(x + p), one[0])) / area_vector(x, one[0]).squaredNorm();
}

TEST(StepFilter, a_collision_does_not_turn_a_face_over) {
  const Positions x = over_floor();
  const OrientationPenalty orientation(x, one, {});
  Positions collided = fall();
  filter_displacements(base_on_floor(), x, collided, OnCollision::shorten);
  ASSERT_LT(share_kept(x, collided), 0);

  Positions p = fall();
  filter_step(base_on_floor(), {orientation, first, 0.2}, x, p, OnCollision::shorten);
  EXPECT_GE(share_kept(x, p), 0.2);
  EXPECT_EQ(largest_step(base_on_floor(), x, p), 1);
  EXPECT_LE(p(1, 0), 0);  // its corners may stay, but go nowhere else
  EXPECT_LE(p(1, 2), 0);
}

TEST(StepFilter, whoever_stays_makes_the_face_stay) {
  const Positions x = over_floor();
  const OrientationPenalty orientation(x, one, {});
  Positions p = fall();
  filter_step(base_on_floor(), {orientation, first, 0.2}, x, p, OnCollision::stay);
  EXPECT_TRUE(p.isZero(0));
}

TEST(StepFilter, leaves_alone_what_is_free) {
  const Positions x = over_floor();
  const OrientationPenalty orientation(x, one, {});
  Positions p = 0.1 * fall();
  filter_step(base_on_floor(), {orientation, first, 0.2}, x, p, OnCollision::shorten);
  EXPECT_EQ(p, Positions(0.1 * fall()));
}

}  // namespace
}  // namespace unsnarl
