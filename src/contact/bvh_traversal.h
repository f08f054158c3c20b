#pragma once

#include <oneapi/tbb/parallel_for.h>

#include "contact/bvh.h"

namespace unsnarl {

template <class Accept>
bool Bvh::find(const Box& box, Accept&& accept) const {
  if (nodes_.empty()) return false;
  std::array<Index, 64> stack;  // depth is at most log2(2^31) + 1
  int top = 0;
  stack[top++] = 0;
  while (top > 0) {
    const Index id = stack[--top];
    const Node& node = nodes_[id];
    if (!node.box.overlaps(box)) continue;
    if (node.right == 0) {
      for (Index k = node.begin; k < node.end; ++k)
        if (boxes_[k].overlaps(box) && accept(order_[k])) return true;
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
void Bvh::pairs_between(Index a, Index b, Visit& visit) const {
  const Node &node_a = nodes_[a], &node_b = nodes_[b];
  if (!(node_a.watched || node_b.watched) || !node_a.box.overlaps(node_b.box)) return;
  if (node_a.right == 0 && node_b.right == 0) {
    for (Index i = node_a.begin; i < node_a.end; ++i) {
      if (!boxes_[i].overlaps(node_b.box)) continue;
      for (Index j = node_b.begin; j < node_b.end; ++j)
        if ((watched_[i] || watched_[j]) && boxes_[i].overlaps(boxes_[j])) visit(order_[i], order_[j]);
    }
  } else if (node_b.right == 0 || (node_a.right != 0 && node_a.end - node_a.begin >= node_b.end - node_b.begin)) {
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
  if (!node.watched) return;
  if (node.right == 0) {
    for (Index i = node.begin; i < node.end; ++i)
      for (Index j = i + 1; j < node.end; ++j)
        if ((watched_[i] || watched_[j]) && boxes_[i].overlaps(boxes_[j])) visit(order_[i], order_[j]);
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
  oneapi::tbb::parallel_for(Index{0}, task_count(), [&](Index task) {
    auto visit_in_task = [&](Index i, Index j) { visit(task, i, j); };
    const auto [a, b] = tasks_[task];
    if (a == b)
      pairs_within(a, visit_in_task);
    else
      pairs_between(a, b, visit_in_task);
  });
}

}  // namespace unsnarl
