#include "scene/scene.h"

#include <utility>

namespace unsnarl {

Scene make_scene(Positions rest, std::vector<Triangle> triangles, std::vector<std::uint8_t> fixed) {
  const EdgeTable edges = build_edges(triangles);
  return make_scene(std::move(rest), std::move(triangles), std::move(fixed), edges.edges);
}

Scene make_scene(Positions rest, std::vector<Triangle> triangles, std::vector<std::uint8_t> fixed,
                 std::span<const Edge> edges) {
  Scene scene;
  scene.rest = std::move(rest);
  scene.x = scene.rest;
  scene.triangles = std::move(triangles);
  scene.fixed = std::move(fixed);
  scene.fixed.resize(scene.rest.cols(), 0);
  scene.triangles_of_vertex = triangles_of_vertices(scene.triangles, scene.vertex_count());
  scene.neighbours = vertex_neighbours(edges, scene.vertex_count());
  return scene;
}

}  // namespace unsnarl
