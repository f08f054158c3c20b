#pragma once

#include <vector>

#include "mesh/triangulation.h"
#include "oracle/intersections_oracle.h"
#include "unsnarl/surface.h"

namespace unsnarl {

/// Pairs left, by CGAL, on the triangles that the polygons are cut into.
inline std::vector<IntersectingPair> judged(const Surface& surface, const std::vector<double>& positions) {
  return oracle::intersections_by_cgal(positions, triangulate(surface).triangles);
}

}  // namespace unsnarl
