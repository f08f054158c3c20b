#pragma once

#include <utility>
#include <vector>

#include "geometry/types.h"

namespace unsnarl {

/// The numbers from 0 up to a size, in an order of which parts are reversed, each in logarithmic time: a treap (Seidel,
/// Aragon 1996) that marks the subtrees that stand reversed.
class ReversibleSequence {
 public:
  explicit ReversibleSequence(Index size);

  /// How many items stand before this one.
  Index position_of(Index item);
  /// Whether an odd number of reversals took it along.
  bool is_backwards(Index item);
  /// Reverses the order of `count` items from a position on.
  void reverse(Index first, Index count);
  void remove(Index item);
  std::vector<Index> order();

 private:
  struct Node {
    Index left = -1, right = -1, parent = -1, size = 1;
    double priority = 0;
    bool backwards = false;
    bool reversed = false;  ///< the subtree with this root: its marks and its order are yet to be turned around
  };

  Index size_of(Index tree) const { return tree < 0 ? 0 : nodes_[tree].size; }
  void turn(Index tree);
  /// Carries out what is marked at a node, and marks its children instead.
  void settle(Index node);
  void settle_down_to(Index node);
  void update(Index node);
  Index join(Index left, Index right);
  /// The first `count` items of a tree, and the others.
  std::pair<Index, Index> split(Index tree, Index count);

  std::vector<Node> nodes_;
  Index root_ = -1;
};

}  // namespace unsnarl
