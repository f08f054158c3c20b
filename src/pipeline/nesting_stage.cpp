#include "pipeline/nesting_stage.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <utility>
#include <vector>

#include "recover/recover.h"
#include "scene/scene_index.h"
#include "unsnarl/stage_clock.h"
#include "untangle/conflict_regions.h"
#include "untangle/push_into_nesting.h"

namespace unsnarl {
namespace {

std::size_t count_triangles_at(const Scene& scene, const std::vector<Index>& vertices) {
  std::vector<std::uint8_t> is_counted(scene.triangles.size(), 0);
  std::size_t count = 0;
  for (const Index v : vertices)
    for (const Index t : scene.triangles_of_vertex[v]) count += std::exchange(is_counted[t], 1) == 0;
  return count;
}

}  // namespace

void nesting_stage(const RepairTask& task, const RepairControl& control, Finders& finders, RepairState& state) {
  assert(finders.are_of(state.scene.triangles));
  if (!task.nested || control.limits.reached()) return;
  control.phases.start("untangle");
  const StageClock clock;
  SceneIndex index(state.scene, finders.as_is);
  const std::size_t pairs = index.find_pairs().size();
  const PushResult push = push_into_nesting(state.scene, index, task.diagnosis.components.component_of_vertex,
                                            *task.nested, control.limits.stopper());
  if (push.moved.empty()) return;
  std::vector<Index> free = dilate(state.scene, push.moved, recovery_rings);
  state.recorder.begin_stage("untangle");
  state.recorder.add(state.recorder.new_trajectory(), "nesting", state.regions.size(), free, state.scene.x);
  const double depth = (state.scene.x - state.scene.rest).colwise().norm().maxCoeff();
  state.moved.push_back({std::move(free), depth, state.regions.size()});
  RegionReport& region = state.regions.emplace_back();
  region.strategy = "nesting";
  region.faces = count_triangles_at(state.scene, push.moved);
  region.pairs = pairs - std::min(pairs, index.find_pairs().size());
  region.iterations = push.iterations;
  region.seconds = clock.stage("").seconds;
}

}  // namespace unsnarl
