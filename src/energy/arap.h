#pragma once

#include <array>
#include <span>
#include <vector>

#include "geometry/types.h"

namespace unsnarl {

/// As-rigid-as-possible energy (paper §3.3, E_reg), with one rotation R_i a vertex, chosen best for its star:
///   E = w/2 sum_i sum_{j in N(i)} |(x_i - x_j) - R_i (rest_i - rest_j)|^2.
/// Every edge weighs the same, so that thin triangles do no harm. Its Hessian with the rotations held is 2 L, L the
/// Laplacian with these weights. Scales as length squared.
class Arap {
 public:
  /// Weight w of an edge in an equilateral triangle, the cotangent of its angle (fixed by geometry)
  static constexpr double edge_weight = 0.57735026918962573;

  /// Edges are those of `triangles`. Vertices from `free_count` on do not move, and not all of their neighbours are
  /// known: their rotation is the identity.
  Arap(std::span<const Triangle> triangles, const Positions& rest, Index free_count);

  /// Returns weight * E and adds weight * its gradient (all vertices; the caller drops what is fixed).
  double value_and_gradient(const Positions& x, Positions& gradient, double weight = 1);

  /// The best rotation of vertex i at the last evaluation.
  const Eigen::Matrix3d& rotation(Index i) const { return rotations_[i]; }

 private:
  Index free_count_ = 0;
  std::vector<Index> offsets_;  // of each vertex's half-edges
  std::vector<Index> neighbours_;
  Positions rest_edges_;  // rest_i - rest_j, one column a half-edge
  std::vector<Eigen::Matrix3d> rotations_;
};

/// The rotation R that maximises trace(R^T S): the closest to S. For S of rank < 2 one of many, but always a rotation.
Eigen::Matrix3d closest_rotation(const Eigen::Matrix3d& s);

}  // namespace unsnarl
