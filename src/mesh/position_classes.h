#pragma once

#include <span>
#include <vector>

#include "geometry/types.h"

namespace unsnarl {

/// Class of each vertex by position alone, in the order of first occurrence; what Weld::all welds. `tolerance` > 0: a
/// chain of positions no further apart than it makes one class; else they are exactly equal (-0.0 equals 0.0).
std::vector<Index> position_classes(std::span<const double> positions, double tolerance = 0);

}  // namespace unsnarl
