#pragma once

#include <vector>

#include "pipeline/repair_control.h"
#include "pipeline/repair_state.h"
#include "pipeline/repair_task.h"
#include "scene/scene_index.h"

namespace unsnarl {

/// Looks for nearer results where coarse components moved: faces that cannot dent move as a whole, while finer ones
/// could give way. The conflicts that hang together are repaired again from rest while the components that bear most of
/// the motion are held, of those that meet each other one; then what moved is recovered with them. The nearer result is
/// kept, by area (squared_motion()), or the one that leaves fewer pairs; and so on with the next components while that
/// helps. A component is held only where its edges are much longer than those of another one that it meets. Nested
/// surfaces are left as they are: their repair does not begin at rest. \pre what moved since state.recovered has been
/// recovered; `left`: the pairs that are left. Returns those that are left now.
std::vector<IntersectingPair> hold_parts(const RepairTask& task, const RepairControl& control,
                                         std::vector<IntersectingPair> left, SceneIndex& index, RepairState& state);

}  // namespace unsnarl
