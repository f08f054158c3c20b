#pragma once

#include <functional>
#include <span>
#include <vector>

#include "applications/isotopy/rings.h"

namespace unsnarl {

/// Closed polygons on their way to be triangles: the first ring is what is given.
struct TrianglesWay {
  Stack stack;
  /// Which point of its polygon each point of a ring is: one list a ring, in it one a polygon, ascending.
  std::vector<std::vector<std::vector<Index>>> corners;
};

/// Removes corners, one by one (corner_removal.h), until triangles are left; those that can be removed at once make one
/// strip. At no height do polygons cross themselves or each other. Where polygons that lie in another one are in the
/// way of that, they are triangles by then: they shrink and move to where a triangle of a triangulation of the other
/// polygon will be left. So this always ends. `parent`: the innermost other polygon in which each lies, or -1; `sides`:
/// 1 for a counter-clockwise polygon, -1. `stop`: true ends it early. Precondition: the polygons are simple and
/// disjoint.
TrianglesWay shrink_to_triangles(const Polygons& polygons, std::span<const Index> parent, std::span<const double> sides,
                                 const std::function<bool()>& stop);

}  // namespace unsnarl
