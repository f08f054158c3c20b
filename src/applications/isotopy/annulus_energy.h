#pragma once

#include <Eigen/SparseCholesky>
#include <vector>

#include "applications/curves/segment_tree.h"
#include "applications/isotopy/rings.h"

namespace unsnarl {

/// An energy that untangles annuli in space whose rings keep their heights, in terms of the displacement of the rings
/// between the first and the last (paper §3.3 and §4.5): a sum, without unit, of
/// - the Gaussian self-contact energy of the points of each ring, exp(-|p - q|^2 / range^2);
/// - the Minkowski penalty (paper §3.2) of the segments of each ring, which are the annuli's cuts at its height: as
///   points move sideways only, triangles are parted where their cuts are;
/// - the squares of what edges of the annuli's grid have changed by.
/// Lengths are those of the mean edge.
class AnnulusEnergy {
 public:
  explicit AnnulusEnergy(std::vector<Polygons> rings);

  double range = 4;        ///< Range of the Gaussian (unit: mean edges)
  double gaussian = 0.05;  ///< Weight of the Gaussian energy (no unit)
  double penalty = 1;      ///< Weight of the penalty of segments (no unit)
  double membrane = 0.05;  ///< Weight of the changes of edges (no unit)
  double overshoot = 0.1;  ///< Segments count as this much deeper than they are, so that they part (unit: mean edges)

  /// 2 numbers a point of the rings between.
  Eigen::Index size() const { return 2 * n_ * (static_cast<Eigen::Index>(rest_.size()) - 2); }
  double operator()(const Eigen::VectorXd& displacement, Eigen::VectorXd& gradient);
  /// Applies the inverse of the membrane's second derivative.
  void precondition(const Eigen::VectorXd& v, Eigen::VectorXd& out) const;
  std::vector<Polygons> rings_at(const Eigen::VectorXd& displacement) const;

 private:
  double gaussians(const Points2& x, Points2& gradient) const;
  double penalties(const Points2& x, Points2& gradient);

  std::vector<Points2> rest_;  // the polygons of a ring one after the other
  std::vector<Index> first_;   // of each polygon, and the number of all points
  CurveNet net_;               // of a ring
  SegmentTree tree_;
  Index n_ = 0;
  double edge_ = 0;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor_;
};

}  // namespace unsnarl
