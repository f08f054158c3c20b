#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "energy/hessian.h"
#include "geometry/types.h"

namespace unsnarl {

/// As-rigid-as-possible energy of each triangle for itself (the ARAP term per face of paper §3.4, after Fang et al.,
/// Guaranteed Globally Injective 3D Deformation Processing):
///
///   E = sum_t w/2 sum_k |e_k - R_t e0_k|^2,   R_t the rotation that fits the three edges best.
///
/// One weight w for all edges, 1/sqrt(3): the cotangent weight of an equilateral triangle, so that slivers and
/// triangles without area at rest are harmless. Zero and stationary for every rigid motion of the rest shape; scales as
/// length squared. An ElementEnergy (energy_sum.h).
class ArapTriangle {
 public:
  /// Weight of an edge in an equilateral triangle, the cotangent of its angle (fixed by geometry)
  static constexpr double edge_weight = 0.57735026918962576;

  ArapTriangle() = default;
  /// rotation_damping: share of the Hessian with the rotations held, in [0, 1]; the rest is Gauss-Newton, the strains
  /// in the plane of the triangle.
  ArapTriangle(const Positions& rest, std::span<const Triangle> triangles, double rotation_damping = 0);

  Index size() const { return static_cast<Index>(triangles_.size()); }
  const Triangle& vertices(Index t) const { return triangles_[t]; }
  double value(const Positions& x, Index t) const;
  double linearise(const Positions& x, Index t, double weight, Positions& gradient, HessianTerms& hessian) const;

 private:
  Eigen::Matrix3d edges(const Positions& x, Index t) const;
  Eigen::Matrix<double, 3, 2> fitted_rotation(const Eigen::Matrix3d& edges, Index t) const;

  std::vector<Triangle> triangles_;
  std::vector<Eigen::Matrix<double, 2, 3>> rest_edges_;  // in a frame of the triangle's own; edge k: corner k to k + 1
  double rotation_damping_ = 0;
};

}  // namespace unsnarl
