#include "untangle/local/flip_guard.h"

#include <gtest/gtest.h>

#include "mesh/areas.h"
#include "scene/shapes.h"

namespace unsnarl {
namespace {

/// The middle of a square is free.
Patch fan() {
  return shapes::patch_of(shapes::square_fan(), 1, 4);
}

int turned(const Patch& patch, const Positions& x) {
  int count = 0;
  for (const Triangle& t : patch.triangles) count += area_vector(patch.rest, t).dot(area_vector(x, t)) <= 0;
  return count;
}

TEST(FlipGuard, pushes_a_face_back_over_its_edge) {
  const Patch patch = fan();
  const FlipGuard guard(patch, std::vector<std::uint8_t>(4, 0));
  Positions x = patch.x;
  x.col(0) = Vec3(0.2, -1.5, 0.1);
  ASSERT_EQ(turned(patch, x), 1);
  EXPECT_TRUE(guard.project(x));
  EXPECT_EQ(turned(patch, x), 0);
  EXPECT_NEAR(x(1, 0), -0.9, 1e-12);  // just as far as the share of its area asks for
  EXPECT_EQ(x(2, 0), 0.1);
  EXPECT_EQ(x.rightCols(4), patch.x.rightCols(4));
}

TEST(FlipGuard, leaves_alone_what_may_turn_and_what_has_room) {
  const Patch patch = fan();
  Positions x = patch.x;
  x.col(0) = Vec3(0.2, -1.5, 0.1);
  const Positions before = x;
  EXPECT_FALSE(FlipGuard(patch, std::vector<std::uint8_t>{1, 0, 0, 0}).project(x));
  EXPECT_EQ(x, before);
  x.col(0) = Vec3(0.2, -0.5, 0.4);
  const Positions inside = x;
  EXPECT_FALSE(FlipGuard(patch, std::vector<std::uint8_t>(4, 0)).project(x));
  EXPECT_EQ(x, inside);
}

TEST(FlipGuard, does_not_ask_of_a_face_what_it_did_not_have_at_the_start) {
  Patch patch = fan();
  patch.x.col(0) = Vec3(0, -1.2, 0);  // turned over when it is given
  Positions x = patch.x;
  EXPECT_FALSE(FlipGuard(patch, std::vector<std::uint8_t>(4, 0)).project(x));
  EXPECT_EQ(x, patch.x);
}

}  // namespace
}  // namespace unsnarl
