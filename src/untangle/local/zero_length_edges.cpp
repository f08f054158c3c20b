#include "untangle/local/zero_length_edges.h"

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <vector>

namespace unsnarl {
namespace {

/// Added to the matrix, as a share of its diagonal: a component that lies wholly in one point stays (no unit)
constexpr double regularisation = 1e-9;

}  // namespace

void open_zero_length_edges(const Patch& patch, std::span<const Edge> edges, double share, Positions& x) {
  const auto is_free = [&](Index v) { return v < patch.free_count; };
  const auto has_no_length = [&](const Edge& e) { return x.col(e[0]) == x.col(e[1]); };
  std::vector<Index> number(static_cast<std::size_t>(x.cols()), -1), vertices;
  for (const Edge& e : edges) {
    if (!has_no_length(e)) continue;
    for (Index v : e)
      if (is_free(v) && number[v] < 0) {
        number[v] = static_cast<Index>(vertices.size());
        vertices.push_back(v);
      }
  }
  if (vertices.empty()) return;

  const auto n = static_cast<Index>(vertices.size());
  std::vector<double> degree(vertices.size(), 0);
  Eigen::MatrixX3d pull = Eigen::MatrixX3d::Zero(n, 3);
  std::vector<Eigen::Triplet<double>> entries;
  for (const Edge& e : edges) {
    for (const auto& [v, w] : {std::pair(e[0], e[1]), std::pair(e[1], e[0])}) {
      if (number[v] < 0) continue;
      degree[number[v]] += 1;
      pull.row(number[v]) += share * (x.col(w) - x.col(v)).transpose();
    }
    if (number[e[0]] >= 0 && number[e[1]] >= 0 && has_no_length(e)) {
      const auto [low, high] = std::minmax(number[e[0]], number[e[1]]);
      entries.emplace_back(high, low, -1);
    }
  }
  for (Index i = 0; i < n; ++i) entries.emplace_back(i, i, (1 + regularisation) * degree[i]);
  Eigen::SparseMatrix<double> matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(matrix);
  if (factor.info() != Eigen::Success) return;
  const Eigen::MatrixX3d displacement = factor.solve(pull);
  for (Index i = 0; i < n; ++i) x.col(vertices[i]) += displacement.row(i).transpose();
}

}  // namespace unsnarl
