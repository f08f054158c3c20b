#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/types.h"

namespace unsnarl {

/// Which parts of a surface pass through each other, or through themselves.
class PassingParts {
 public:
  /// None does.
  PassingParts() = default;
  /// Those of these pairs do, either way round; all numbers are below `count`.
  PassingParts(Index count, std::span<const std::array<Index, 2>> pairs)
      : count_(static_cast<std::size_t>(count)), passes_(count_ * count_, 0) {
    for (const auto [p, q] : pairs) at(p, q) = at(q, p) = 1;
  }

  bool pass(Index p, Index q) const { return passes_[static_cast<std::size_t>(p) * count_ + q] != 0; }

 private:
  std::uint8_t& at(Index p, Index q) { return passes_[static_cast<std::size_t>(p) * count_ + q]; }

  std::size_t count_ = 0;
  std::vector<std::uint8_t> passes_;  // of each pair
};

/// Which triangles of a set pass through each other: such pairs are not looked for. What it is made of must outlive it.
class Passing {
 public:
  /// None do.
  Passing() = default;
  /// Those of vertices of different groups do; no triangle has vertices of two. Empty: all are of one.
  explicit Passing(std::span<const Index> group_of_vertex) : group_of_(group_of_vertex) {}
  /// So do those of parts that pass through each other. `part_of_triangle`: empty: no triangle is of such a part.
  Passing(std::span<const Index> group_of_vertex, std::span<const Index> part_of_triangle, const PassingParts& parts)
      : group_of_(group_of_vertex), part_of_(part_of_triangle), parts_(&parts) {}

  /// The same the other way round: finders look only for pairs of parts that pass through each other.
  Passing only_what_passes() const {
    Passing inverse = *this;
    inverse.is_looked_for_ = true;
    return inverse;
  }

  bool meet(std::span<const Triangle> triangles, Index t, Index u) const {
    if (!group_of_.empty() && group_of_[triangles[t][0]] != group_of_[triangles[u][0]]) return false;
    return part_of_.empty() || parts_->pass(part_of_[t], part_of_[u]) == is_looked_for_;
  }
  /// There are triangles of one group that pass through each other.
  bool has_parts() const { return !part_of_.empty(); }

 private:
  std::span<const Index> group_of_;
  std::span<const Index> part_of_;
  const PassingParts* parts_ = nullptr;
  bool is_looked_for_ = false;  // what passes
};

}  // namespace unsnarl
