#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "geometry/types.h"

namespace unsnarl {

inline bool has_corner(const Triangle& t, Index v) {
  return t[0] == v || t[1] == v || t[2] == v;
}
inline bool share_a_vertex(const Triangle& a, const Triangle& b) {
  return std::any_of(a.begin(), a.end(), [&](Index v) { return has_corner(b, v); });
}

/// Lists of indices, one list an element, stored end to end.
struct IndexLists {
  std::vector<Index> offsets = {0};  ///< one more than there are lists
  std::vector<Index> items;

  Index size() const { return static_cast<Index>(offsets.size()) - 1; }
  std::span<const Index> operator[](Index i) const {
    return {items.data() + offsets[i], static_cast<std::size_t>(offsets[i + 1] - offsets[i])};
  }
};

/// Triangles at each vertex, ascending.
IndexLists triangles_of_vertices(std::span<const Triangle> triangles, Index vertex_count);

/// The undirected edges of a set of triangles (degenerate ones, with a repeated vertex, contribute their real edges).
struct EdgeTable {
  std::vector<Edge> edges;                              ///< sorted
  std::vector<std::array<Index, 3>> edges_of_triangle;  ///< edge k joins corners k and k + 1; -1 where they are equal
  IndexLists triangles_of_edge;                         ///< ascending
};
EdgeTable build_edges(std::span<const Triangle> triangles);

/// Vertices joined to each vertex by an edge, ascending.
IndexLists vertex_neighbours(std::span<const Edge> edges, Index vertex_count);

}  // namespace unsnarl
