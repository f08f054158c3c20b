#include "untangle/alone_first.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <utility>
#include <vector>

#include "contact/blocking_pairs.h"
#include "mesh/union_find.h"
#include "scene/scene.h"
#include "scene/scene_index.h"

namespace unsnarl {
namespace {

/// The patch as if it were the input. Where most pairs are resolved, its rest is the worse guide. [E222]
Scene scene_at_rest_now(const Patch& patch) {
  std::vector<std::uint8_t> fixed(patch.vertices.size(), 1);
  std::fill_n(fixed.begin(), patch.free_count, std::uint8_t{0});
  Scene scene = make_scene(patch.x, patch.triangles, std::move(fixed));
  scene.part_of = patch.part_of;
  scene.parts = patch.parts;
  return scene;
}

/// Untangles the scene as its groups are.
Untangled untangle_by(std::span<const Tier> tiers, const Task& task, Scene& scene) {
  SceneIndex index(scene);
  return task.untangle(scene, index, task.tolerated, tiers, {});
}

bool intersects_itself(const Scene& alone, const Task& task) {
  SceneIndex index(alone);
  return !blocking_pairs(index.find_pairs(), task.tolerated).empty();
}

}  // namespace

int untangle_alone_first(Patch& patch, const Task& task, std::span<const Tier> tiers) {
  assert(task.untangle);
  Scene scene = scene_at_rest_now(patch);
  UnionFind components = vertices_joined_by(patch.triangles, scene.vertex_count());
  scene.group_of = components.dense_ids();
  const bool is_alone =
      std::all_of(scene.group_of.begin(), scene.group_of.end(), [](Index component) { return component == 0; });
  if (is_alone || !intersects_itself(scene, task)) return 0;
  const Untangled alone = untangle_by(tiers, task, scene);
  scene.group_of.clear();
  const Untangled together = untangle_by(tiers, task, scene);
  if (together.left.empty()) patch.x = scene.x;
  return alone.iterations + together.iterations;
}

}  // namespace unsnarl
