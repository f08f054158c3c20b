#include "scene/topology.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "geometry/predicates.h"

namespace unsnarl {

Topology describe_topology(const SurfaceView& surface, const WeldMap& weld_map, const Triangulation& triangulation,
                           const EdgeTable& edges, const Components& components) {
  Topology topology;
  const std::vector<Triangle>& triangles = triangulation.triangles;
  topology.vertices = static_cast<std::size_t>(weld_map.count);
  topology.faces = surface.face_count();
  topology.triangles = triangles.size();
  topology.components = components.list.size();
  for (const Component& component : components.list) {
    topology.boundary_edges += static_cast<std::size_t>(component.boundary_edges);
    topology.non_manifold_edges += static_cast<std::size_t>(component.non_manifold_edges);
    topology.closed_components += component.closed();
    topology.non_orientable_components += !component.orientable;
  }
  topology.non_manifold_vertices = count_non_manifold_vertices(triangles, weld_map.count, edges);
  for (const auto& group : duplicate_triangles(triangles)) topology.duplicate_faces += group.size() - 1;
  topology.duplicate_vertices = weld_map.merged;

  std::vector<std::uint8_t> used(static_cast<std::size_t>(weld_map.count), 0), has_area(topology.faces, 0);
  for (Index v : surface.corners) used[weld_map.vertex_of[v]] = 1;
  topology.unused_vertices = static_cast<std::size_t>(std::count(used.begin(), used.end(), 0));
  const auto position = [&](Index v) {
    const double* p = &surface.positions[3 * static_cast<std::size_t>(weld_map.first[v])];
    return Vec3(p[0], p[1], p[2]);
  };
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    std::uint8_t& seen = has_area[triangulation.polygon[i]];
    if (!seen) seen = !collinear(position(triangles[i][0]), position(triangles[i][1]), position(triangles[i][2]));
  }
  topology.zero_area_faces = static_cast<std::size_t>(std::count(has_area.begin(), has_area.end(), 0));
  return topology;
}

}  // namespace unsnarl
