#include "untangle/local/smoothing_metric.h"

#include <numbers>
#include <vector>

#include "geometry/parallel.h"
#include "mesh/areas.h"

namespace unsnarl {
namespace {

/// Cotangent weight of an edge of an equilateral mesh, without unit; the same for all edges, so that slivers do no
/// harm.
constexpr double laplacian_weight = std::numbers::inv_sqrt3;

}  // namespace

SmoothingMetric::SmoothingMetric(const Patch& patch, const EdgeTable& edges, double range)
    : free_count_(patch.free_count) {
  const Index n = free_count_;
  std::vector<double> diagonal(n, 0);
  for (Index t = 0; t < patch.active_count; ++t) {
    const double share = triangle_area(patch.x, patch.triangles[t]) / 3;
    for (const Index v : patch.triangles[t])
      if (v < n) diagonal[v] += share / (range * range);
  }
  std::vector<Eigen::Triplet<double>> entries;
  for (const auto& [u, v] : edges.edges) {
    if (u < n) diagonal[u] += laplacian_weight;
    if (v < n) diagonal[v] += laplacian_weight;
    if (u < n && v < n) entries.emplace_back(v, u, -laplacian_weight);  // lower triangle, u < v
  }
  for (Index v = 0; v < n; ++v) entries.emplace_back(v, v, diagonal[v] > 0 ? diagonal[v] : 1);
  Eigen::SparseMatrix<double> matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  factor_.compute(matrix);
}

Eigen::MatrixX3d SmoothingMetric::solve(const Positions& force) const {
  Eigen::MatrixX3d direction(free_count_, 3);
  parallel_for(3, [&](int k) {
    direction.col(k) = factor_.solve(Eigen::VectorXd(force.row(k).leftCols(free_count_).transpose()));
  });
  return direction;
}

}  // namespace unsnarl
