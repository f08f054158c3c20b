#pragma once

#include <vector>

#include "contact/intersection_finder.h"
#include "scene/prepared_surface.h"

namespace unsnarl {

/// Finds the intersecting pairs of the faces of a surface: of the triangles that they are cut into, and where both
/// diagonals of quads count, of those that they could be cut into. The surface must outlive it.
class FacePairFinder {
 public:
  explicit FacePairFinder(const PreparedSurface& surface);

  /// Pairs of faces, sorted, each once, in the class of its first occurrence.
  std::vector<IntersectingPair> find(const Positions& x);

 private:
  /// Triangles of two cuts of the same quad overlap by their nature.
  bool are_of_one_quad(const IntersectingPair& pair) const;

  const PreparedSurface& surface_;
  std::vector<Triangle> triangles_;  ///< of both cuts; empty: there is but one
  std::vector<Index> polygon_;
  IntersectionFinder finder_;
};

}  // namespace unsnarl
