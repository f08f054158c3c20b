#include "scene/patch.h"

#include <algorithm>
#include <functional>

#include "contact/bvh.h"
#include "geometry/sort_unique.h"
#include "mesh/areas.h"

namespace unsnarl {

namespace {

/// Triangles of the scene that some of these do not pass through.
class Obstacles {
 public:
  Obstacles(const Scene& scene, std::span<const Index> triangles) : scene_(scene) {
    // One triangle of each part stands for all of it.
    std::vector<Index> parts;
    for (const Index t : triangles) {
      const Index part = scene.part_of.empty() ? 0 : scene.part_of[t];
      if (std::find(parts.begin(), parts.end(), part) != parts.end()) continue;
      parts.push_back(part);
      of_each_part_.push_back(t);
    }
  }
  bool has(Index u) const {
    return std::any_of(of_each_part_.begin(), of_each_part_.end(),
                       [&](Index t) { return scene_.passing().meet(scene_.triangles, t, u); });
  }

 private:
  const Scene& scene_;
  std::vector<Index> of_each_part_;
};

}  // namespace

std::vector<std::vector<Triangle>> triangles_of_solids(const Patch& patch) {
  std::vector<std::vector<Triangle>> triangles(patch.solids.list.size());
  for (std::size_t t = 0; t < patch.solids.of_triangle.size(); ++t)
    if (const Index solid = patch.solids.of_triangle[t]; solid >= 0) triangles[solid].push_back(patch.triangles[t]);
  return triangles;
}

bool turns_a_solid_inside_out(const Patch& patch) {
  const std::vector<std::vector<Triangle>> triangles = triangles_of_solids(patch);
  for (std::size_t s = 0; s < triangles.size(); ++s) {
    const Vec3 near = patch.rest.col(triangles[s].front()[0]);
    const double at_rest = patch.solids.list[s].volume;
    const double gained = volume_over(patch.x, triangles[s], near) - volume_over(patch.rest, triangles[s], near);
    if ((at_rest + gained) * at_rest < 0) return true;
  }
  return false;
}

Patch cut_patch(const Scene& scene, const SceneIndex& index, std::span<const Index> free_vertices, double reach) {
  Patch patch;
  patch.free_count = static_cast<Index>(free_vertices.size());
  for (Index v : free_vertices)
    patch.faces.insert(patch.faces.end(), scene.triangles_of_vertex[v].begin(), scene.triangles_of_vertex[v].end());
  sort_unique(patch.faces);
  patch.active_count = static_cast<Index>(patch.faces.size());

  // One query for all triangles, then a test against each: separate queries would find the same obstacles again.
  std::vector<Box> boxes;
  Box all;
  for (Index t : patch.faces) {
    Box box = box_of(scene.x, scene.triangles[t]);
    box.extend(box_of(scene.rest, scene.triangles[t]));
    boxes.push_back(box.inflated(reach));
    all.extend(boxes.back());
  }
  const Bvh active(boxes);
  std::vector<Index> near, obstacles;
  index.query(all, near);
  const Obstacles possible(scene, patch.faces);
  const auto is_obstacle = [&](Index t) {
    return possible.has(t) && active.overlaps_any(box_of(scene.x, scene.triangles[t]));
  };
  std::erase_if(near, std::not_fn(is_obstacle));
  std::sort(near.begin(), near.end());
  std::set_difference(near.begin(), near.end(), patch.faces.begin(), patch.faces.end(), std::back_inserter(obstacles));
  patch.faces.insert(patch.faces.end(), obstacles.begin(), obstacles.end());

  std::vector<Index> fixed;
  for (Index t : patch.faces)
    for (Index v : scene.triangles[t]) fixed.push_back(v);
  sort_unique(fixed);
  patch.vertices.assign(free_vertices.begin(), free_vertices.end());
  std::set_difference(fixed.begin(), fixed.end(), free_vertices.begin(), free_vertices.end(),
                      std::back_inserter(patch.vertices));

  const auto first_fixed = patch.vertices.begin() + patch.free_count;
  auto local = [&](Index v) {
    auto it = std::lower_bound(patch.vertices.begin(), first_fixed, v);
    if (it == first_fixed || *it != v) it = std::lower_bound(first_fixed, patch.vertices.end(), v);
    return static_cast<Index>(it - patch.vertices.begin());
  };
  patch.triangles.reserve(patch.faces.size());
  for (Index t : patch.faces) {
    const Triangle& corners = scene.triangles[t];
    patch.triangles.push_back({local(corners[0]), local(corners[1]), local(corners[2])});
  }
  patch.parts = scene.parts;
  if (!scene.part_of.empty())
    for (const Index t : patch.faces) patch.part_of.push_back(scene.part_of[t]);
  patch.solids = solids_of(scene.solids, {patch.faces.data(), static_cast<std::size_t>(patch.active_count)});
  patch.rest.resize(3, patch.vertices.size());
  patch.x.resize(3, patch.vertices.size());
  for (std::size_t k = 0; k < patch.vertices.size(); ++k) {
    patch.x.col(k) = scene.x.col(patch.vertices[k]);
    const bool is_free = static_cast<Index>(k) < patch.free_count;
    patch.rest.col(k) = (is_free ? scene.rest : scene.x).col(patch.vertices[k]);
  }
  return patch;
}

Box patch_box(const Scene& scene, std::span<const Index> free_vertices, double reach) {
  Box box;
  for (Index v : free_vertices)
    for (Index t : scene.triangles_of_vertex[v]) {
      box.extend(box_of(scene.x, scene.triangles[t]));
      box.extend(box_of(scene.rest, scene.triangles[t]));
    }
  return box.inflated(reach);
}

void paste_patch(const Patch& patch, Scene& scene, SceneIndex& index) {
  if (!patch.x.leftCols(patch.free_count).allFinite()) return;
  for (Index k = 0; k < patch.free_count; ++k) scene.x.col(patch.vertices[k]) = patch.x.col(k);
  index.mark_moved({patch.vertices.data(), static_cast<std::size_t>(patch.free_count)});
}

}  // namespace unsnarl
