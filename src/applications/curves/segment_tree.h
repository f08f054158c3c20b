#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

#include "applications/curves/curve_net.h"

namespace unsnarl {

/// Boxes around runs of consecutive segments, as a binary tree over their order along the curves. Neighbours along a
/// curve are near in the plane, so that the tree needs no sorting and is refitted in one pass.
class SegmentTree {
 public:
  explicit SegmentTree(const CurveNet& net) : net_(&net) {
    const Index leaves = std::max(Index{1}, (net.segment_count() + run - 1) / run);
    while (first_leaf_ < leaves) first_leaf_ *= 2;
    boxes_.resize(2 * static_cast<std::size_t>(first_leaf_));
  }

  void refit(const Points2& x) {
    for (Index leaf = 0; leaf < first_leaf_; ++leaf) fit_leaf(x, leaf);
    for (Index node = first_leaf_ - 1; node > 0; --node) join_children(node);
  }

  /// The same where only the ends of the segments from `first` to `last` have moved since.
  void refit(const Points2& x, Index first, Index last) {
    Index low = first / run, high = last / run;
    for (Index leaf = low; leaf <= high; ++leaf) fit_leaf(x, leaf);
    for (low += first_leaf_, high += first_leaf_; low > 1;) {
      low /= 2;
      high /= 2;
      for (Index node = low; node <= high; ++node) join_children(node);
    }
  }

  /// Calls visit(i, j), i < j, once for each pair of segments whose boxes (of runs) are no farther apart than
  /// `distance` in x and in y.
  template <class Visit>
  void pairs_within(double distance, Visit&& visit) const {
    within(1, distance, visit);
  }
  /// Calls visit(j) for the segments near a box, in ascending order.
  template <class Visit>
  void near(const Vec2& low, const Vec2& high, Visit&& visit) const {
    Box box;
    box.add(low);
    box.add(high);
    near(1, box, visit);
  }

 private:
  static constexpr Index run = 4;  ///< A leaf of the tree holds this many segments (unit: segments)

  struct Box {
    Vec2 low = Vec2::Constant(std::numeric_limits<double>::infinity()), high = -low;
    void add(const Vec2& p) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    void add(const Box& other) {
      low = low.cwiseMin(other.low);
      high = high.cwiseMax(other.high);
    }
    bool is_near(const Box& other, double distance) const {
      return low.x() <= other.high.x() + distance && other.low.x() <= high.x() + distance &&
             low.y() <= other.high.y() + distance && other.low.y() <= high.y() + distance;
    }
  };

  void fit_leaf(const Points2& x, Index leaf) {
    Box box;
    for (Index s = leaf * run; s < std::min((leaf + 1) * run, net_->segment_count()); ++s)
      for (const Index v : net_->segments[s]) box.add(x.col(v));
    boxes_[first_leaf_ + leaf] = box;
  }
  void join_children(Index node) {
    boxes_[node] = boxes_[2 * node];
    boxes_[node].add(boxes_[2 * node + 1]);
  }

  template <class Visit>
  void within(Index node, double distance, Visit& visit) const {
    if (node >= first_leaf_) {
      const Index begin = (node - first_leaf_) * run, end = std::min(begin + run, net_->segment_count());
      for (Index i = begin; i < end; ++i)
        for (Index j = i + 1; j < end; ++j) visit(i, j);
      return;
    }
    within(2 * node, distance, visit);
    within(2 * node + 1, distance, visit);
    between(2 * node, 2 * node + 1, distance, visit);
  }
  /// a before b along the curves, at the same height of the tree.
  template <class Visit>
  void between(Index a, Index b, double distance, Visit& visit) const {
    if (!boxes_[a].is_near(boxes_[b], distance)) return;
    if (a >= first_leaf_) {
      const Index end_a = std::min((a - first_leaf_ + 1) * run, net_->segment_count());
      const Index end_b = std::min((b - first_leaf_ + 1) * run, net_->segment_count());
      for (Index i = (a - first_leaf_) * run; i < end_a; ++i)
        for (Index j = (b - first_leaf_) * run; j < end_b; ++j) visit(i, j);
      return;
    }
    for (const Index i : {2 * a, 2 * a + 1})
      for (const Index j : {2 * b, 2 * b + 1}) between(i, j, distance, visit);
  }
  template <class Visit>
  void near(Index node, const Box& box, Visit& visit) const {
    if (!boxes_[node].is_near(box, 0)) return;
    if (node >= first_leaf_) {
      const Index begin = (node - first_leaf_) * run, end = std::min(begin + run, net_->segment_count());
      for (Index i = begin; i < end; ++i) visit(i);
      return;
    }
    near(2 * node, box, visit);
    near(2 * node + 1, box, visit);
  }

  const CurveNet* net_;
  Index first_leaf_ = 1;
  std::vector<Box> boxes_;  // the root is 1, the children of k are 2 k and 2 k + 1
};

}  // namespace unsnarl
