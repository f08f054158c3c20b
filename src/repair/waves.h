#pragma once

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <span>
#include <vector>

#include "geometry/box.h"

namespace unsnarl {

/// Runs work on items that may disturb each other where their boxes overlap: in waves of items that do not, each wave
/// in parallel by `work(i)`, followed by `finish(i)` for its items in order on the calling thread. Of two items that
/// overlap the earlier one is finished before the later begins; so the result is that of one after the other, at any
/// thread count.
template <class Work, class Finish>
void run_in_waves(std::span<const Box> boxes, Work&& work, Finish&& finish) {
  const std::size_t n = boxes.size();
  std::vector<std::size_t> wave(n, 0);
  std::size_t waves = 0;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < i; ++j)
      if (wave[j] >= wave[i] && boxes[i].overlaps(boxes[j])) wave[i] = wave[j] + 1;
    waves = std::max(waves, wave[i] + 1);
  }
  for (std::size_t w = 0; w < waves; ++w) {
    std::vector<std::size_t> items;
    for (std::size_t i = 0; i < n; ++i)
      if (wave[i] == w) items.push_back(i);
    oneapi::tbb::parallel_for(std::size_t{0}, items.size(), [&](std::size_t k) { work(items[k]); });
    for (std::size_t i : items) finish(i);
  }
}

}  // namespace unsnarl
