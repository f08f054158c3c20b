#include "repair/embedding_guard.h"

#include <gtest/gtest.h>

#include "repair/shapes.h"

namespace unsnarl {
namespace {

/// A free vertex (0) amid a square, and a triangle hanging over it at height 1.
Patch tent() {
  shapes::Shape shape = shapes::square_fan();
  shape.add({{{-3, -3, 1}, {3, -3, 1}, {0, 3, 1}}, {{0, 1, 2}}});
  return shapes::patch_of(shape, 1, 4);
}

TEST(EmbeddingGuard, TakesBackWhatRunsIntoAnotherFace) {
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

TEST(EmbeddingGuard, TakesBackWhatTurnsAFaceOver) {
  const Patch patch = tent();
  EmbeddingGuard guard(patch);
  Positions x = patch.x;
  x.col(0) = Vec3(0, -1.5, 0.2);  // hangs over the first edge: nothing intersects
  EXPECT_TRUE(guard.new_pairs(x).empty());
  EXPECT_EQ(guard.turned_faces(x, patch.x), std::vector<Index>{0});
  EXPECT_EQ(guard.roll_back(x, patch.x), 1);
  EXPECT_EQ(x, patch.x);
}

TEST(EmbeddingGuard, WhatWasTurnedOverMayStay) {
  Patch patch = tent();
  patch.x.col(0) = Vec3(0, -1.5, 0.2);
  EmbeddingGuard guard(patch);
  Positions x = patch.x;
  x(0, 0) = 0.1;
  EXPECT_TRUE(guard.turned_faces(x, patch.x).empty());
  EXPECT_EQ(guard.roll_back(x, patch.x), 0);
}

}  // namespace
}  // namespace unsnarl
