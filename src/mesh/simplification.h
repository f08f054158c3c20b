#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "geometry/types.h"

namespace unsnarl {

/// About `count` triangles on some of the vertices, where they are, that follow the surface of the given ones to within
/// about `tolerance` (a length). Vertices on open edges all stay, and so does the topology. May end with more
/// triangles. Triangles without area may be dropped.
std::vector<Triangle> simplify(const Positions& x, std::span<const Triangle> triangles, std::size_t count,
                               double tolerance);

}  // namespace unsnarl
