#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geometry/types.h"

namespace unsnarl {

/// Surfaces of a scene of which some are to lie inside others, in terms of its welded vertices.
struct NestedSurfaces {
  std::vector<std::vector<Triangle>> triangles;  ///< of each surface
  std::vector<std::vector<Index>> vertices;      ///< of these triangles, ascending
  std::vector<std::uint8_t> closed;              ///< one flag a surface: it has an inside
  std::vector<Index> surface_of_vertex;          ///< -1: of none
  std::vector<std::array<Index, 2>> pairs;       ///< inner and outer surface; the outer one is closed
};

/// Vertices, ascending, that are on the wrong side of the other surface of this pair at x: those of the inner one that
/// are not strictly inside the outer one and, where the inner one is closed, those of the outer one that are not
/// strictly outside the inner one. Exact.
std::vector<Index> vertices_on_the_wrong_side(const NestedSurfaces& nested, const std::array<Index, 2>& pair,
                                              const Positions& x);

}  // namespace unsnarl
