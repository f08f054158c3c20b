#include "mesh/adjacency.h"

#include <algorithm>

namespace unsnarl {
namespace {

/// Turns counts stored at [i + 1] into offsets.
void accumulate(std::vector<Index>& offsets) {
  for (std::size_t i = 1; i < offsets.size(); ++i) offsets[i] += offsets[i - 1];
}

/// An edge as seen from the corner of a triangle; its smaller vertex is the bucket it lies in.
struct HalfEdge {
  Index larger;
  Index corner;  // 3 * triangle + k
};

}  // namespace

IndexLists triangles_of_vertices(std::span<const Triangle> triangles, Index vertex_count) {
  const auto is_repeated = [](const Triangle& t, int k) { return (k > 0 && t[k] == t[0]) || (k > 1 && t[k] == t[1]); };
  IndexLists lists;
  lists.offsets.assign(static_cast<std::size_t>(vertex_count) + 1, 0);
  for (const Triangle& t : triangles)
    for (int k = 0; k < 3; ++k)
      if (!is_repeated(t, k)) ++lists.offsets[t[k] + 1];
  accumulate(lists.offsets);
  lists.items.resize(lists.offsets.back());
  std::vector<Index> next(lists.offsets.begin(), lists.offsets.end() - 1);
  for (std::size_t i = 0; i < triangles.size(); ++i)
    for (int k = 0; k < 3; ++k)
      if (!is_repeated(triangles[i], k)) lists.items[next[triangles[i][k]]++] = static_cast<Index>(i);
  return lists;
}

EdgeTable build_edges(std::span<const Triangle> triangles) {
  EdgeTable table;
  table.edges_of_triangle.assign(triangles.size(), {-1, -1, -1});
  Index vertex_count = 0;
  for (const Triangle& t : triangles) vertex_count = std::max({vertex_count, t[0] + 1, t[1] + 1, t[2] + 1});

  // Counting sort by the smaller vertex, then a small sort of each bucket: O(corners) for surfaces.
  std::vector<Index> begin(static_cast<std::size_t>(vertex_count) + 1, 0);
  for (const Triangle& t : triangles)
    for (int k = 0; k < 3; ++k)
      if (t[k] != t[(k + 1) % 3]) ++begin[std::min(t[k], t[(k + 1) % 3]) + 1];
  accumulate(begin);
  std::vector<HalfEdge> half_edges(begin.back());
  {
    std::vector<Index> next(begin.begin(), begin.end() - 1);
    for (std::size_t i = 0; i < triangles.size(); ++i)
      for (int k = 0; k < 3; ++k) {
        const Index a = triangles[i][k], b = triangles[i][(k + 1) % 3];
        if (a != b) half_edges[next[std::min(a, b)]++] = {std::max(a, b), static_cast<Index>(3 * i + k)};
      }
  }

  table.edges.reserve(half_edges.size() / 2 + 16);
  table.triangles_of_edge.offsets.reserve(half_edges.size() / 2 + 17);
  table.triangles_of_edge.items.reserve(half_edges.size());
  for (Index v = 0; v < vertex_count; ++v) {
    const auto first = half_edges.begin() + begin[v], last = half_edges.begin() + begin[v + 1];
    std::sort(first, last, [](const HalfEdge& a, const HalfEdge& b) {
      return a.larger != b.larger ? a.larger < b.larger : a.corner < b.corner;
    });
    std::vector<Index>& items = table.triangles_of_edge.items;
    for (auto it = first; it != last; ++it) {
      const bool is_new = it == first || it->larger != (it - 1)->larger;
      if (is_new) {
        if (!table.edges.empty()) table.triangles_of_edge.offsets.push_back(static_cast<Index>(items.size()));
        table.edges.push_back({v, it->larger});
      }
      const Index triangle = it->corner / 3;
      table.edges_of_triangle[triangle][it->corner % 3] = static_cast<Index>(table.edges.size()) - 1;
      if (is_new || items.back() != triangle) items.push_back(triangle);
    }
  }
  if (!table.edges.empty())
    table.triangles_of_edge.offsets.push_back(static_cast<Index>(table.triangles_of_edge.items.size()));
  return table;
}

IndexLists vertex_neighbours(std::span<const Edge> edges, Index vertex_count) {
  IndexLists lists;
  lists.offsets.assign(static_cast<std::size_t>(vertex_count) + 1, 0);
  for (const Edge& e : edges) {
    ++lists.offsets[e[0] + 1];
    ++lists.offsets[e[1] + 1];
  }
  accumulate(lists.offsets);
  lists.items.resize(lists.offsets.back());
  std::vector<Index> next(lists.offsets.begin(), lists.offsets.end() - 1);
  for (const Edge& e : edges) {
    lists.items[next[e[0]]++] = e[1];
    lists.items[next[e[1]]++] = e[0];
  }
  for (Index v = 0; v < vertex_count; ++v)
    std::sort(lists.items.begin() + lists.offsets[v], lists.items.begin() + lists.offsets[v + 1]);
  return lists;
}

}  // namespace unsnarl
