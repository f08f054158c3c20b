#pragma once

#include <vector>

#include "contact/intersection_finder.h"
#include "scene/prepared_surface.h"

namespace unsnarl {

/// Finds the intersecting pairs of the faces of a surface: of the triangles that they are split into, and where both
/// diagonals of quads count, along either diagonal. The surface must outlive it.
class FacePairFinder {
 public:
  explicit FacePairFinder(const PreparedSurface& surface);

  /// Pairs of faces, sorted, each once, in the class of its first occurrence.
  std::vector<IntersectingPair> find(const Positions& x);

 private:
  /// The triangles of a quad along one diagonal always overlap those along the other.
  bool are_of_one_quad(const IntersectingPair& pair) const;

  const PreparedSurface& surface_;
  std::vector<Triangle> triangles_;  ///< along both diagonals; empty: only one counts
  std::vector<Index> polygon_;
  IntersectionFinder finder_;
};

}  // namespace unsnarl
