#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "geometry/parallel.h"
#include "geometry/types.h"

namespace unsnarl {

/// Appends the lists (vectors, deques), one after the other. Each is given back at once: there is never room for all
/// twice.
template <class List, class Item>
void append_lists(std::vector<List>&& lists, std::vector<Item>& out) {
  std::size_t size = out.size();
  for (const auto& list : lists) size += list.size();
  out.reserve(size);
  for (auto& list : lists) {
    out.insert(out.end(), list.begin(), list.end());
    List().swap(list);
  }
}

/// Replaces `out` by the lists.
template <class List, class Item>
void join_lists(std::vector<List>&& lists, std::vector<Item>& out) {
  std::size_t size = 0;
  for (const auto& list : lists) size += list.size();
  if (size > out.capacity()) std::vector<Item>().swap(out);  // else there would be two for a moment
  out.clear();
  append_lists(std::move(lists), out);
}

/// Builds a list in parallel that does not depend on the number of threads: `append(begin, end, list)` adds what the
/// indices [begin, end) contribute, chunk by chunk; the chunks are joined in order. `out` is replaced.
template <class Item, class Append>
void gather_in_chunks(Index count, std::vector<Item>& out, Append&& append) {
  constexpr Index chunk = 1024;  ///< A task of a parallel loop has this many indices (unit: indices)
  out.clear();
  if (count <= chunk) {
    append(Index{0}, count, out);
    return;
  }
  std::vector<std::vector<Item>> lists((count + chunk - 1) / chunk);
  parallel_for(lists.size(), [&](std::size_t k) {
    const Index begin = static_cast<Index>(k) * chunk;
    append(begin, std::min(count, begin + chunk), lists[k]);
  });
  join_lists(std::move(lists), out);
}

}  // namespace unsnarl
