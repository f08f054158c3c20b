#include "scene/scene_index.h"

namespace unsnarl {

SceneIndex::SceneIndex(const Scene& scene)
    : scene_(scene), own_(std::in_place, scene.triangles, scene.passing()), finder_(*own_) {
  update();
}

SceneIndex::SceneIndex(const Scene& scene, IntersectionFinder& finder) : scene_(scene), finder_(finder) {
  update();
}

void SceneIndex::mark_moved(std::span<const Index> vertices) {
  std::vector<Index> moved;
  for (Index v : vertices)
    moved.insert(moved.end(), scene_.triangles_of_vertex[v].begin(), scene_.triangles_of_vertex[v].end());
  finder_.move(scene_.x, moved);
}

}  // namespace unsnarl
