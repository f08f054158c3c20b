#pragma once

#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "geometry/types.h"

namespace unsnarl {

/// Disjoint sets of 0 .. n - 1. The root of a set is its smallest member, whatever the order of the unions.
class UnionFind {
 public:
  explicit UnionFind(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), Index{0}); }

  /// A new member, in a set of its own. Returns it: the largest one.
  Index add() {
    parent_.push_back(static_cast<Index>(parent_.size()));
    return parent_.back();
  }
  std::size_t size() const { return parent_.size(); }

  Index find(Index i) {
    while (parent_[i] != i) {
      parent_[i] = parent_[parent_[i]];
      i = parent_[i];
    }
    return i;
  }
  /// False where both were in one set already.
  bool unite(Index i, Index j) {
    i = find(i);
    j = find(j);
    if (i == j) return false;
    if (j < i) std::swap(i, j);
    parent_[j] = i;
    return true;
  }

  /// The set of each member, numbered in the order of first occurrence.
  std::vector<Index> dense_ids() {
    std::vector<Index> id(parent_.size(), -1);
    Index count = 0;
    for (std::size_t i = 0; i < id.size(); ++i) {
      const Index root = find(static_cast<Index>(i));
      id[i] = root == static_cast<Index>(i) ? count++ : id[root];
    }
    return id;
  }

 private:
  std::vector<Index> parent_;
};

/// Vertices 0 .. vertex_count - 1, those of each triangle in one set.
inline UnionFind vertices_joined_by(std::span<const Triangle> triangles, Index vertex_count) {
  UnionFind sets(static_cast<std::size_t>(vertex_count));
  for (const Triangle& t : triangles) {
    sets.unite(t[0], t[1]);
    sets.unite(t[0], t[2]);
  }
  return sets;
}

}  // namespace unsnarl
