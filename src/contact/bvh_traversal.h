#pragma once

#include <bit>

#include "contact/bvh.h"
#include "geometry/parallel.h"

namespace unsnarl {

template <class Accept>
bool Bvh::find(const Box& box, Accept&& accept) const {
  if (nodes_.empty()) return false;
  const RoundedBox rounded(box);
  std::array<Index, 64> stack;  // depth is at most log2(2^31) + 1
  int top = 0;
  stack[top++] = 0;
  while (top > 0) {
    const Index id = stack[--top];
    const Node& node = nodes_[id];
    if (!node.box.overlaps(rounded)) continue;
    if (node.is_leaf()) {
      for (unsigned bits = leaves_[node.leaf()].overlapping(rounded); bits != 0; bits &= bits - 1) {
        const Index k = node.begin + std::countr_zero(bits);
        if (k < node.end && boxes_[k].overlaps(box) && accept(order_[k])) return true;
      }
    } else {
      stack[top++] = node.right;
      stack[top++] = id + 1;
    }
  }
  return false;
}

template <class Visit>
void Bvh::query(const Box& box, Visit&& visit) const {
  find(box, [&](Index i) {
    visit(i);
    return false;
  });
}

template <class Visit>
void Bvh::pairs_with(Index i, unsigned bits, const Node& b, Visit& visit) const {
  for (; bits != 0; bits &= bits - 1) {
    const Index j = b.begin + std::countr_zero(bits);
    if (j < b.end && (active_[i] || active_[j]) && boxes_[i].overlaps(boxes_[j])) visit(order_[i], order_[j]);
  }
}

template <class Visit>
void Bvh::pairs_between(Index a, Index b, Visit& visit) const {
  const Node &node_a = nodes_[a], &node_b = nodes_[b];
  if (!(node_a.active || node_b.active) || !node_a.box.overlaps(node_b.box)) return;
  if (node_a.is_leaf() && node_b.is_leaf()) {
    const FourBoxes &boxes_a = leaves_[node_a.leaf()], &boxes_b = leaves_[node_b.leaf()];
    for (Index i = node_a.begin; i < node_a.end; ++i)
      pairs_with(i, boxes_b.overlapping(boxes_a, i - node_a.begin), node_b, visit);
  } else if (node_b.is_leaf() || (!node_a.is_leaf() && node_a.end - node_a.begin >= node_b.end - node_b.begin)) {
    pairs_between(a + 1, b, visit);
    pairs_between(node_a.right, b, visit);
  } else {
    pairs_between(a, b + 1, visit);
    pairs_between(a, node_b.right, visit);
  }
}

template <class Visit>
void Bvh::pairs_within(Index id, Visit& visit) const {
  const Node& node = nodes_[id];
  if (!node.active) return;
  if (node.is_leaf()) {
    const FourBoxes& boxes = leaves_[node.leaf()];
    for (Index i = node.begin; i < node.end; ++i) {
      const Index k = i - node.begin;
      pairs_with(i, boxes.overlapping(boxes, k) & (~1u << k), node, visit);
    }
    return;
  }
  pairs_within(id + 1, visit);
  pairs_within(node.right, visit);
  pairs_between(id + 1, node.right, visit);
}

template <class Visit>
void Bvh::self_pairs(Visit&& visit) const {
  if (!nodes_.empty()) pairs_within(0, visit);
}

template <class Visit>
void Bvh::self_pairs_parallel(Visit&& visit) const {
  parallel_for(task_count(), [&](Index task) {
    auto visit_in_task = [&](Index i, Index j) { visit(task, i, j); };
    const auto [a, b] = tasks_[task];
    if (a == b)
      pairs_within(a, visit_in_task);
    else
      pairs_between(a, b, visit_in_task);
  });
}

}  // namespace unsnarl
