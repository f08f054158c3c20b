#pragma once

#include <optional>

#include "repair/diagnose.h"
#include "repair/judge.h"
#include "repair/limits.h"
#include "repair/prepared_surface.h"
#include "repair/tried.h"
#include "unsnarl/repair.h"

namespace unsnarl {

/// Fills the list of the pairs that are left and how many there are for each reason. `left`: of the positions `x`.
void explain_left_pairs(const PreparedSurface& prepared, const Diagnosis& diagnosis, const RepairOptions& options,
                        const Limits& limits, const Tried& tried, const Judge::Pairs& left, const Positions& x,
                        RepairReport& report);

}  // namespace unsnarl
