#pragma once

#include "unsnarl/repair.h"

namespace unsnarl {

/// repair() of a surface of which parts are rigid (RepairOptions::rigid), in two steps:
///
/// 1. Rigid parts that intersect what is fixed or each other are moved as bodies to a place nearby where they do not
///    (place_bodies), and back toward the input as far as contact allows (recover_bodies). Their positions are rounded
///    to the digits of the result.
/// 2. All else is repaired around them, with their vertices fixed.
///
/// Where this leaves a rigid part in something soft, both steps are done once more with this part keeping clear of all
/// soft faces where they are in the input; of the two results the one with fewer pairs counts. The report is of the
/// whole: it compares the result with the input.
RepairResult repair_with_rigid_parts(const SurfaceView& surface, const RepairOptions& options, Context& context);

}  // namespace unsnarl
