#pragma once

#include <span>

#include "unsnarl/surface.h"

namespace unsnarl {

/// Throws std::invalid_argument naming the first corner that names no vertex, offset that is out of order, or
/// coordinate that is not finite.
void require_valid(const SurfaceView& surface);

/// Throws std::invalid_argument where `positions` are not 3 finite numbers for each vertex of the surface.
void require_positions(const SurfaceView& surface, std::span<const double> positions);

}  // namespace unsnarl
