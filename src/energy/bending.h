#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "energy/hessian.h"
#include "geometry/types.h"
#include "mesh/adjacency.h"

namespace unsnarl {

/// An edge (0, 1) with the corners opposite to it in two triangles, 2 and 3.
using BendingHinge = std::array<Index, 4>;

/// Hinges of a triangle mesh; an edge with k > 2 triangles gives k - 1 of them, in the order of the triangles.
std::vector<BendingHinge> bending_hinges_of(std::span<const Triangle> triangles, const EdgeTable& edges);

/// Signed angle by which the second triangle of a hinge is bent out of the plane of the first, in (-pi, pi]; 0: flat.
double bending_angle(const Vec3& x0, const Vec3& x1, const Vec3& x2, const Vec3& x3);
/// The same, and its gradient in the four vertices; zero gradient where a triangle has no area.
double bending_angle(const Vec3& x0, const Vec3& x1, const Vec3& x2, const Vec3& x3,
                     Eigen::Matrix<double, 3, 4>& gradient);

/// Hinge bending energy E = 1/2 sum_e w_e (angle_e - rest_angle_e)^2 (Grinspun et al., Discrete Shells), without unit.
///
/// w_e = min(3 |e|^2 / A_e, stiffness_cap (height / h)^2), height the smaller of the two altitudes over the edge, so
/// that no sliver becomes stiffer than an equilateral triangle of edge h; hinges of slivers thinner than `sliver` h
/// weigh nothing.
///
/// Rest angles are taken modulo a full turn nearest to the angle at `start`: a hinge that had to be folded the other
/// way round is pulled to the near side of its rest shape instead of the long way back. An ElementEnergy
/// (energy_sum.h).
class Bending {
 public:
  struct Options {
    /// The length h that makes stiffnesses and slivers relative (unit: length)
    double edge_length = 1;
    /// Stiffness of a hinge, at most: the ratio 3 |e|^2 / A_e over (height / h)^2 of equilateral triangles (no unit)
    double stiffness_cap = 4.6;
    double sliver = 1e-3;  ///< Hinges with a lower height weigh nothing (unit: h)
  };
  Bending() = default;
  Bending(const Positions& rest, const Positions& start, std::span<const BendingHinge> hinges, const Options& options);

  Index size() const { return static_cast<Index>(hinges_.size()); }
  const BendingHinge& vertices(Index e) const { return hinges_[e]; }
  double value(const Positions& x, Index e) const;
  /// The Hessian is its Gauss-Newton part, w_e times the gradient of the angle squared.
  double linearise(const Positions& x, Index e, double weight, Positions& gradient, HessianTerms& hessian) const;

 private:
  std::vector<BendingHinge> hinges_;
  std::vector<double> weights_;
  std::vector<double> rest_angles_;
};

}  // namespace unsnarl
