#include "geometry/parallel_sums.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/parallel.h"

namespace unsnarl {
namespace {

double sum_of_roots(Index count, Index chunk) {
  return sum_in_chunks(count, chunk, [](Index begin, Index end) {
    double sum = 0;
    for (Index i = begin; i < end; ++i) sum += std::sqrt(i);
    return sum;
  });
}

/// Index i adds sqrt(i) to column i % 7, on top of ones.
Positions scattered_roots(Index count, Index chunk) {
  Positions out = Positions::Ones(3, 7);
  ScatteredSum scattered;
  for (int repetition = 0; repetition < 2; ++repetition) {  // the workspace of the first is used again
    scattered(count, chunk, out, [](Index begin, Index end, Positions& columns) {
      for (Index i = begin; i < end; ++i) columns.col(i % 7).array() += std::sqrt(i);
    });
  }
  return out;
}

TEST(ParallelSums, every_index_counts_once) {
  for (const Index count : {0, 1, 6, 7, 8, 100, 1000})
    for (const Index chunk : {1, 7, 300, 2000}) {
      const double expected = sum_of_roots(count, 2000);
      EXPECT_NEAR(sum_of_roots(count, chunk), expected, 1e-12 * expected) << count << " in chunks of " << chunk;
      const Positions roots = scattered_roots(count, 2000);
      EXPECT_LT((scattered_roots(count, chunk) - roots).norm(), 1e-12 * roots.norm());
      std::vector<int> seen(static_cast<std::size_t>(count), 0);
      for_chunks(count, chunk, [&](Index begin, Index end) {
        for (Index i = begin; i < end; ++i) ++seen[i];
      });
      EXPECT_EQ(seen, std::vector<int>(static_cast<std::size_t>(count), 1));
    }
}

TEST(ParallelSums, same_bits_at_any_thread_count) {
  const double sum = sum_of_roots(5000, 3);
  const Positions roots = scattered_roots(5000, 3);
  for (const std::size_t threads : {1, 2, 4}) {
    const ThreadLimit limit(threads);
    EXPECT_EQ(sum_of_roots(5000, 3), sum);
    EXPECT_EQ(scattered_roots(5000, 3), roots);
  }
}

}  // namespace
}  // namespace unsnarl
