#pragma once

#include <vector>

#include "mesh/triangulation.h"
#include "unsnarl/intersections.h"

namespace unsnarl {

/// Adds to `all` the triangles that `cut`, another cut of the same polygons, has besides. Returns the pairs of one old
/// and one new triangle of a polygon that the new cut does not hold both, sorted: they may meet. Their class says nothing.
std::vector<IntersectingPair> add_cut(Triangulation& all, const Triangulation& cut);

}  // namespace unsnarl
