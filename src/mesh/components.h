#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "geometry/types.h"
#include "mesh/adjacency.h"
#include "mesh/weld_map.h"
#include "unsnarl/surface.h"

namespace unsnarl {

/// A set of faces connected through shared vertices.
struct Component {
  Index first_triangle = -1;  ///< -1: all its faces are without triangles
  Index triangles = 0;
  Index vertices = 0;  ///< of these triangles
  Index edges = 0;
  Index boundary_edges = 0;      ///< edges of one triangle
  Index non_manifold_edges = 0;  ///< edges of three or more
  bool orientable = true;        ///< its triangles can be turned so that all edges of two triangles run both ways

  bool is_oriented = true;  ///< they run both ways already

  Index euler_characteristic() const { return vertices - edges + triangles; }
  /// Every edge has exactly two triangles.
  bool closed() const { return edges > 0 && boundary_edges == 0 && non_manifold_edges == 0; }
  /// Such a surface has no embedding in space: no motion of its vertices can resolve it.
  bool obstructed() const { return closed() && !orientable; }
};

/// Closed, with triangles that agree on what is inside.
inline bool has_volume(const Component& component) {
  return component.closed() && component.is_oriented;
}

struct Components {
  std::vector<Component> list;  ///< in the order of their first faces
  std::vector<Index> component_of_triangle;
  std::vector<Index> component_of_vertex;  ///< -1: unused vertex
  Index count() const { return static_cast<Index>(list.size()); }
};

/// Finds the components of the surface that these triangles are cut from; `edges` is build_edges(triangles). Every
/// corner of a face has one, also a corner that is in no triangle, as a polygon's may be that uses a vertex twice.
Components find_components(const SurfaceView& surface, const WeldMap& weld_map, std::span<const Triangle> triangles,
                           const EdgeTable& edges);

/// The component of a face of the surface; -1 for one without corners.
Index component_of_face(const SurfaceView& surface, const WeldMap& weld_map, const Components& components, Index face);

/// Number of vertices at which the triangles around the vertex are not connected through edges at it (bow ties).
std::size_t count_non_manifold_vertices(std::span<const Triangle> triangles, Index vertex_count,
                                        const EdgeTable& edges);

/// Groups of two or more triangles on the same three vertices, in any order of the vertices; triangles ascending within
/// a group, groups in the order of their first triangles.
std::vector<std::vector<Index>> duplicate_triangles(std::span<const Triangle> triangles);

}  // namespace unsnarl
