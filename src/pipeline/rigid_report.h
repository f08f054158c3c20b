#pragma once

#include <span>
#include <string>
#include <vector>

#include "geometry/types.h"
#include "unsnarl/repair.h"

namespace unsnarl {

/// The name of a part of RepairOptions::rigid; its number where it has none.
std::string name_of_rigid_part(const RepairOptions& options, Index part);

/// Adds to report.rigid_parts how each of `part_count` parts has moved from the surface to `positions` (same layout).
void measure_rigid_parts(const SurfaceView& surface, const RepairOptions& options, Index part_count,
                         std::span<const double> positions, RepairReport& report);

/// The frames of a repair that began with rigid parts in their places (`placed`, positions of all vertices): puts a
/// frame of the input before them, whose intersecting pairs are `pairs`. Leaves them alone if nothing was placed.
void begin_with_input(const SurfaceView& surface, std::span<const double> placed,
                      std::span<const IntersectingPair> pairs, std::vector<RecordedFrame>& frames);

}  // namespace unsnarl
