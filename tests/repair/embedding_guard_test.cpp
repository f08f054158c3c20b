#include "repair/embedding_guard.h"

#include <gtest/gtest.h>

namespace unsnarl {
namespace {

/// A free vertex (0) amid a square, and a triangle hanging over it at height 1.
Patch tent() {
  Patch patch;
  patch.free_count = 1;
  patch.active_count = 4;
  patch.rest.resize(3, 8);
  patch.rest << 0, -1, 1, 1, -1, -3, 3, 0,  //
      0, -1, -1, 1, 1, -3, -3, 3,           //
      0, 0, 0, 0, 0, 1, 1, 1;
  patch.x = patch.rest;
  patch.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}, {5, 6, 7}};
  patch.edge_length = 1;
  return patch;
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
