#include "applications/curves/reversible_sequence.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "geometry/splitmix.h"

namespace unsnarl {
namespace {

TEST(ReversibleSequence, does_what_a_list_does) {
  const Index n = 200;
  ReversibleSequence sequence(n);
  std::vector<Index> list;
  std::vector<int> backwards(n, 0);
  for (Index k = 0; k < n; ++k) list.push_back(k);
  std::uint64_t state = 1;
  const auto below = [&](std::size_t most) {
    return static_cast<Index>(splitmix_number(state += splitmix_step) * static_cast<double>(most));
  };
  while (list.size() > 1) {
    const Index one = below(list.size()), other = below(list.size());
    const Index first = std::min(one, other), count = std::abs(one - other);
    sequence.reverse(first, count);
    std::reverse(list.begin() + first, list.begin() + first + count);
    for (Index k = first; k < first + count; ++k) backwards[list[k]] ^= 1;
    if (count % 3 == 0) {
      sequence.remove(list[first]);
      list.erase(list.begin() + first);
    }
    for (std::size_t k = 0; k < list.size(); k += 7) {
      ASSERT_EQ(sequence.position_of(list[k]), static_cast<Index>(k));
      ASSERT_EQ(sequence.is_backwards(list[k]), backwards[list[k]] == 1);
    }
    if (list.size() % 10 == 0) {
      ASSERT_EQ(sequence.order(), list);
    }
  }
  EXPECT_EQ(sequence.order(), list);
}

}  // namespace
}  // namespace unsnarl
