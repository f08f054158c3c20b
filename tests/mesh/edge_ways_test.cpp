#include "mesh/edge_ways.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace unsnarl {
namespace {

/// The corners of a square of side 1, joined by these edges; and a point without an edge.
struct Square {
  Positions x{3, 5};
  IndexLists neighbours;

  explicit Square(const std::vector<Edge>& edges) : neighbours(vertex_neighbours(edges, 5)) {
    x.col(0) = Vec3(0, 0, 0);
    x.col(1) = Vec3(1, 0, 0);
    x.col(2) = Vec3(1, 1, 0);
    x.col(3) = Vec3(0, 1, 0);
    x.col(4) = Vec3(0, 0.5, 0);
  }
};

TEST(EdgeWays, are_as_long_as_the_edges_they_follow) {
  const Square row({{0, 1}, {1, 2}, {2, 3}});
  EdgeWays ways(row.x, row.neighbours);
  ways.start(std::array<Index, 1>{0});
  EXPECT_EQ(ways.within(0), (std::vector<Index>{0}));
  EXPECT_EQ(ways.within(2.99), (std::vector<Index>{0, 1, 2}));
  EXPECT_EQ(ways.within(3), (std::vector<Index>{0, 1, 2, 3}));
}

TEST(EdgeWays, may_be_asked_for_less_and_begin_anew) {
  const Square row({{0, 1}, {1, 2}, {2, 3}});
  EdgeWays ways(row.x, row.neighbours);
  ways.start(std::array<Index, 1>{0});
  EXPECT_EQ(ways.within(10), (std::vector<Index>{0, 1, 2, 3}));
  EXPECT_EQ(ways.within(1), (std::vector<Index>{0, 1}));
  ways.start(std::array<Index, 2>{3, 4});
  EXPECT_EQ(ways.within(1), (std::vector<Index>{2, 3, 4}));
}

TEST(EdgeWays, take_the_shorter_of_two) {
  const Square ring({{0, 1}, {0, 3}, {1, 2}, {2, 3}});
  EdgeWays ways(ring.x, ring.neighbours);
  ways.start(std::array<Index, 1>{0});
  EXPECT_EQ(ways.within(1), (std::vector<Index>{0, 1, 3}));
}

}  // namespace
}  // namespace unsnarl
