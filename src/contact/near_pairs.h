#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "contact/bvh.h"
#include "contact/passing.h"
#include "geometry/types.h"

namespace unsnarl {

/// Lists the pairs of triangles that are near each other and share no vertex, on a surface that moves a little at a
/// time. Every triangle's box is enlarged according to its speed; only triangles that left their enlarged boxes are
/// looked up again.
class NearPairs {
 public:
  using Pair = std::array<Index, 2>;  // ascending

  /// Pairs of two triangles >= active_count are left out, and those that pass through each other. The span must outlive
  /// this.
  NearPairs(std::span<const Triangle> triangles, Index active_count, Passing passing = {})
      : triangles_(triangles), active_count_(active_count), passing_(passing) {}

  /// Takes over the positions. The list then holds every pair whose boxes overlap, each once, and some pairs that are a
  /// little farther apart. Its order depends on all positions so far.
  void update(const Positions& x);
  std::span<const Pair> pairs() const { return pairs_; }
  /// Whether the boxes of two triangles overlap at the positions. May be true for a few that do not.
  bool overlap(Index a, Index b) const { return rounded_[a].overlaps(rounded_[b]); }

 private:
  bool is_wanted(Index a, Index b) const;
  void look_for_all();
  void look_for_those_that_left();

  std::span<const Triangle> triangles_;
  Index active_count_;
  Passing passing_;
  double length_ = 0;                // mean diagonal of the boxes
  std::vector<Box> boxes_, padded_;  // at the positions; enlarged, as of when the triangle last left it
  std::vector<RoundedBox> rounded_;  // the boxes at the positions
  std::vector<std::uint8_t> left_;   // per triangle: has left its box
  Bvh bvh_;                          // over the enlarged boxes
  std::vector<Pair> pairs_;
};

}  // namespace unsnarl
