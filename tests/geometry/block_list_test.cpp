#include "geometry/block_list.h"

#include <gtest/gtest.h>

#include <deque>
#include <numeric>
#include <vector>

namespace unsnarl {
namespace {

BlockList<int> up_to(int count) {
  BlockList<int> list;
  for (int k = 0; k < count; ++k) list.push_back(k);
  return list;
}

std::vector<int> items_of(const BlockList<int>& list) {
  return {list.begin(), list.end()};
}

/// 0, step, 2 step, ... below `count`.
std::vector<int> multiples(int step, int count) {
  std::vector<int> all((static_cast<std::size_t>(count) + step - 1) / step);
  for (std::size_t k = 0; k < all.size(); ++k) all[k] = static_cast<int>(k) * step;
  return all;
}

// Sizes around those of one and two blocks.
class BlockListOfSize : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Sizes, BlockListOfSize, testing::Values(0, 1, 1023, 1024, 1025, 2048, 5000));

TEST_P(BlockListOfSize, holds_what_was_added_in_order) {
  const BlockList<int> list = up_to(GetParam());
  EXPECT_EQ(list.size(), static_cast<std::size_t>(GetParam()));
  EXPECT_EQ(list.empty(), GetParam() == 0);
  EXPECT_EQ(items_of(list), multiples(1, GetParam()));
}

TEST_P(BlockListOfSize, keeps_the_order_of_what_is_left) {
  BlockList<int> list = up_to(GetParam());
  list.erase_if([](int k) { return k % 3 != 0; });
  EXPECT_EQ(items_of(list), multiples(3, GetParam()));
  EXPECT_EQ(list.size(), items_of(list).size());
  list.push_back(-1);
  EXPECT_EQ(items_of(list).back(), -1);
  list.erase_if([](int) { return true; });
  EXPECT_TRUE(list.empty());
  EXPECT_EQ(list.begin(), list.end());
}

TEST_P(BlockListOfSize, is_gathered_from_in_order) {
  std::vector<int> even = {7};  // is replaced
  gather_from_blocks(up_to(GetParam()), even, [](std::span<const int> block, std::vector<int>& list) {
    for (const int k : block)
      if (k % 2 == 0) list.push_back(k);
  });
  EXPECT_EQ(even, multiples(2, GetParam()));
}

TEST(BlockList, takes_over_lists_behind_its_own_items) {
  BlockList<int> list = up_to(1000);
  std::vector<std::deque<int>> more(2, std::deque<int>(500));
  std::iota(more[0].begin(), more[0].end(), 1000);
  std::iota(more[1].begin(), more[1].end(), 1500);
  append_lists(std::move(more), list);
  EXPECT_EQ(items_of(list), multiples(1, 2000));
}

}  // namespace
}  // namespace unsnarl
