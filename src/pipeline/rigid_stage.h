#pragma once

#include <span>
#include <vector>

#include "pipeline/repair_state.h"

namespace unsnarl {

/// Moves rigid parts that intersect what is fixed or each other as bodies to a place nearby where they do not
/// (place_bodies), and back toward the input as far as contact allows (recover_bodies). What is soft does not stop
/// them, unless they are of `clear_of_soft`. Afterwards they are held there (state.scene.rest and fixed), rounded to
/// the digits of the result. The state is that of the start; `finders`: of its triangles. Nothing happens where no part
/// is rigid.
void rigid_stage(const RepairTask& task, const RepairControl& control, std::span<const Index> clear_of_soft,
                 Finders& finders, RepairState& state);

/// Rigid parts that soft faces still intersect, ascending. `finders`: of the prepared triangles.
std::vector<Index> parts_in_soft(const RepairTask& task, Finders& finders, const RepairState& state);

}  // namespace unsnarl
