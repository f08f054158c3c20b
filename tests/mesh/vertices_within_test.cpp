#include "mesh/vertices_within.h"

#include <gtest/gtest.h>

namespace unsnarl {
namespace {

TEST(VerticesWithin, follows_edges_and_not_the_straight_way) {
  // A strip of four points 1 apart along three edges, the last above the first.
  Positions x(3, 4);
  x.col(0) = Vec3(0, 0, 0);
  x.col(1) = Vec3(1, 0, 0);
  x.col(2) = Vec3(1, 1, 0);
  x.col(3) = Vec3(0, 1, 0);
  EdgeTable edges;
  edges.edges = {{0, 1}, {1, 2}, {2, 3}};
  const auto of = [&](Index v, double length) {
    const IndexLists lists = vertices_within(x, edges, length);
    return std::vector<Index>(lists[v].begin(), lists[v].end());
  };
  EXPECT_EQ(of(0, 0.9), std::vector<Index>{});
  EXPECT_EQ(of(0, 2), (std::vector<Index>{1, 2}));
  EXPECT_EQ(of(2, 1), (std::vector<Index>{1, 3}));
  EXPECT_EQ(of(3, 3), (std::vector<Index>{0, 1, 2}));
}

}  // namespace
}  // namespace unsnarl
