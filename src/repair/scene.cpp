#include "repair/scene.h"

#include <utility>

namespace unsnarl {

Scene make_scene(Positions rest, std::vector<Triangle> triangles, std::vector<std::uint8_t> fixed) {
  Scene scene;
  scene.rest = std::move(rest);
  scene.x = scene.rest;
  scene.triangles = std::move(triangles);
  scene.fixed = std::move(fixed);
  scene.fixed.resize(scene.rest.cols(), 0);
  scene.triangles_of_vertex = triangles_of_vertices(scene.triangles, scene.vertex_count());
  scene.neighbours = vertex_neighbours(build_edges(scene.triangles).edges, scene.vertex_count());
  return scene;
}

}  // namespace unsnarl
