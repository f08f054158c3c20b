#pragma once

#include <vector>

#include "pipeline/repair_control.h"
#include "pipeline/repair_state.h"
#include "pipeline/repair_task.h"
#include "scene/scene_index.h"

namespace unsnarl {

/// Looks for nearer results where components were moved far: their conflicts are repaired again while the component
/// that bears most of the motion is held, then what moved is recovered with it. The nearer result by area is kept
/// (motion by area, mesh/areas.h), or the one that leaves fewer pairs; and so on with the next component while that
/// helps. \pre what moved has been recovered. Returns the pairs that are left.
std::vector<IntersectingPair> hold_parts(const RepairTask& task, const RepairControl& control,
                                         std::vector<IntersectingPair> left, SceneIndex& index, RepairState& state);

}  // namespace unsnarl
