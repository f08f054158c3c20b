#include "mesh/position_classes.h"

#include <array>
#include <cmath>

#include "geometry/bit_cast.h"
#include "mesh/id_table.h"
#include "mesh/union_find.h"

namespace unsnarl {
namespace {

std::vector<Index> exact_classes(std::span<const double> positions) {
  const std::size_t n = positions.size() / 3;
  std::vector<Index> class_of(n), first;
  IdTable table(n);
  for (std::size_t v = 0; v < n; ++v) {
    const double* p = &positions[3 * v];
    // Adding 0.0 turns -0.0 into 0.0, so that equal numbers have equal bits.
    const std::uint64_t hash = hash_of(bit_cast<std::uint64_t>(p[0] + 0.0), bit_cast<std::uint64_t>(p[1] + 0.0),
                                       bit_cast<std::uint64_t>(p[2] + 0.0));
    const Index found = table.find_or_add(hash, static_cast<Index>(first.size()), [&](Index id) {
      const double* q = &positions[3 * static_cast<std::size_t>(first[id])];
      return p[0] == q[0] && p[1] == q[1] && p[2] == q[2];
    });
    class_of[v] = found >= 0 ? found : static_cast<Index>(first.size());
    if (found < 0) first.push_back(static_cast<Index>(v));
  }
  return class_of;
}

/// Distinct positions in cells as wide as the tolerance; each is compared with those of the 27 cells around it.
std::vector<Index> tolerant_classes(std::span<const double> positions, double tolerance) {
  const std::vector<Index> exact = exact_classes(positions);
  std::vector<Index> first;
  for (std::size_t v = 0; v < exact.size(); ++v)
    if (exact[v] == static_cast<Index>(first.size())) first.push_back(static_cast<Index>(v));

  using Cell = std::array<double, 3>;  // whole numbers; doubles, since the quotient may exceed any integer type
  const auto cell_of = [&](Index id) {
    const double* p = &positions[3 * static_cast<std::size_t>(first[id])];
    return Cell{std::floor(p[0] / tolerance) + 0.0, std::floor(p[1] / tolerance) + 0.0,
                std::floor(p[2] / tolerance) + 0.0};
  };
  const auto hash_cell = [](const Cell& c) {
    return hash_of(bit_cast<std::uint64_t>(c[0]), bit_cast<std::uint64_t>(c[1]), bit_cast<std::uint64_t>(c[2]));
  };
  std::vector<Cell> cells(first.size());
  std::vector<Index> next_in_cell(first.size(), -1);  // the table holds the first of each cell
  IdTable table(first.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    cells[i] = cell_of(static_cast<Index>(i));
    const Index head =
        table.find_or_add(hash_cell(cells[i]), static_cast<Index>(i), [&](Index id) { return cells[id] == cells[i]; });
    if (head >= 0) {
      next_in_cell[i] = next_in_cell[head];
      next_in_cell[head] = static_cast<Index>(i);
    }
  }

  UnionFind sets(exact.size());
  for (std::size_t v = 0; v < exact.size(); ++v) sets.unite(first[exact[v]], static_cast<Index>(v));
  const double squared_tolerance = tolerance * tolerance;
  for (std::size_t i = 0; i < first.size(); ++i) {
    const double* p = &positions[3 * static_cast<std::size_t>(first[i])];
    for (int neighbour = 0; neighbour < 27; ++neighbour) {
      const Cell cell = {cells[i][0] + neighbour % 3 - 1 + 0.0, cells[i][1] + neighbour / 3 % 3 - 1 + 0.0,
                         cells[i][2] + neighbour / 9 - 1 + 0.0};
      Index j = table.find(hash_cell(cell), [&](Index id) { return cells[id] == cell; });
      for (; j >= 0; j = next_in_cell[j]) {
        if (j >= static_cast<Index>(i)) continue;
        const double* q = &positions[3 * static_cast<std::size_t>(first[j])];
        const double dx = p[0] - q[0], dy = p[1] - q[1], dz = p[2] - q[2];
        if (dx * dx + dy * dy + dz * dz <= squared_tolerance) sets.unite(first[i], first[j]);
      }
    }
  }
  return sets.dense_ids();
}

}  // namespace

std::vector<Index> position_classes(std::span<const double> positions, double tolerance) {
  return tolerance > 0 ? tolerant_classes(positions, tolerance) : exact_classes(positions);
}

}  // namespace unsnarl
