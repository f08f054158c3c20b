#include "recover/embedding_guard.h"

#include <gtest/gtest.h>

#include "scene/shapes.h"

namespace unsnarl {
namespace {

/// A free vertex (0) amid a square, and a triangle hanging over it at height 1.
Patch tent() {
  shapes::Shape shape = shapes::square_fan();
  shape.add({{{-3, -3, 1}, {3, -3, 1}, {0, 3, 1}}, {{0, 1, 2}}});
  return shapes::patch_of(shape, 1, 4);
}

TEST(EmbeddingGuard, takes_back_what_runs_into_another_face) {
  const Patch patch = tent();
  EmbeddingGuard guard(patch);
  EXPECT_EQ(guard.pairs_at_start(), 0u);
  Positions x = patch.x;
  x(2, 0) = 0.9;
  EXPECT_EQ(guard.roll_back(x, patch.x), 0);
  EXPECT_EQ(x(2, 0), 0.9);
  x(2, 0) = 1;  // touches
  EXPECT_FALSE(guard.new_pairs(x).empty());
  EXPECT_EQ(guard.roll_back(x, patch.x), 1);
  EXPECT_EQ(x, patch.x);
}

}  // namespace
}  // namespace unsnarl
