#pragma once

#include "geometry/types.h"
#include "unsnarl/surface.h"

namespace unsnarl {

/// Adds a tube of triangles around a closed polygon to a surface: a ring of so many corners across the bisector of each
/// of its corners, turned as little as possible from ring to ring, and strips between them. Positions are not finite
/// where the polygon turns right back.
void add_closed_tube(const Positions& x, double radius, int sides, Surface& tube);

}  // namespace unsnarl
