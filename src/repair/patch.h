#pragma once

#include <vector>

#include "geometry/types.h"

namespace unsnarl {

/// A small surface of its own, cut out of the whole: what may move, and what stands still around it.
/// Every solver works on patches and knows nothing of the surface they come from.
struct Patch {
  /// Vertices [0, free_count) may move; the rest never do.
  Index free_count = 0;
  /// Triangles [0, active_count) have a free vertex; the rest are obstacles nearby.
  Index active_count = 0;
  Positions rest;                   ///< where the vertices are in the input; for fixed ones equal to x
  Positions x;                      ///< where they are now
  std::vector<Triangle> triangles;  ///< of vertices of the patch
  std::vector<Index> vertices;      ///< patch vertex -> vertex of the whole, ascending within the free and the fixed
  std::vector<Index> faces;         ///< patch triangle -> triangle of the whole, ascending within active and obstacles
  double edge_length = 0;           ///< h: mean edge of the intersecting faces at rest (or of all active ones)
};

}  // namespace unsnarl
