#include "mesh/adjacency.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace unsnarl {
namespace {

std::vector<Index> list(const IndexLists& lists, Index i) {
  return {lists[i].begin(), lists[i].end()};
}

TEST(Adjacency, two_triangles_share_one_edge) {
  const std::vector<Triangle> triangles = {{0, 1, 2}, {2, 1, 3}};
  const EdgeTable table = build_edges(triangles);
  EXPECT_EQ(table.edges, (std::vector<Edge>{{0, 1}, {0, 2}, {1, 2}, {1, 3}, {2, 3}}));
  EXPECT_EQ(table.edges_of_triangle[0], (std::array<Index, 3>{0, 2, 1}));
  EXPECT_EQ(table.edges_of_triangle[1], (std::array<Index, 3>{2, 3, 4}));
  ASSERT_EQ(table.triangles_of_edge.size(), 5);
  EXPECT_EQ(list(table.triangles_of_edge, 2), (std::vector<Index>{0, 1}));
  EXPECT_EQ(list(table.triangles_of_edge, 4), (std::vector<Index>{1}));
}

TEST(Adjacency, degenerate_triangle_contributes_its_real_edge_once) {
  const std::vector<Triangle> triangles = {{5, 2, 5}, {1, 1, 1}};
  const EdgeTable table = build_edges(triangles);
  EXPECT_EQ(table.edges, (std::vector<Edge>{{2, 5}}));
  EXPECT_EQ(table.edges_of_triangle[0], (std::array<Index, 3>{0, 0, -1}));
  EXPECT_EQ(table.edges_of_triangle[1], (std::array<Index, 3>{-1, -1, -1}));
  EXPECT_EQ(list(table.triangles_of_edge, 0), (std::vector<Index>{0}));
}

TEST(Adjacency, nothing_in) {
  const EdgeTable table = build_edges({});
  EXPECT_TRUE(table.edges.empty());
  EXPECT_EQ(table.triangles_of_edge.size(), 0);
  EXPECT_EQ(triangles_of_vertices({}, 3).size(), 3);
  EXPECT_TRUE(triangles_of_vertices({}, 3)[2].empty());
}

TEST(Adjacency, triangles_of_vertices_ascend_and_count_a_triangle_once) {
  const std::vector<Triangle> triangles = {{0, 1, 2}, {2, 1, 3}, {2, 2, 4}};
  const IndexLists lists = triangles_of_vertices(triangles, 6);
  ASSERT_EQ(lists.size(), 6);
  EXPECT_EQ(list(lists, 2), (std::vector<Index>{0, 1, 2}));
  EXPECT_EQ(list(lists, 1), (std::vector<Index>{0, 1}));
  EXPECT_TRUE(list(lists, 5).empty());
}

TEST(Adjacency, neighbours_ascend) {
  const std::vector<Edge> edges = {{0, 3}, {0, 1}, {1, 3}};
  const IndexLists lists = vertex_neighbours(edges, 4);
  EXPECT_EQ(list(lists, 0), (std::vector<Index>{1, 3}));
  EXPECT_EQ(list(lists, 3), (std::vector<Index>{0, 1}));
  EXPECT_TRUE(list(lists, 2).empty());
}

TEST(Adjacency, closed_grid_has_the_edges_of_a_torus) {
  const Index n = 40;
  std::vector<Triangle> triangles;
  const auto at = [n](Index i, Index j) { return (i % n) * n + j % n; };
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j) {
      triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  const EdgeTable table = build_edges(triangles);
  EXPECT_EQ(table.edges.size(), 3u * n * n);
  EXPECT_TRUE(std::is_sorted(table.edges.begin(), table.edges.end()));
  for (Index e = 0; e < table.triangles_of_edge.size(); ++e) EXPECT_EQ(table.triangles_of_edge[e].size(), 2u);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      Edge edge = {triangles[t][k], triangles[t][(k + 1) % 3]};
      std::sort(edge.begin(), edge.end());
      EXPECT_EQ(table.edges[table.edges_of_triangle[t][k]], edge);
    }
}

}  // namespace
}  // namespace unsnarl
