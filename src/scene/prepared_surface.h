#pragma once

#include <span>
#include <vector>

#include "geometry/types.h"
#include "mesh/adjacency.h"
#include "mesh/components.h"
#include "mesh/triangulation.h"
#include "mesh/weld_map.h"
#include "unsnarl/intersections.h"
#include "unsnarl/surface.h"

namespace unsnarl {

/// Everything that is decided once, from the input, and holds for every later state of it.
struct PreparedSurface {
  WeldMap weld_map;
  Triangulation triangulation;
  Triangulation otherwise;  ///< quads along their other diagonals; empty unless FindOptions::both_diagonals
  Positions rest;           ///< of welded vertices

  std::span<const Triangle> triangles() const { return triangulation.triangles; }
  /// Positions of the file's vertices -> of the welded ones (the first of each).
  Positions gather(std::span<const double> positions) const;
  /// The input's positions, with those of the welded vertices that differ from rest put in their place.
  std::vector<double> scatter(std::span<const double> input, const Positions& x) const;
};

/// Throws std::invalid_argument where the surface makes no sense (see require_valid).
PreparedSurface prepare(const SurfaceView& surface, const FindOptions& options);

/// Pairs of triangles -> pairs of the faces they were cut from (`polygon`, of each triangle), sorted, each once, in the
/// class of its first occurrence.
std::vector<IntersectingPair> pairs_of_faces(std::span<const Index> polygon, std::span<const IntersectingPair> pairs);

}  // namespace unsnarl
