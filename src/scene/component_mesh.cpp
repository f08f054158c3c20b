#include "scene/component_mesh.h"

#include <algorithm>
#include <utility>

#include "geometry/sort_unique.h"

namespace unsnarl {

ComponentMesh ComponentMesh::at(const Positions& surface) const {
  return {triangles, surface(Eigen::all, vertices), vertices};
}

ComponentMesh component_mesh(const Positions& x, std::span<const Triangle> triangles) {
  std::vector<Index> vertices;
  for (const Triangle& t : triangles) vertices.insert(vertices.end(), t.begin(), t.end());
  sort_unique(vertices);
  std::vector<Triangle> own(triangles.begin(), triangles.end());
  for (Triangle& t : own)
    for (Index& v : t) v = static_cast<Index>(std::lower_bound(vertices.begin(), vertices.end(), v) - vertices.begin());
  Positions of_vertices = x(Eigen::all, vertices);
  return {std::move(own), std::move(of_vertices), std::move(vertices)};
}

std::vector<std::vector<Triangle>> triangles_by_component(std::span<const Triangle> triangles,
                                                          const Components& components) {
  std::vector<std::vector<Triangle>> lists(components.list.size());
  for (const Triangle& t : triangles) lists[components.component_of_vertex[t[0]]].push_back(t);
  return lists;
}

}  // namespace unsnarl
