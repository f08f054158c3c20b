#pragma once

#include <span>

#include "scene/rigid_parts.h"
#include "unsnarl/repair.h"

namespace unsnarl {

/// Adds to report.rigid_parts how each part (of options.rigid) has moved from the surface to `positions` (same layout).
void measure_rigid_parts(const SurfaceView& surface, const RepairOptions& options, const RigidParts& parts,
                         std::span<const double> positions, RepairReport& report);

}  // namespace unsnarl
