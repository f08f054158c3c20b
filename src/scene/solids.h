#pragma once

#include <span>
#include <vector>

#include "geometry/types.h"
#include "mesh/components.h"

namespace unsnarl {

/// A closed component at rest.
struct Solid {
  double volume = 0;  ///< negative: its normals point inward
  double area = 0;
};

/// The closed components of a surface, or of a piece of it.
struct Solids {
  std::vector<Solid> list;
  std::vector<Index> of_triangle;  ///< which one it is of; -1, or beyond the end: none
};

/// Those with a volume (has_volume()) among the components of these triangles.
Solids find_solids(const Positions& rest, std::span<const Triangle> triangles, const Components& components);

/// Those that these triangles are of, numbered anew.
Solids solids_of(const Solids& all, std::span<const Index> triangles);

}  // namespace unsnarl
