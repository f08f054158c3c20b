#pragma once

#include <Eigen/SparseCholesky>
#include <span>
#include <vector>

#include "applications/knots/strip.h"

namespace unsnarl {

/// A pair of triangles in R^4: how far they are apart, or, below 0, by how much they run through each other, and the
/// vector of unit length along which their parting changes it fastest. weights: entry 3 i + j is that of corner i of a
/// minus corner j of b; they sum to 1.
struct Separation4 {
  double distance = 0;
  Vec4 direction = Vec4::Zero();
  std::array<double, 9> weights{};
};

/// The signed distance of the origin from the Minkowski difference of the triangles, as of the paper's §3.2 in three
/// dimensions. The difference has facets of a triangle and an edge: six normals across the plane of one triangle and an
/// edge of the other, of either sign.
Separation4 separation_of(const Triangle4& a, const Triangle4& b);

/// An energy that untangles a cylinder in R^4 whose rings keep their heights, in terms of the displacement of the rings
/// between the first and the last (paper §3.3 and §4.5, one dimension up): a sum, without unit, of
/// - the Gaussian self-contact energy of vertices, arc / epsilon exp(-|p - q|^2 / epsilon^2), |p - q| in R^4;
/// - the Minkowski penalty (margin - distance)^2 of triangles of one strip that are nearer than the margin;
/// - the squares of what edges of the cylinder's grid have changed by.
/// Lengths are those of the mean edge, which is also the height of a strip.
class CylinderEnergy {
 public:
  explicit CylinderEnergy(std::vector<Positions> rings);

  double epsilon = 4;      ///< Range of the Gaussian (unit: mean edges)
  double gaussian = 0.05;  ///< Weight of the Gaussian energy (no unit)
  double margin = 0.5;     ///< Triangles that are nearer are penalised (unit: mean edges)
  double penalty = 1;      ///< Weight of the penalty of triangles (no unit)
  double membrane = 0.05;  ///< Weight of the changes of edges (no unit)

  /// 3 numbers a vertex of the rings between.
  Eigen::Index size() const { return 3 * n_ * (static_cast<Eigen::Index>(rest_.size()) - 2); }
  double operator()(const Eigen::VectorXd& displacement, Eigen::VectorXd& gradient) const;
  /// Applies the inverse of the membrane's second derivative.
  void precondition(const Eigen::VectorXd& v, Eigen::VectorXd& out) const;
  std::vector<Positions> rings_at(const Eigen::VectorXd& displacement) const;

 private:
  double gaussians(const std::vector<Positions>& x, std::vector<Positions>& gradient) const;
  double penalties(const std::vector<Positions>& x, std::vector<Positions>& gradient) const;

  std::vector<Positions> rest_;
  Index n_;
  double edge_ = 0;
  std::vector<StripTriangle> strip_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor_;
};

}  // namespace unsnarl
