#pragma once

#include "samples/sphere_grid.h"

namespace unsnarl {

// Even maps of the unit sphere to space: images of the projective plane.

/// Boy's surface, an immersion with one triple point: R. L. Bryant's and R. Kusner's parametrisation.
Vec3 boy_map(const Vec3& direction);
/// The cross-cap.
Vec3 cross_cap_map(const Vec3& direction);
/// Steiner's Roman surface.
Vec3 roman_map(const Vec3& direction);

}  // namespace unsnarl
