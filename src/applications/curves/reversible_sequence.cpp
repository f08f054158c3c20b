#include "applications/curves/reversible_sequence.h"

#include "geometry/splitmix.h"

namespace unsnarl {

ReversibleSequence::ReversibleSequence(Index size) : nodes_(size) {
  for (Index k = 0; k < size; ++k) {
    nodes_[k].priority = splitmix_number((static_cast<std::uint64_t>(k) + 1) * splitmix_step);
    root_ = join(root_, k);
  }
}

Index ReversibleSequence::position_of(Index item) {
  settle_down_to(item);
  Index before = size_of(nodes_[item].left);
  for (Index node = item; nodes_[node].parent >= 0; node = nodes_[node].parent) {
    const Node& parent = nodes_[nodes_[node].parent];
    if (parent.right == node) before += size_of(parent.left) + 1;
  }
  return before;
}

bool ReversibleSequence::is_backwards(Index item) {
  settle_down_to(item);
  return nodes_[item].backwards;
}

void ReversibleSequence::reverse(Index first, Index count) {
  const auto [before, rest] = split(root_, first);
  const auto [part, after] = split(rest, count);
  turn(part);
  root_ = join(join(before, part), after);
}

void ReversibleSequence::remove(Index item) {
  const auto [before, rest] = split(root_, position_of(item));
  root_ = join(before, split(rest, 1).second);
}

std::vector<Index> ReversibleSequence::order() {
  std::vector<Index> items, above;
  Index node = root_;
  while (node >= 0 || !above.empty()) {
    for (; node >= 0; node = nodes_[node].left) {
      settle(node);
      above.push_back(node);
    }
    items.push_back(above.back());
    node = nodes_[above.back()].right;
    above.pop_back();
  }
  return items;
}

void ReversibleSequence::turn(Index tree) {
  if (tree >= 0) nodes_[tree].reversed = !nodes_[tree].reversed;
}

void ReversibleSequence::settle(Index node) {
  Node& n = nodes_[node];
  if (!n.reversed) return;
  std::swap(n.left, n.right);
  turn(n.left);
  turn(n.right);
  n.backwards = !n.backwards;
  n.reversed = false;
}

void ReversibleSequence::settle_down_to(Index node) {
  if (nodes_[node].parent >= 0) settle_down_to(nodes_[node].parent);
  settle(node);
}

void ReversibleSequence::update(Index node) {
  Node& n = nodes_[node];
  n.size = 1 + size_of(n.left) + size_of(n.right);
  for (const Index child : {n.left, n.right})
    if (child >= 0) nodes_[child].parent = node;
}

Index ReversibleSequence::join(Index left, Index right) {
  if (left < 0 || right < 0) {
    const Index root = left < 0 ? right : left;
    if (root >= 0) nodes_[root].parent = -1;
    return root;
  }
  const bool left_is_root = nodes_[left].priority > nodes_[right].priority;
  const Index root = left_is_root ? left : right;
  settle(root);
  if (left_is_root) {
    const Index joined = join(nodes_[left].right, right);
    nodes_[left].right = joined;
  } else {
    const Index joined = join(left, nodes_[right].left);
    nodes_[right].left = joined;
  }
  update(root);
  nodes_[root].parent = -1;
  return root;
}

std::pair<Index, Index> ReversibleSequence::split(Index tree, Index count) {
  if (tree < 0) return {-1, -1};
  settle(tree);
  const Index before = size_of(nodes_[tree].left);
  if (count <= before) {
    const auto [first, rest] = split(nodes_[tree].left, count);
    nodes_[tree].left = rest;
    update(tree);
    nodes_[tree].parent = -1;
    if (first >= 0) nodes_[first].parent = -1;
    return {first, tree};
  }
  const auto [first, rest] = split(nodes_[tree].right, count - before - 1);
  nodes_[tree].right = first;
  update(tree);
  nodes_[tree].parent = -1;
  if (rest >= 0) nodes_[rest].parent = -1;
  return {tree, rest};
}

}  // namespace unsnarl
