#pragma once

#include "unsnarl/surface.h"

namespace unsnarl {

/// Throws std::invalid_argument naming the first corner that names no vertex, offset that is out of order, or
/// coordinate that is not finite.
void require_valid(const SurfaceView& surface);

}  // namespace unsnarl
