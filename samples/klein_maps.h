#pragma once

#include "samples/parameter_grid.h"

namespace unsnarl {

/// A tube around a drop-shaped plane curve, wide on one way and thin on the other, where it passes through the wide
/// part. The curve's cusp is the bottle's bottom, at which the tube turns inside out.
Vec3 klein_bottle_map(double t, double v);
ParameterGrid klein_bottle_grid(int resolution, FaceKind faces);

/// A figure eight that makes a half turn on its way around a ring of radius `ring`.
Vec3 klein_figure8_map(double u, double v, double ring);
ParameterGrid klein_figure8_grid(int resolution, FaceKind faces);

}  // namespace unsnarl
