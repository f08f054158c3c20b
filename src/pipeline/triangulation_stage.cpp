#include "pipeline/triangulation_stage.h"

#include <cassert>
#include <utility>
#include <vector>

#include "pipeline/triangulations.h"
#include "pipeline/untangle_stage.h"

namespace unsnarl {
namespace {

/// Polygons are triangulated anew by their present positions this many times, at most (unit: times)
constexpr int most_cuts = 64;
/// Triangulations, from the first on, that are worked on together with the input's, at most (unit: triangulations)
constexpr int most_cuts_at_once = 12;

std::vector<Triangulation> cuts_of_input(const RepairTask& task) {
  return {task.prepared.triangulation, task.prepared.other_diagonals};
}

/// The polygons as a reader of the present state cuts them: as usual, and along the other diagonals.
std::vector<Triangulation> cuts_by_positions(const RepairTask& task, const RepairState& state) {
  const std::vector<double> positions = task.prepared.scatter(task.surface.positions, state.scene.x);
  const SurfaceView result = {positions, task.surface.corners, task.surface.offsets};
  const std::vector<Index>& vertex_of = task.prepared.weld_map.vertex_of;
  return {triangulate(result, vertex_of),
          task.options.find.both_diagonals ? triangulate_other_diagonals(result, vertex_of) : Triangulation()};
}

/// Makes the scene one of these triangles, where it is now.
void take(const RepairTask& task, const UnitedTriangulations& cuts, RepairState& state) {
  Scene scene = make_scene(state.scene.rest, cuts.all.triangles, state.scene.fixed);
  state.ignored = state.exclusive = cuts.exclusive;
  scene.x = std::move(state.scene.x);
  scene.group_of = std::move(state.scene.group_of);
  scene.part_of = task.prepared.allowed.of_triangles(cuts.all.polygon);
  scene.parts = state.scene.parts;
  scene.solids = find_solids(scene.rest, std::span(scene.triangles).first(cuts.of_first), task.diagnosis.components);
  state.scene = std::move(scene);
}

void work_on(const RepairTask& task, const RepairControl& control, const std::vector<Triangulation>& cuts,
             RepairState& state) {
  take(task, unite(cuts), state);
  Finders finders = make_finders(task, state);
  leave_what_may_stay(task, finders, state);
  untangle_stage(task, control, finders, state);
}

std::vector<Index> vertices_of(const RepairTask& task, const std::vector<Index>& polygons) {
  std::vector<Index> vertices;
  for (const Index f : polygons)
    for (const Index corner : task.surface.face(f)) vertices.push_back(task.prepared.weld_map.vertex_of[corner]);
  return vertices;
}

/// Gives up the components on which something is left. Returns whether there are any besides those before.
bool give_up_what_is_left(const RepairTask& task, Finders& finders, RepairState& state) {
  bool any = false;
  for (const Index c : components_with_work(task, finders, state)) {
    any |= !state.policy.is_given_up(c);
    state.policy.give_up(c);
  }
  return any;
}

/// Works on the input's cuts and on those by the present positions until both are embedded. Returns whether they are;
/// else the state is the best one that was met, or one of any cut.
bool embed_both_cuts(const RepairTask& task, const RepairControl& control, RepairState& state) {
  const std::vector<Triangulation> input = cuts_of_input(task);
  const std::size_t input_size = unite(input).all.triangles.size();
  RepairState::Checkpoint best = state.checkpoint();
  bool best_holds = false;
  for (int round = 0; round < most_cuts && !control.limits.reached(); ++round) {
    const std::vector<Triangulation> now = cuts_by_positions(task, state);
    const UnitedTriangulations both = unite({input[0], input[1], now[0], now[1]});
    if (round == 0 && both.all.triangles.size() == input[0].triangles.size()) return true;
    take(task, both, state);
    const RepairState::Checkpoint here = state.checkpoint();
    Finders finders_of_both = make_finders(task, state);
    const std::vector<IntersectingPair> pairs = leave_what_may_stay(task, finders_of_both, state);
    if (is_resolved(task, finders_of_both, state)) {
      const std::vector<Index> on_duplicates = polygons_on_new_duplicates(both.all, input_size, pairs);
      if (on_duplicates.empty()) return true;
      if (!std::exchange(best_holds, true)) best = here;
      state.restore_to_rest(vertices_of(task, on_duplicates));
      work_on(task, control, input, state);
    } else {
      if (round < most_cuts_at_once) {
        untangle_stage(task, control, finders_of_both, state);
        if (is_resolved(task, finders_of_both, state)) continue;
        state.restore(here);
      }
      work_on(task, control, round % 2 == 0 ? now : input, state);
    }
  }
  const std::vector<Triangulation> now = cuts_by_positions(task, state);
  take(task, unite({input[0], input[1], now[0], now[1]}), state);
  Finders finders_at_end = make_finders(task, state);
  leave_what_may_stay(task, finders_at_end, state);
  const bool is_done = !give_up_what_is_left(task, finders_at_end, state);
  take(task, unite(input), state);
  state.restore(best);
  return is_done;
}

}  // namespace

void triangulation_stage(const RepairTask& task, const RepairControl& control, Finders& finders, RepairState& state) {
  assert(finders.are_of(state.scene.triangles));
  if (task.surface.offsets.empty()) return;
  give_up_what_is_left(task, finders, state);
  while (!embed_both_cuts(task, control, state)) {
  }
}

}  // namespace unsnarl
