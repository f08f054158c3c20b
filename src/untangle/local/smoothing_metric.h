#pragma once

#include <Eigen/SparseCholesky>

#include "mesh/adjacency.h"
#include "scene/patch.h"

namespace unsnarl {

/// The metric in which local strategies take their directions, so that these are smooth: Laplacian + area / range^2 on
/// the free vertices, the others held.
class SmoothingMetric {
 public:
  /// Of patch.x. `range`: a length.
  SmoothingMetric(const Patch& patch, const EdgeTable& edges, double range);
  /// False: it could not be factored.
  bool ok() const { return factor_.info() == Eigen::Success; }
  /// The direction of a force on the patch's vertices: a row for each free vertex.
  Eigen::MatrixX3d solve(const Positions& force) const;

 private:
  Index free_count_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor_;
};

}  // namespace unsnarl
