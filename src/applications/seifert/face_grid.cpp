#include <algorithm>
#include <cmath>

#include "applications/seifert/embedded_mesh.h"

namespace unsnarl {
namespace {

/// Cells along one axis, at most, which bounds the memory of the grid (unit: cells)
constexpr int most_cells = 96;

}  // namespace

FaceGrid::FaceGrid(const Vec3& lo, const Vec3& hi, double cell)
    : lo_(lo), cell_(std::max(cell, (hi - lo).maxCoeff() / most_cells)) {
  for (int k = 0; k < 3; ++k) count_[k] = 1 + static_cast<int>((hi[k] - lo[k]) / cell_);
  cells_.resize(std::size_t(count_[0]) * count_[1] * count_[2]);
}

FaceGrid::Range FaceGrid::range(const Vec3& lo, const Vec3& hi) const {
  Range r;
  for (int k = 0; k < 3; ++k) {
    r[k] = static_cast<int>(std::clamp(std::floor((lo[k] - lo_[k]) / cell_), 0.0, count_[k] - 1.0));
    r[k + 3] = static_cast<int>(std::clamp(std::floor((hi[k] - lo_[k]) / cell_), 0.0, count_[k] - 1.0));
  }
  return r;
}

void FaceGrid::insert(Index face, const Vec3& lo, const Vec3& hi) {
  if (static_cast<std::size_t>(face) >= range_of_.size()) {
    range_of_.resize(face + 1);
    seen_.resize(face + 1, 0);
  }
  range_of_[face] = range(lo, hi);
  for_cells(range_of_[face], [&](std::vector<Index>& cell) { cell.push_back(face); });
}

void FaceGrid::remove(Index face) {
  for_cells(range_of_[face], [&](std::vector<Index>& cell) {
    const auto at = std::find(cell.begin(), cell.end(), face);
    *at = cell.back();
    cell.pop_back();
  });
}

}  // namespace unsnarl
