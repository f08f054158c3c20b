#pragma once

#include "pipeline/repair_state.h"

namespace unsnarl {

/// A reader of the output triangulates polygons by their new positions, which may intersect where the input's
/// triangulation does not. Moves vertices until both triangulations are embedded: on both at once or, as long as no way
/// to that is found, on the one and the other in turn; quads along either diagonal, if both count. Gives up components
/// on which something is left or for which no way is found. The scene has the input's triangles before and after.
/// `finders`: of these.
void triangulation_stage(const RepairTask& task, const RepairControl& control, Finders& finders, RepairState& state);

}  // namespace unsnarl
