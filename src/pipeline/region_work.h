#pragma once

#include <algorithm>
#include <atomic>
#include <functional>
#include <vector>

#include "pipeline/repair_control.h"
#include "pipeline/repair_state.h"
#include "pipeline/repair_task.h"
#include "recover/recover_regions.h"
#include "scene/scene_index.h"
#include "untangle/escalation.h"

namespace unsnarl {

/// Whether none of these vertices (a range of columns of both) is farther from rest than `limit`, a length.
template <class Vertices>
bool are_within(const Positions& x, const Positions& rest, const Vertices& vertices, double limit) {
  return std::all_of(vertices.begin(), vertices.end(),
                     [&](Index v) { return (x.col(v) - rest.col(v)).norm() <= limit; });
}

/// How regions of the state are untangled within the task's limits, without a word of progress. `most_motion`: how far
/// a vertex may end from rest, a length; 0: any. `is_exceeded`: set where a candidate goes farther. All must outlive
/// the options.
EscalationOptions escalation_options(const RepairTask& task, const RepairControl& control, RepairState& state,
                                     double most_motion, std::atomic<bool>& is_exceeded);

/// Recovers sets of vertices, those that overlap as one. Returns the least gap that was reached, or infinity.
/// `on_progress`: see RecoverRegionsOptions; may be empty.
double recover_sets(const RepairTask& task, const RepairControl& control, std::vector<std::vector<Index>> sets,
                    SceneIndex& index, RepairState& state, std::function<void(double)> on_progress = {});

}  // namespace unsnarl
