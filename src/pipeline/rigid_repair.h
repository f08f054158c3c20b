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
/// If a rigid part still intersects soft faces after this, both steps are done once more, and this part keeps clear of
/// the soft faces of the input. The result with fewer pairs counts. The report is of the
/// whole: it compares the result with the input.
RepairResult repair_with_rigid_parts(const SurfaceView& surface, const RepairOptions& options, Context& context);

}  // namespace unsnarl
