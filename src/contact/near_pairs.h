#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "contact/bvh.h"
#include "contact/motion_frames.h"
#include "contact/passing.h"
#include "geometry/types.h"

namespace unsnarl {

/// Lists the pairs of triangles that are near each other and share no vertex, on a surface that moves a little at a
/// time. Every triangle's box is enlarged according to its speed; only triangles that left their enlarged boxes are
/// looked up again.
class NearPairs {
 public:
  struct Pair {
    Index a, b;                              ///< ascending
    MotionFrames::Clearance clearance = {};  ///< the caller's; nothing known where the pair is new
    /// Same triangles.
    friend bool operator==(const Pair& p, const Pair& q) { return p.a == q.a && p.b == q.b; }
    friend bool operator<(const Pair& p, const Pair& q) { return p.a != q.a ? p.a < q.a : p.b < q.b; }
  };

  /// Pairs of two triangles >= active_count are left out, and those that pass through each other. The span must outlive
  /// this.
  NearPairs(std::span<const Triangle> triangles, Index active_count, Passing passing = {})
      : triangles_(triangles), active_count_(active_count), passing_(passing) {}

  /// Takes over the positions. The list then holds every pair whose boxes overlap, each once, and some pairs that are a
  /// little farther apart. Its order depends on all positions so far.
  void update(const Positions& x);
  std::span<Pair> pairs() { return pairs_; }
  /// Whether the boxes of two triangles overlap at the positions.
  bool overlap(Index a, Index b) const { return boxes_[a].overlaps(boxes_[b]); }
  /// How far apart these boxes are along a coordinate axis, at most; not above 0 where they overlap.
  double gap(Index a, Index b) const {
    return std::max((boxes_[a].lo - boxes_[b].hi).maxCoeff(), (boxes_[b].lo - boxes_[a].hi).maxCoeff());
  }

 private:
  bool is_wanted(Index a, Index b) const;
  void look_for_all();
  void look_for_those_that_left();

  std::span<const Triangle> triangles_;
  Index active_count_;
  Passing passing_;
  double length_ = 0;                // mean diagonal of the boxes
  std::vector<Box> boxes_, padded_;  // at the positions; enlarged, as of when the triangle last left it
  std::vector<std::uint8_t> left_;   // per triangle: has left its box
  Bvh bvh_;                          // over the enlarged boxes
  std::vector<Pair> pairs_;
};

}  // namespace unsnarl
