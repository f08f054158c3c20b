#include "mesh/components.h"

#include <algorithm>
#include <utility>

#include "geometry/predicates.h"
#include "mesh/union_find.h"

namespace unsnarl {
namespace {

/// True where triangle t runs along the edge from its smaller to its larger vertex.
bool runs_forward(const Triangle& t, const Edge& e) {
  for (int k = 0; k < 3; ++k)
    if (t[k] == e[0] && t[(k + 1) % 3] == e[1]) return true;
  return false;
}

/// Colours the triangles so that neighbours across an edge of two triangles agree in orientation, and marks the
/// components where that fails.
void find_orientability(std::span<const Triangle> triangles, const EdgeTable& edges, Components& components) {
  std::vector<std::int8_t> turned(triangles.size(), -1);
  std::vector<Index> stack;
  for (std::size_t seed = 0; seed < triangles.size(); ++seed) {
    if (turned[seed] >= 0) continue;
    turned[seed] = 0;
    stack.push_back(static_cast<Index>(seed));
    while (!stack.empty()) {
      const Index t = stack.back();
      stack.pop_back();
      for (Index e : edges.edges_of_triangle[t]) {
        if (e < 0 || edges.triangles_of_edge[e].size() != 2) continue;
        const Index other = edges.triangles_of_edge[e][edges.triangles_of_edge[e][0] == t ? 1 : 0];
        const bool clash = runs_forward(triangles[t], edges.edges[e]) == runs_forward(triangles[other], edges.edges[e]);
        Component& component = components.list[components.component_of_triangle[t]];
        component.is_oriented &= !clash;
        const auto wanted = static_cast<std::int8_t>(clash ? 1 - turned[t] : turned[t]);
        if (turned[other] < 0) {
          turned[other] = wanted;
          stack.push_back(other);
        } else if (turned[other] != wanted) {
          component.orientable = false;
        }
      }
    }
  }
}

/// Numbers the sets of vertices that faces join, in the order of the first faces.
Components join_corners(const SurfaceView& surface, const WeldMap& weld_map) {
  UnionFind sets(static_cast<std::size_t>(weld_map.count));
  for (std::size_t f = 0; f < surface.face_count(); ++f)
    for (const Index corner : surface.face(f))
      sets.unite(weld_map.vertex_of[surface.face(f)[0]], weld_map.vertex_of[corner]);
  Components result;
  result.component_of_vertex.assign(sets.size(), -1);
  for (const Index corner : surface.corners) {
    const Index v = weld_map.vertex_of[corner];
    Index& of_set = result.component_of_vertex[sets.find(v)];
    if (of_set < 0) {
      of_set = result.count();
      result.list.emplace_back();
    }
    result.component_of_vertex[v] = of_set;
  }
  return result;
}

void describe_triangles(std::span<const Triangle> triangles, const EdgeTable& edges, Components& result) {
  std::vector<std::uint8_t> is_counted(result.component_of_vertex.size(), 0);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const Index number = result.component_of_vertex[triangles[i][0]];
    Component& component = result.list[number];
    if (component.triangles++ == 0) component.first_triangle = static_cast<Index>(i);
    result.component_of_triangle.push_back(number);
    for (const Index v : triangles[i]) component.vertices += std::exchange(is_counted[v], 1) == 0;
  }
  for (std::size_t e = 0; e < edges.edges.size(); ++e) {
    Component& component = result.list[result.component_of_vertex[edges.edges[e][0]]];
    const std::size_t uses = edges.triangles_of_edge[static_cast<Index>(e)].size();
    ++component.edges;
    component.boundary_edges += uses == 1;
    component.non_manifold_edges += uses > 2;
  }
  find_orientability(triangles, edges, result);
}

}  // namespace

Components find_components(const SurfaceView& surface, const WeldMap& weld_map, std::span<const Triangle> triangles,
                           const EdgeTable& edges) {
  Components result = join_corners(surface, weld_map);
  describe_triangles(triangles, edges, result);
  return result;
}

Index component_of_face(const SurfaceView& surface, const WeldMap& weld_map, const Components& components, Index face) {
  const auto corners = surface.face(static_cast<std::size_t>(face));
  return corners.empty() ? -1 : components.component_of_vertex[weld_map.vertex_of[corners[0]]];
}

std::size_t count_non_manifold_vertices(std::span<const Triangle> triangles, Index vertex_count,
                                        const EdgeTable& edges) {
  // Fans are sets of corners, corner k of triangle i being 3 i + k.
  UnionFind fans(3 * triangles.size());
  const auto corner = [&](Index t, Index v) {
    const Triangle& triangle = triangles[t];
    return 3 * t + (triangle[0] == v ? 0 : triangle[1] == v ? 1 : 2);
  };
  for (std::size_t e = 0; e < edges.edges.size(); ++e) {
    const auto around = edges.triangles_of_edge[static_cast<Index>(e)];
    for (std::size_t i = 1; i < around.size(); ++i)
      for (Index v : edges.edges[e]) fans.unite(corner(around[0], v), corner(around[i], v));
  }
  std::vector<Index> fan_of_vertex(static_cast<std::size_t>(vertex_count), -1);
  std::vector<std::uint8_t> several(static_cast<std::size_t>(vertex_count), 0);
  for (std::size_t i = 0; i < triangles.size(); ++i)
    for (Index v : triangles[i]) {
      const Index fan = fans.find(corner(static_cast<Index>(i), v));
      if (fan_of_vertex[v] < 0) fan_of_vertex[v] = fan;
      if (fan_of_vertex[v] != fan) several[v] = 1;
    }
  return static_cast<std::size_t>(std::count(several.begin(), several.end(), 1));
}

std::vector<std::vector<Index>> duplicate_triangles(std::span<const Triangle> triangles) {
  struct Entry {  // in the bucket of the smallest vertex
    Index middle, largest, triangle;
    auto operator<=>(const Entry&) const = default;
  };
  const auto sorted = [](Triangle t) {
    std::sort(t.begin(), t.end());
    return t;
  };
  Index vertex_count = 0;
  for (const Triangle& t : triangles) vertex_count = std::max({vertex_count, t[0] + 1, t[1] + 1, t[2] + 1});
  std::vector<Index> begin(static_cast<std::size_t>(vertex_count) + 2, 0);
  for (const Triangle& t : triangles) ++begin[std::min({t[0], t[1], t[2]}) + 2];
  for (std::size_t v = 2; v < begin.size(); ++v) begin[v] += begin[v - 1];
  std::vector<Entry> entries(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const Triangle t = sorted(triangles[i]);
    entries[begin[t[0] + 1]++] = {t[1], t[2], static_cast<Index>(i)};
  }
  std::vector<std::vector<Index>> groups;
  for (Index v = 0; v < vertex_count; ++v) {
    const auto first = entries.begin() + begin[v], last = entries.begin() + begin[v + 1];
    std::sort(first, last);
    for (auto it = first; it != last;) {
      auto end = it + 1;
      while (end != last && end->middle == it->middle && end->largest == it->largest) ++end;
      if (end - it > 1) {
        groups.emplace_back();
        for (; it != end; ++it) groups.back().push_back(it->triangle);
      }
      it = end;
    }
  }
  std::sort(groups.begin(), groups.end());
  return groups;
}

}  // namespace unsnarl
