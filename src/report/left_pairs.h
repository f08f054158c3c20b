#pragma once

#include <optional>

#include "report/acceptance.h"
#include "scene/diagnose.h"
#include "scene/prepared_surface.h"
#include "unsnarl/repair.h"
#include "untangle/attempt_log.h"

namespace unsnarl {

/// Fills the list of the pairs that are left and how many there are for each reason. `limit`: the one that was reached,
/// or Status::reduced. `left`: of the positions `x`.
void explain_left_pairs(const PreparedSurface& prepared, const Diagnosis& diagnosis, const RepairOptions& options,
                        Status limit, const AttemptLog& attempts, const Acceptance& acceptance,
                        const Acceptance::Pairs& left, const Positions& x, RepairReport& report);

}  // namespace unsnarl
