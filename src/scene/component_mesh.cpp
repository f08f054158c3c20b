#include "scene/component_mesh.h"

#include <algorithm>
#include <utility>

#include "geometry/sort_unique.h"

namespace unsnarl {

ComponentMesh component_mesh(const Positions& x, std::span<const Triangle> triangles) {
  std::vector<Index> vertices;
  for (const Triangle& t : triangles) vertices.insert(vertices.end(), t.begin(), t.end());
  sort_unique(vertices);
  std::vector<Triangle> own(triangles.begin(), triangles.end());
  for (Triangle& t : own)
    for (Index& v : t) v = static_cast<Index>(std::lower_bound(vertices.begin(), vertices.end(), v) - vertices.begin());
  Positions of_vertices(3, static_cast<Index>(vertices.size()));
  for (std::size_t i = 0; i < vertices.size(); ++i) of_vertices.col(static_cast<Index>(i)) = x.col(vertices[i]);
  return {std::move(own), std::move(of_vertices)};
}

std::vector<std::vector<Triangle>> triangles_by_component(std::span<const Triangle> triangles,
                                                          const Components& components) {
  std::vector<std::vector<Triangle>> lists(components.list.size());
  for (const Triangle& t : triangles) lists[components.component_of_vertex[t[0]]].push_back(t);
  return lists;
}

}  // namespace unsnarl
