#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "contact/bvh.h"
#include "contact/bvh_traversal.h"
#include "geometry/box.h"
#include "geometry/parallel.h"

namespace unsnarl {

/// Runs work on items that may disturb each other if their boxes overlap. Items go into batches without overlaps. Each
/// batch runs `work(i)` in parallel, then `finish(i)` for its items in order on the calling thread. Of two items that
/// overlap, the earlier one is finished before the later one begins, so that the result is that of one after the other
/// at any thread count.
template <class Work, class Finish>
void run_in_batches(std::span<const Box> boxes, Work&& work, Finish&& finish) {
  const std::size_t n = boxes.size();
  std::vector<std::vector<std::size_t>> earlier(n), batches;
  Bvh(boxes).self_pairs([&](Index i, Index j) { earlier[std::max(i, j)].push_back(std::min(i, j)); });
  std::vector<std::size_t> batch(n, 0);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j : earlier[i]) batch[i] = std::max(batch[i], batch[j] + 1);
    if (batch[i] == batches.size()) batches.emplace_back();
    batches[batch[i]].push_back(i);
  }
  for (const std::vector<std::size_t>& items : batches) {
    parallel_for(items.size(), [&](std::size_t k) { work(items[k]); });
    for (std::size_t i : items) finish(i);
  }
}

}  // namespace unsnarl
