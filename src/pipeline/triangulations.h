#pragma once

#include <span>
#include <vector>

#include "mesh/triangulation.h"
#include "unsnarl/intersections.h"

namespace unsnarl {

/// The triangles of several cuts of the same polygons, each once, those of earlier cuts first.
struct UnitedTriangulations {
  Triangulation all;
  std::size_t of_first = 0;  ///< triangles of the first cut
  /// Pairs of triangles of one polygon that no cut holds both, sorted: they may meet. Their class says nothing.
  std::vector<IntersectingPair> exclusive;
};
UnitedTriangulations unite(const std::vector<Triangulation>& cuts);

/// Polygons of which a triangle lies on the same three vertices as another, of these pairs (of `cut`), since it came to
/// be cut otherwise than in the first `known` triangles; each once, sorted.
std::vector<Index> polygons_on_new_duplicates(const Triangulation& cut, std::size_t known,
                                              std::span<const IntersectingPair> pairs);

}  // namespace unsnarl
