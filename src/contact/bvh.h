#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "contact/four_boxes.h"
#include "geometry/box.h"
#include "geometry/types.h"

namespace unsnarl {

/// Bounding volume hierarchy over axis-aligned boxes: built once, refitted while the boxes move.
class Bvh {
 public:
  Bvh() = default;
  explicit Bvh(std::span<const Box> boxes) { build(boxes); }

  void build(std::span<const Box> boxes);
  /// Same number of boxes as at the last build, moved. The tree's shape is kept.
  void refit(std::span<const Box> boxes);
  /// The same where only these have moved (ids, each once): at a cost that follows their number.
  void refit(std::span<const Box> boxes, std::span<const Index> moved);

  /// From now on self_pairs() visits only pairs of which at least one box is active (one flag a box); until the next
  /// build. Where few are, most of the tree is skipped.
  void set_active(std::span<const std::uint8_t> active);
  /// The same for the boxes with these ids (each once), at a cost that follows their number and that of those before.
  void set_only_active(std::span<const Index> active);

  Index size() const { return static_cast<Index>(order_.size()); }

  /// Calls visit(Index) for every box that overlaps `box`, in the order of the tree (a function of the boxes alone).
  template <class Visit>
  void query(const Box& box, Visit&& visit) const;
  /// Whether accept(Index) is true of any box that overlaps `box`; asks no more once it is.
  template <class Accept>
  bool find(const Box& box, Accept&& accept) const;
  /// Whether any box overlaps `box`.
  bool overlaps_any(const Box& box) const;

  /// Calls visit(i, j), i != j, once for every unordered pair of (active) boxes that overlap; order within a pair
  /// and among pairs is a function of the boxes alone.
  template <class Visit>
  void self_pairs(Visit&& visit) const;

  /// The same pairs in parallel: `visit(task, i, j)`, where the tasks [0, task_count()) partition the pairs in a fixed
  /// way; collect per task and concatenate in order for results that do not depend on the number of threads.
  template <class Visit>
  void self_pairs_parallel(Visit&& visit) const;
  Index task_count() const { return static_cast<Index>(tasks_.size()); }

 private:
  static constexpr Index leaf_size = 4;  ///< A leaf holds at most this many boxes [E174] (unit: boxes)
  struct Node {
    RoundedBox box;
    Index begin = 0, end = 0;  // boxes order_[begin, end) below it
    Index right = 0;           // left child is the next node; of a leaf its number, as -1 - number
    bool active = true;        // a box below it is
    bool is_leaf() const { return right < 0; }
    Index leaf() const { return -1 - right; }
  };
  Index build_node(Index begin, Index end);
  void fit(Node& node);
  void flag(Node& node);
  /// Where these boxes are among the leaves, ascending.
  std::vector<Index> places_of(std::span<const Index> boxes);
  /// Calls visit(Node&) for all nodes above these places, children before their parent.
  template <class Visit>
  void visit_above(std::span<const Index> places, Visit&& visit, Index node = 0);
  /// Visits the pairs of box i, of leaf a, with those boxes of leaf b whose bits are set.
  template <class Visit>
  void pairs_with(Index i, unsigned bits, const Node& b, Visit& visit) const;
  template <class Visit>
  void pairs_within(Index node, Visit& visit) const;
  template <class Visit>
  void pairs_between(Index a, Index b, Visit& visit) const;

  std::vector<Node> nodes_;
  std::vector<Index> order_;          // leaf position -> box id
  std::vector<Index> place_;          // box id -> leaf position; empty until it is needed
  std::vector<Box> boxes_;            // in leaf order
  std::vector<FourBoxes> leaves_;     // the same, a leaf side by side
  std::vector<std::uint8_t> active_;  // in leaf order
  std::vector<Index> only_active_;    // leaf positions, ascending; where set_only_active() was the last to say
  bool has_only_active_ = false;
  std::vector<std::pair<Index, Index>> tasks_;
};

}  // namespace unsnarl

#include "contact/bvh_traversal.h"
