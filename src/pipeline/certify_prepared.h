#pragma once

#include <span>

#include "scene/prepared_surface.h"
#include "unsnarl/certify.h"

namespace unsnarl {

/// certify() of a surface that has been prepared already, with these options, but for `pairs_float32`. `positions`: 3 n
/// doubles, finite.
Certificate certify_prepared(const SurfaceView& surface, const PreparedSurface& prepared,
                             std::span<const double> positions, const FindOptions& options);

}  // namespace unsnarl
