#include "pipeline/rigid_stage.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <utility>

#include "geometry/sort_unique.h"
#include "pipeline/gap_stage.h"
#include "rigid/bodies.h"
#include "rigid/place_bodies.h"
#include "rigid/recover_bodies.h"

namespace unsnarl {
namespace {

std::vector<Index> vertices_of(const Bodies& bodies) {
  std::vector<Index> vertices;
  for (const Body& body : bodies.list()) vertices.insert(vertices.end(), body.vertices.begin(), body.vertices.end());
  return vertices;
}

/// Puts the bodies in their places. Returns whether one had none within the displacement that is allowed.
bool place(const RepairTask& task, const RepairControl& control, const RepairState& state, Bodies& bodies) {
  const double limit = task.most_motion();
  PlaceBodiesOptions places;
  RecoverBodiesOptions recovery;
  if (limit > 0) places.most_motion = recovery.most_motion = limit;
  recovery.opens_gaps_at_rest = gap_wanted_everywhere(task) > 0;
  places.stop = recovery.stop = control.limits.stopper();
  const bool is_too_far = place_bodies(bodies, places);
  if (const std::vector<Index> vertices = vertices_of(bodies); !vertices.empty())
    recovery.min_gap = state.format.wanted_gap(state.scene, vertices);
  if (task.options.recover) recover_bodies(bodies, recovery);
  return is_too_far;
}

std::size_t pairs_within_parts(const RepairTask& task, Finders& finders, const Positions& x) {
  const std::vector<Index>& part_of = task.policy.rigid_parts().of_vertex;
  const auto part = [&](Index t) {
    const Triangle& v = task.prepared.triangles()[t];
    return part_of[v[0]] == part_of[v[1]] && part_of[v[0]] == part_of[v[2]] ? part_of[v[0]] : -1;
  };
  const std::vector<IntersectingPair> pairs = finders.as_is.find(x);
  return static_cast<std::size_t>(std::count_if(pairs.begin(), pairs.end(), [&](const IntersectingPair& pair) {
    return part(pair.a) >= 0 && part(pair.a) == part(pair.b);
  }));
}

/// The places as they will be written. Gives float32 up where its digits are too few for the faces of a part, so that
/// it would intersect itself.
Positions rounded_places(const RepairTask& task, const Positions& x, Finders& finders, RepairState& state) {
  Positions rounded = state.format.as_written(x);
  if (!state.format.may_give_up_float32()) return rounded;
  if (pairs_within_parts(task, finders, rounded) <= pairs_within_parts(task, finders, task.prepared.rest))
    return rounded;
  state.format.give_up_float32();
  return state.format.as_written(x);
}

/// Takes the places over: parts are held there, and what is soft is repaired around them.
void hold(const RepairTask& task, const Positions& x, RepairState& state) {
  const std::vector<Index>& part_of = task.policy.rigid_parts().of_vertex;
  std::vector<Index> moved;
  for (Index v = 0; v < state.scene.vertex_count(); ++v) {
    if (part_of[v] < 0) continue;
    state.scene.fixed[v] = 1;
    if (x.col(v) != state.scene.rest.col(v)) moved.push_back(v);
  }
  state.scene.rest = state.scene.x = x;
  state.attempts.solved = x;
  state.policy.hold(state.scene.fixed, x);
  if (moved.empty()) return;
  state.recorder.begin_stage("untangle");
  state.recorder.add(state.recorder.new_trajectory(), "place", Recorder::no_region, moved, x);
}

}  // namespace

void rigid_stage(const RepairTask& task, const RepairControl& control, std::span<const Index> clear_of_soft,
                 Finders& finders, RepairState& state) {
  assert(finders.are_of(state.scene.triangles));
  const RigidParts& parts = task.policy.rigid_parts();
  if (parts.count == 0) return;
  control.phases.start("place");
  Bodies bodies(state.scene.rest, state.scene.triangles, parts.of_vertex, parts.count, state.scene.fixed,
                state.scene.passing());
  for (const Index part : clear_of_soft) bodies.avoid_soft(part);
  state.format.choose(state.scene, state.pairs_at_rest);
  if (place(task, control, state, bodies)) {
    state.displacement_is_exceeded = true;
    for (const Body& body : bodies.list())
      if (!body.is_placed)
        for (const Index v : body.vertices) state.attempts.is_too_far[v] = 1;
  }
  hold(task, rounded_places(task, bodies.x(), finders, state), state);
  state.pairs_at_rest = finders.as_is.find(state.scene.rest);
}

std::vector<Index> parts_in_soft(const RepairTask& task, Finders& finders, const RepairState& state) {
  const std::span<const Triangle> triangles = task.prepared.triangles();
  assert(finders.are_of(triangles));
  const std::vector<Index>& part_of = task.policy.rigid_parts().of_vertex;
  std::vector<Index> parts;
  const auto is_soft = [&](const Triangle& t) {
    return std::any_of(t.begin(), t.end(), [&](Index v) { return !state.scene.fixed[v]; });
  };
  for (const IntersectingPair& pair : finders.as_is.find(state.scene.x)) {
    const Triangle &a = triangles[pair.a], &b = triangles[pair.b];
    if (is_soft(b) && !is_soft(a) && part_of[a[0]] >= 0) parts.push_back(part_of[a[0]]);
    if (is_soft(a) && !is_soft(b) && part_of[b[0]] >= 0) parts.push_back(part_of[b[0]]);
  }
  sort_unique(parts);
  return parts;
}

}  // namespace unsnarl
