#include "recover/unflip_faces.h"

#include <gtest/gtest.h>

#include <vector>

namespace unsnarl {
namespace {

/// A flat grid of n x n vertices, its border fixed.
Patch grid(int n) {
  Patch patch;
  std::vector<Index> slot(static_cast<std::size_t>(n * n));
  Index next = 0;
  for (const bool border : {false, true}) {
    for (int k = 0; k < n * n; ++k) {
      const int i = k / n, j = k % n;
      if ((i == 0 || j == 0 || i == n - 1 || j == n - 1) == border) slot[k] = next++;
    }
    if (!border) patch.free_count = next;
  }
  patch.rest.resize(3, n * n);
  for (int k = 0; k < n * n; ++k) patch.rest.col(slot[k]) = Vec3(k / n, k % n, 0);
  for (int i = 0; i + 1 < n; ++i) {
    for (int j = 0; j + 1 < n; ++j) {
      const auto at = [&](int a, int b) { return slot[a * n + b]; };
      patch.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      patch.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  patch.active_count = static_cast<Index>(patch.triangles.size());  // those without a free vertex do no harm
  patch.x = patch.rest;
  patch.edge_length = 1;
  return patch;
}

Index unflip(Patch& patch, int max_rings) {
  const IndexLists neighbours =
      vertex_neighbours(build_edges(patch.triangles).edges, static_cast<Index>(patch.x.cols()));
  const OrientationPenalty orientation(patch.rest, patch.triangles, {});
  EmbeddingGuard guard(patch);
  return unflip_faces(patch, neighbours, orientation, guard, max_rings);
}

std::size_t flipped(const Patch& patch) {
  return flipped_faces(patch, OrientationPenalty(patch.rest, patch.triangles, {})).size();
}

TEST(UnflipFaces, AVertexDraggedOverItsNeighboursGoesBack) {
  Patch patch = grid(7);
  patch.x.col(12) += Vec3(1.6, 0.3, 0.4);  // the middle, over the next faces
  ASSERT_GT(flipped(patch), 0u);
  const Index before = static_cast<Index>(flipped(patch));
  EXPECT_EQ(unflip(patch, 3), before);
  EXPECT_EQ(flipped(patch), 0u);
}

TEST(UnflipFaces, NothingThatWouldIntersectIsKept) {
  // The place where the faces would be unflipped is taken by an obstacle.
  Patch patch = grid(7);
  patch.x.col(12) += Vec3(1.6, 0.3, 0.4);
  const Index n = static_cast<Index>(patch.x.cols());
  for (Positions* x : {&patch.x, &patch.rest}) {
    x->conservativeResize(3, n + 3);
    x->rightCols(3) << Vec3(2.8, 2.9, 0.05), Vec3(2.9, 3.1, 0.05), Vec3(2.85, 3, -0.3);
  }
  patch.triangles.push_back({n, n + 1, n + 2});
  const Positions start = patch.x;
  const std::size_t before = flipped(patch);
  ASSERT_GT(before, 0u);
  IntersectionFinder finder(patch.triangles, patch.active_count);
  ASSERT_TRUE(finder.find(patch.x).empty());
  unflip(patch, 3);
  EXPECT_TRUE(finder.find(patch.x).empty());
}

TEST(UnflipFaces, LeavesAloneWhatIsNotFlipped) {
  Patch patch = grid(5);
  patch.x.col(4) += Vec3(0.2, 0.1, 0.3);
  const Positions start = patch.x;
  EXPECT_EQ(unflip(patch, 3), 0);
  EXPECT_EQ(patch.x, start);
}

}  // namespace
}  // namespace unsnarl
