#include "pipeline/region_work.h"

#include <numeric>
#include <utility>

#include "pipeline/gap_stage.h"
#include "recover/recover.h"
#include "untangle/conflict_regions.h"
#include "untangle/strategies.h"

namespace unsnarl {
namespace {

void recover_patch(const RepairTask& task, const RepairControl& control, const RepairState& state, Patch& patch) {
  RecoverOptions options;
  options.knows_sheets = gap_wanted_everywhere(task) > 0;
  options.min_gap =
      state.format.wanted_gap(state.scene, {patch.vertices.data(), static_cast<std::size_t>(patch.free_count)});
  recover(patch, options, control.limits.stopper());
}

}  // namespace

EscalationOptions escalation_options(const RepairTask& task, const RepairControl& control, RepairState& state,
                                     double most_motion, std::atomic<bool>& is_exceeded) {
  EscalationOptions options;
  options.tiers = default_tiers();
  options.left_out = task.options.without_strategies;
  if (task.nested) options.left_out.emplace_back("placement");  // it begins at rest, where the surfaces cross
  options.stop = control.limits.stopper();
  options.recorder = &state.recorder;
  options.first_region = state.regions.size();
  if (task.options.recover) options.recover = [&](Patch& patch) { recover_patch(task, control, state, patch); };
  if (most_motion > 0)
    options.accept = [&task, &control, &state, &is_exceeded, most_motion](Patch& patch) {
      std::vector<Index> free(static_cast<std::size_t>(patch.free_count));
      std::iota(free.begin(), free.end(), 0);
      const auto is_allowed = [&] { return are_within(patch.x, patch.rest, free, most_motion); };
      if (is_allowed()) return true;
      if (task.options.recover) recover_patch(task, control, state, patch);
      if (task.options.recover && is_allowed()) return true;
      is_exceeded = true;
      return false;
    };
  return options;
}

double recover_sets(const RepairTask& task, const RepairControl& control, std::vector<std::vector<Index>> sets,
                    SceneIndex& index, RepairState& state, std::function<void(double)> on_progress) {
  RecoverRegionsOptions options;
  if (task.options.paper) options.recover = RecoverOptions::paper();
  options.recover.knows_sheets = gap_wanted_everywhere(task) > 0;
  options.min_gap = [&](std::span<const Index> vertices) { return state.format.wanted_gap(state.scene, vertices); };
  options.stop = control.limits.stopper();
  options.on_progress = std::move(on_progress);
  return recover_regions(state.scene, index, merge_overlapping(std::move(sets), state.scene.vertex_count()), options,
                         state.recorder);
}

}  // namespace unsnarl
