#pragma once

#include "pipeline/repair_state.h"

namespace unsnarl {

/// Opens faces at an edge that are folded together closer than RepairOptions::min_dihedral_deg, on the positions as
/// they will be written, where nothing is in the way. Nothing happens where that is 0.
void dihedral_stage(const RepairTask& task, const RepairControl& control, RepairState& state);

}  // namespace unsnarl
