#pragma once

#include "pipeline/repair_state.h"

namespace unsnarl {

/// Pushes the surfaces of the scene that are to lie inside each other, and cross, into this order. Other intersections
/// stay. `finders`: of the scene's triangles. Nothing happens where no order is asked for.
void nesting_stage(const RepairTask& task, const RepairControl& control, Finders& finders, RepairState& state);

}  // namespace unsnarl
