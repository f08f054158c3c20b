#pragma once

#include "scene/nested_surfaces.h"
#include "scene/prepared_surface.h"
#include "unsnarl/nesting.h"

namespace unsnarl {

/// The surfaces of a nesting, and all pairs of them that one of its chains names. Throws std::invalid_argument for a
/// nesting that makes no sense (see repair_nested).
NestedSurfaces nested_surfaces(const SurfaceView& surface, const PreparedSurface& prepared, const Nesting& nesting);

/// Throws std::invalid_argument where a surface that is to lie inside another holds all of it at x, the positions of
/// the welded vertices, and no faces of the two meet: nothing would move there.
void require_order_is_possible(const NestedSurfaces& nested, const Positions& x, const Nesting& nesting);

}  // namespace unsnarl
