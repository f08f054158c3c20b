#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "geometry/types.h"

namespace unsnarl {

/// As-rigid-as-possible energy of each triangle for itself (the ARAP term per face of paper §3.4, after Fang et al.,
/// Guaranteed Globally Injective 3D Deformation Processing):
///
///   E = sum_t w/2 sum_k |e_k - R_t e0_k|^2,   R_t the rotation that fits the three edges best.
///
/// One weight w for all edges (1/sqrt(3) is the cotangent weight of an equilateral triangle), so that slivers and
/// triangles without area at rest are harmless. Zero and stationary for every rigid motion of the rest shape; scales as
/// length squared.
class ArapTriangle {
 public:
  ArapTriangle() = default;
  ArapTriangle(const Positions& rest, std::span<const Triangle> triangles, double weight = 0.57735026918962576);

  double weight() const { return weight_; }
  Index size() const { return static_cast<Index>(triangles_.size()); }
  const Triangle& triangle(Index t) const { return triangles_[t]; }

  double value(const Positions& x) const;
  /// Adds `scale` times the gradient to g.
  double value_and_gradient(const Positions& x, double scale, Positions& g) const;
  double triangle_energy(const Positions& x, Index t) const;

  /// Gauss-Newton part of the Hessian of one triangle: the strains in its plane. Motions of the three corners along the
  /// normal and turns in the plane cost nothing, as at rest.
  class Strain {
   public:
    /// Corner k of the result: sum_l H_kl v_l / weight.
    Eigen::Matrix3d apply(const Eigen::Matrix3d& v) const;
    /// Diagonal block of corner k / weight.
    Eigen::Matrix3d block(int k) const;

    Eigen::Matrix<double, 3, 2> rotation;  // of the rest frame
    Eigen::Vector4d turn;                  // unit: the infinitesimal turn in the plane, in the coordinates below
  };
  /// Energy of triangle t, its derivatives in the three corners, and its strain.
  double linearise(const Positions& x, Index t, Eigen::Matrix3d& forces, Strain& strain) const;

 private:
  Eigen::Matrix3d edges(const Positions& x, Index t) const;
  Eigen::Matrix<double, 3, 2> fitted_rotation(const Eigen::Matrix3d& edges, Index t) const;

  std::vector<Triangle> triangles_;
  std::vector<Eigen::Matrix<double, 2, 3>> rest_edges_;  // in a frame of the triangle's own; edge k: corner k to k + 1
  double weight_ = 0;
};

}  // namespace unsnarl
