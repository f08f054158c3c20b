#include "cotangent_laplacian.h"

#include <algorithm>
#include <vector>

#include "mesh/areas.h"

namespace unsnarl::peers {
namespace {

using Entries = std::vector<Eigen::Triplet<double>>;

SparseMatrix assembled(const Entries& entries, Index n) {
  SparseMatrix matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace

SparseMatrix cotangent_laplacian(const Positions& x, std::span<const Triangle> triangles) {
  constexpr double thinnest = 1e-8;  // height / longest side: cotangents stay below 1e8
  Entries entries;
  entries.reserve(12 * triangles.size());
  for (const Triangle& t : triangles) {
    const double double_area = area_vector(x, t).norm();
    double longest = 0;
    for (int k = 0; k < 3; ++k) longest = std::max(longest, (x.col(t[(k + 1) % 3]) - x.col(t[k])).squaredNorm());
    if (!(double_area > thinnest * longest)) continue;
    for (int k = 0; k < 3; ++k) {
      const Index i = t[(k + 1) % 3], j = t[(k + 2) % 3];
      const double half_cotangent = 0.5 * (x.col(i) - x.col(t[k])).dot(x.col(j) - x.col(t[k])) / double_area;
      entries.emplace_back(i, i, half_cotangent);
      entries.emplace_back(j, j, half_cotangent);
      entries.emplace_back(i, j, -half_cotangent);
      entries.emplace_back(j, i, -half_cotangent);
    }
  }
  return assembled(entries, static_cast<Index>(x.cols()));
}

SparseMatrix mass_matrix(const Positions& x, std::span<const Triangle> triangles) {
  Entries entries;
  entries.reserve(9 * triangles.size());
  for (const Triangle& t : triangles) {
    const double share = triangle_area(x, t) / 12;
    for (Index i : t)
      for (Index j : t) entries.emplace_back(i, j, i == j ? 2 * share : share);
  }
  return assembled(entries, static_cast<Index>(x.cols()));
}

}  // namespace unsnarl::peers
