#include "pipeline/repair_state.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "contact/blocking_pairs.h"
#include "geometry/sort_unique.h"
#include "mesh/areas.h"

namespace unsnarl {
namespace {

Scene scene_at_rest(const RepairTask& task) {
  std::vector<std::uint8_t> held(task.prepared.weld_map.count, 0);
  for (Index v = 0; v < static_cast<Index>(held.size()); ++v) held[v] = task.policy.is_held(v);
  Scene scene =
      make_scene(task.prepared.rest, task.prepared.triangulation.triangles, std::move(held), task.diagnosis.edges);
  scene.face_of = task.prepared.triangulation.polygon;
  scene.part_of = task.prepared.part_of;
  scene.parts = &task.prepared.allowed.passing;
  scene.solids = find_solids(scene.rest, scene.triangles, task.diagnosis.components);
  if (task.options.each_component) scene.group_of = task.diagnosis.components.component_of_vertex;
  return scene;
}

}  // namespace

RepairState::RepairState(const RepairTask& task)
    : scene(scene_at_rest(task)),
      format(task.surface, task.prepared, task.options),
      policy(task.policy),
      pairs_at_rest(task.diagnosis.pairs),
      attempts(task.prepared.rest),
      recorder(task.options.record, task.prepared.rest) {
  if (!task.options.each_component) return;
  std::erase_if(pairs_at_rest,
                [&](const auto& pair) { return are_of_two_components(task.diagnosis.components, pair); });
}

void RepairState::restore(const Checkpoint& checkpoint) {
  scene.x = checkpoint.x;
  regions.resize(checkpoint.regions);
  recorder.restore(checkpoint.recorded);
  smallest_gap = checkpoint.smallest_gap;
}

Finders make_finders(const RepairTask& task, const RepairState& state) {
  return Finders(state.scene.triangles, task.prepared.scale, state.scene.passing());
}

std::vector<IntersectingPair> leave_what_may_stay(const RepairTask& task, Finders& finders, RepairState& state) {
  assert(finders.are_of(state.scene.triangles));
  std::vector<IntersectingPair> pairs = finders.as_is.find(state.scene.x);
  state.ignored = state.exclusive;
  for (const IntersectingPair& pair : blocking_pairs(pairs, state.exclusive))
    if (state.policy.reason_to_leave(state.scene.triangles[pair.a], state.scene.triangles[pair.b], pair.kind))
      state.ignored.push_back(pair);
  std::sort(state.ignored.begin(), state.ignored.end());
  std::erase_if(pairs, [&](const IntersectingPair& pair) {
    return state.policy.is_given_up(state.component_of(task, pair.a)) ||
           state.policy.is_given_up(state.component_of(task, pair.b));
  });
  return pairs;
}

std::vector<Index> components_with_work(const RepairTask& task, Finders& finders, const RepairState& state) {
  assert(finders.are_of(state.scene.triangles));
  std::vector<Index> components;
  for (const IntersectingPair& pair : blocking_pairs(finders.as_is.find(state.scene.x), state.ignored))
    components.insert(components.end(), {state.component_of(task, pair.a), state.component_of(task, pair.b)});
  for (const Triangle& t : task.prepared.triangulation.triangles)
    if (count_lost_areas(state.scene.rest, state.scene.x, {&t, 1}) > 0)
      components.push_back(task.diagnosis.components.component_of_vertex[t[0]]);
  sort_unique(components);
  return components;
}

bool is_resolved(const RepairTask& task, Finders& finders, const RepairState& state) {
  const std::vector<Index> components = components_with_work(task, finders, state);
  return std::all_of(components.begin(), components.end(), [&](Index c) { return state.policy.is_given_up(c); });
}

}  // namespace unsnarl
