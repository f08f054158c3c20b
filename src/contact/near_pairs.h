#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "contact/bvh.h"
#include "contact/vertex_groups.h"
#include "geometry/types.h"

namespace unsnarl {

/// Lists the pairs of triangles near each other, but for those that share a vertex, on a surface that moves a little at
/// a time. Every triangle's box has some room around it, by how fast it moves; only the pairs of those that have left
/// theirs are looked for anew.
class NearPairs {
 public:
  using Pair = std::array<Index, 2>;  // ascending

  /// Pairs of two triangles >= active_count are left out, and those of two groups (VertexGroups). The spans must
  /// outlive this.
  NearPairs(std::span<const Triangle> triangles, Index active_count, VertexGroups groups = {})
      : triangles_(triangles), active_count_(active_count), groups_(groups) {}

  /// Takes over the positions: from now on all pairs are listed whose boxes overlap, each once, and others a little
  /// farther apart. The order is a function of all positions up to now.
  void update(const Positions& x);
  std::span<const Pair> pairs() const { return pairs_; }
  /// Whether the boxes of two triangles overlap at the positions; of a few that do not too.
  bool overlap(Index a, Index b) const { return rounded_[a].overlaps(rounded_[b]); }

 private:
  bool is_wanted(Index a, Index b) const;
  void look_for_all();
  void look_for_those_that_left();

  std::span<const Triangle> triangles_;
  Index active_count_;
  VertexGroups groups_;
  double length_ = 0;                // mean diagonal of the boxes
  std::vector<Box> boxes_, padded_;  // now; with room, when their triangle last left it
  std::vector<RoundedBox> rounded_;  // as they are now
  std::vector<std::uint8_t> left_;   // per triangle: has left its box
  Bvh bvh_;                          // of the roomy ones
  std::vector<Pair> pairs_;
};

}  // namespace unsnarl
