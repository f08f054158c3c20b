#include "energy/gaussian_contact.h"

#include <algorithm>
#include <cstdint>

namespace unsnarl {
namespace {

constexpr double largest_cell = 4e18;  ///< Numbers of cells stay below 2^62 (fixed by int64)

/// Sorts pairs of numbers below n: by the first ones as it deals them out, by the few second ones of each.
void sort_pairs(Index n, std::vector<std::array<Index, 2>>& pairs) {
  std::vector<std::size_t> begin(static_cast<std::size_t>(n) + 1, 0);
  for (const auto& pair : pairs) ++begin[pair[0] + 1];
  for (Index i = 0; i < n; ++i) begin[i + 1] += begin[i];
  std::vector<std::array<Index, 2>> dealt(pairs.size());
  std::vector<std::size_t> end(begin.begin(), begin.end() - 1);
  for (const auto& pair : pairs) dealt[end[pair[0]]++] = pair;
  for (Index i = 0; i < n; ++i)
    std::sort(dealt.begin() + static_cast<std::ptrdiff_t>(begin[i]),
              dealt.begin() + static_cast<std::ptrdiff_t>(end[i]));
  pairs.swap(dealt);
}

}  // namespace

template <int Dim>
std::vector<std::array<Index, 2>> pairs_within(const Eigen::Matrix<double, Dim, Eigen::Dynamic>& x, double cutoff) {
  using Cell = std::array<std::int64_t, Dim>;
  const Index n = static_cast<Index>(x.cols());
  std::vector<std::array<Index, 2>> pairs;
  if (n < 2 || !(cutoff > 0)) return pairs;
  // Cells as wide as the cutoff: neighbours lie in the same or an adjacent one. Coordinates far beyond 2^62 cells are
  // not met: they would mean a cutoff below the rounding of the positions.
  const Eigen::Matrix<double, Dim, 1> origin = x.rowwise().minCoeff();
  std::vector<std::pair<Cell, Index>> sorted(n);
  for (Index i = 0; i < n; ++i) {
    for (int d = 0; d < Dim; ++d) {
      sorted[i].first[d] =
          static_cast<std::int64_t>(std::min(std::floor((x(d, i) - origin[d]) / cutoff), largest_cell));
    }
    sorted[i].second = i;
  }
  std::sort(sorted.begin(), sorted.end());
  const double squared = cutoff * cutoff;
  const auto before = [](const std::pair<Cell, Index>& p, const Cell& cell) { return p.first < cell; };
  int offsets = 1;
  for (int d = 0; d + 1 < Dim; ++d) offsets *= 3;
  for (std::size_t k = 0; k < sorted.size(); ++k) {
    const auto& [cell, i] = sorted[k];
    // The last coordinate runs fastest in the order, so its three cells are one stretch.
    for (int code = 0; code < offsets; ++code) {
      Cell from = cell;
      for (int d = 0, rest = code; d + 1 < Dim; ++d, rest /= 3) from[d] += rest % 3 - 1;
      Cell to = from;
      from[Dim - 1] -= 1;
      to[Dim - 1] += 1;
      if (to < cell) continue;  // every pair is found from its earlier cell
      auto it = std::lower_bound(sorted.begin(), sorted.end(), from, before);
      for (; it != sorted.end() && it->first <= to; ++it) {
        if (static_cast<std::size_t>(it - sorted.begin()) <= k) continue;
        const Index j = it->second;
        if ((x.col(i) - x.col(j)).squaredNorm() <= squared) pairs.push_back({std::min(i, j), std::max(i, j)});
      }
    }
  }
  sort_pairs(n, pairs);
  return pairs;
}

template std::vector<std::array<Index, 2>> pairs_within<2>(const Eigen::Matrix<double, 2, Eigen::Dynamic>&, double);
template std::vector<std::array<Index, 2>> pairs_within<3>(const Eigen::Matrix<double, 3, Eigen::Dynamic>&, double);
template std::vector<std::array<Index, 2>> pairs_within<4>(const Eigen::Matrix<double, 4, Eigen::Dynamic>&, double);

}  // namespace unsnarl
