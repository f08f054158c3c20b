#pragma once

#include <algorithm>
#include <array>
#include <type_traits>
#include <vector>

#include "geometry/parallel.h"
#include "geometry/types.h"

namespace unsnarl {

/// Sums in parallel that do not depend on the number of threads: the indices are cut in chunks by their number alone,
/// and the chunks' sums are added in order.

/// `work(begin, end)` for each chunk.
template <class Work>
void for_chunks(Index count, Index chunk, Work&& work) {
  if (count <= chunk) {
    work(Index{0}, count);
    return;
  }
  parallel_for((count + chunk - 1) / chunk, [&](Index k) {
    work(k * chunk, static_cast<Index>(std::min<std::int64_t>(count, std::int64_t{k + 1} * chunk)));
  });
}

/// `sum(begin, end)` returns what the indices [begin, end) contribute.
template <class Sum>
double sum_in_chunks(Index count, Index chunk, Sum&& sum) {
  if (count <= chunk) return sum(Index{0}, count);
  std::vector<double> sums((count + chunk - 1) / chunk);
  parallel_for(sums.size(), [&](std::size_t k) {
    const Index begin = static_cast<Index>(k) * chunk;
    sums[k] = sum(begin, std::min(count, begin + chunk));
  });
  double total = 0;
  for (const double s : sums) total += s;
  return total;
}

/// Adds up 3-vectors that many indices contribute to: elements scatter to their vertices. Keeps its workspace.
class ScatteredSum {
 public:
  /// Parts of a sum that are added up at the same time, at most (unit: parts)
  static constexpr Index most_parts = 8;

  /// `add(begin, end, columns)` adds the contributions of [begin, end) to the columns; their sum is added to `out`.
  /// From `chunk` indices on in up to `most_parts` parts at a time. `add(begin, end, columns, part)` also gets the
  /// number of its part, for what it adds elsewhere.
  template <class Add>
  void operator()(Index count, Index chunk, Positions& out, Add&& add) {
    const Index parts = std::min(most_parts, (count + chunk - 1) / chunk);
    if (parts <= 1) {
      call(add, Index{0}, count, out, Index{0});
      return;
    }
    const auto begin_of = [&](Index part) {
      return static_cast<Index>(static_cast<std::int64_t>(count) * part / parts);
    };
    parallel_for(parts, [&](Index part) {
      Positions& columns = part_[part];
      columns.setZero(3, out.cols());
      call(add, begin_of(part), begin_of(part + 1), columns, part);
    });
    const Index n = static_cast<Index>(out.cols());
    const Index columns_a_task = 4096;
    parallel_for((n + columns_a_task - 1) / columns_a_task, [&](Index task) {
      const Index first = task * columns_a_task;
      const Index width = std::min(columns_a_task, n - first);
      for (Index part = 0; part < parts; ++part) out.middleCols(first, width) += part_[part].middleCols(first, width);
    });
  }

 private:
  template <class Add>
  static void call(Add& add, Index begin, Index end, Positions& columns, Index part) {
    if constexpr (std::is_invocable_v<Add&, Index, Index, Positions&, Index>) {
      add(begin, end, columns, part);
    } else {
      add(begin, end, columns);
    }
  }

  std::array<Positions, most_parts> part_;
};

}  // namespace unsnarl
