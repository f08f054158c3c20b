#pragma once

#include "scene/nested_surfaces.h"
#include "scene/prepared_surface.h"
#include "unsnarl/nesting.h"

namespace unsnarl {

/// The surfaces of a nesting, and all pairs of them that one of its chains names. Throws std::invalid_argument for a
/// nesting that makes no sense (see repair_nested).
NestedSurfaces nested_surfaces(const SurfaceView& surface, const PreparedSurface& prepared, const Nesting& nesting);

}  // namespace unsnarl
