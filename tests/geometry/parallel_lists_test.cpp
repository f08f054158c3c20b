#include "geometry/parallel_lists.h"

#include <gtest/gtest.h>

#include "geometry/parallel.h"

namespace unsnarl {
namespace {

// Index i contributes i % 3 times the value i.
void append_some(Index begin, Index end, std::vector<Index>& list) {
  for (Index i = begin; i < end; ++i) list.insert(list.end(), static_cast<std::size_t>(i % 3), i);
}

std::vector<Index> expected_list(Index count) {
  std::vector<Index> list;
  append_some(0, count, list);
  return list;
}

TEST(ParallelLists, joins_the_chunks_in_order) {
  for (const Index count : {0, 1, 7, 1023, 1024, 1025, 2047, 2048, 2049, 10000}) {
    std::vector<Index> list = {99, 98};  // what was there is replaced
    gather_in_chunks(count, list, append_some);
    EXPECT_EQ(list, expected_list(count)) << count;
  }
}

TEST(ParallelLists, same_list_at_any_thread_count) {
  for (const std::size_t threads : {1, 2, 4}) {
    const ThreadLimit limit(threads);
    std::vector<Index> list;
    gather_in_chunks(Index{50000}, list, append_some);
    EXPECT_EQ(list, expected_list(50000));
  }
}

}  // namespace
}  // namespace unsnarl
