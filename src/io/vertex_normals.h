#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "unsnarl/surface.h"

namespace unsnarl {

/// Stored vertex normals after the vertices moved from those of `before` to `after`.
///
/// normals: 3 numbers each. normal_of_corner: for each corner of the surface the normal that it uses, or -1.
/// A normal turns as the mean of the faces that use it turns, and keeps its length; so hard edges, smoothing groups and
/// shading by hand stay what they are. Normals stay bit-identical where none of their faces moved, and where vertices
/// of faces that did not move use them too.
std::vector<double> turned_normals(const SurfaceView& before, std::span<const double> after,
                                   std::span<const double> normals, std::span<const std::int32_t> normal_of_corner);

}  // namespace unsnarl
