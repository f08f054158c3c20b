#pragma once

#include <optional>
#include <span>

#include "pipeline/repair_state.h"
#include "unsnarl/report.h"

namespace unsnarl {

/// The gap that every two sheets are to keep (RepairOptions::min_gap_rel), a length at the scale of the scene; 0: none
/// is asked for, or only where something intersected.
double gap_wanted_everywhere(const RepairTask& task);

/// Opens gaps that are too small, wherever they are, on the positions as they will be written: sheets move apart, and
/// back toward rest as far as the gap allows. Nothing happens where all gaps are wide enough. What goes farther than
/// allowed, or would bring an intersecting pair, is taken back.
void gap_stage(const RepairTask& task, const RepairControl& control, RepairState& state);

/// The smallest gap of these positions, whatever the work on them; none where no gap is asked for everywhere. Pairs in
/// `left`, sorted, intersect and do not count, nor do those that may.
std::optional<GapReport> measured_gap(const RepairTask& task, const RepairState& state, const Positions& x,
                                      std::span<const IntersectingPair> left);

}  // namespace unsnarl
