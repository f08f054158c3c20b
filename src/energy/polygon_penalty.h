#pragma once

#include <array>
#include <span>
#include <utility>
#include <vector>

#include "geometry/types.h"

namespace unsnarl {

/// E_M between convex polygons as they are (Minarčík, Liu, Crane, Li: Untangling Surfaces via Shape and Mesh Repulsion,
/// §3.2, eq. (10), "General polygonal faces"): the sum of max(0, depth) over pairs that share no vertex.
class PolygonPenalty {
 public:
  /// Corners in order around, three or more; polygons that stop being flat are replaced by their convex hulls.
  explicit PolygonPenalty(std::vector<std::vector<Index>> polygons) : polygons_(std::move(polygons)) {}

  /// Candidate pairs, a != b: at least those whose boxes overlap.
  std::vector<std::array<Index, 2>> pairs;

  const std::vector<std::vector<Index>>& polygons() const { return polygons_; }
  /// Returns weight * E_M and adds weight * its gradient.
  double value_and_gradient(const Positions& x, Positions& gradient, double weight = 1) const;

 private:
  std::vector<std::vector<Index>> polygons_;
};

/// The faces of a surface as convex polygons: the triangles of a face (`face_of`, one entry a triangle) are joined if
/// together they are convex and flat within a twentieth of their size; otherwise each is a polygon. In the order of
/// their first triangles.
std::vector<std::vector<Index>> convex_faces(std::span<const Triangle> triangles, std::span<const Index> face_of,
                                             const Positions& x);

}  // namespace unsnarl
