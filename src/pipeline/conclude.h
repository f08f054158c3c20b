#pragma once

#include "pipeline/repair_state.h"
#include "scene/pair_census.h"
#include "unsnarl/repair.h"

namespace unsnarl {

/// The end of every repair: takes back what made things worse, decides the status, measures the result and says what is
/// left and why.
RepairResult conclude(const RepairTask& task, const RepairControl& control, PairCensus& census,
                      const RepairState& state);

/// The result where nothing was reached, or where that cannot be examined: the input.
RepairResult unchanged(const RepairTask& task, const PairCensus& census, Status status);

/// embedded, obstructed, reduced or no_progress: of positions x with these pairs. Where float32 was asked for, embedded
/// means in float32 too.
Status status_at(const RepairTask& task, PairCensus& census, const PairCensus::Pairs& left, const Positions& x);

}  // namespace unsnarl
