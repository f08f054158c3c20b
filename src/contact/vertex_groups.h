#pragma once

#include <span>

#include "geometry/types.h"

namespace unsnarl {

/// Groups of vertices whose triangles pass through those of other groups: such pairs are not looked for. No triangle
/// has vertices of two groups.
class VertexGroups {
 public:
  /// All vertices are of one group.
  VertexGroups() = default;
  /// The group of each vertex; empty: all are of one. The span must outlive this.
  explicit VertexGroups(std::span<const Index> group_of) : group_of_(group_of) {}

  bool meet(const Triangle& a, const Triangle& b) const {
    return group_of_.empty() || group_of_[a[0]] == group_of_[b[0]];
  }

 private:
  std::span<const Index> group_of_;
};

}  // namespace unsnarl
