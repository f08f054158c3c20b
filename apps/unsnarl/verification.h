#pragma once

#include <span>
#include <vector>

#include "contact/intersection_finder.h"
#include "mesh/identification.h"
#include "mesh/triangulation.h"
#include "unsnarl/repair.h"

namespace unsnarl::app {

/// Counts the self-intersections of positions that were written and read back. Which vertices are one and how polygons
/// are cut stays as decided on the input, so that vertices that came to coincide count as intersecting.
class Verification {
 public:
  /// The input must outlive it.
  Verification(const SurfaceView& input, const FindOptions& options);

  /// Intersecting pairs of faces for positions of the input's vertices, sorted. Pairs of triangles of the same two
  /// faces count once, with the first of their classes.
  std::vector<IntersectingPair> pairs(std::span<const double> positions);
  const CutStatistics& cut() const { return triangulation_.statistics; }

  /// First vertex that no longer lies with the one it is identified with, although both lay together; -1: none.
  Index first_torn_vertex(std::span<const double> positions) const;

 private:
  SurfaceView input_;
  Identification identification_;
  Triangulation triangulation_;
  IntersectionFinder finder_;
};

/// Ids of the faces in any pair, ascending.
std::vector<Index> faces_in(const std::vector<IntersectingPair>& pairs);

}  // namespace unsnarl::app
