#include "contact/bvh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <set>
#include <string>

namespace unsnarl {
namespace {

using Pairs = std::vector<std::pair<Index, Index>>;

std::vector<Box> random_boxes(Index n, double size, unsigned seed) {
  std::mt19937_64 engine(seed);
  const auto unit = [&] { return static_cast<double>(engine() >> 11) * 0x1p-53; };
  std::vector<Box> boxes(n);
  for (Box& box : boxes) {
    const Vec3 p(unit(), unit(), unit());
    box.extend(p);
    box.extend(Vec3(p + size * Vec3(unit(), unit(), unit())));
  }
  return boxes;
}

// Sorted by x, so that large sets are compared in little time too.
Pairs brute_pairs(const std::vector<Box>& boxes) {
  std::vector<Index> order(boxes.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](Index i, Index j) { return boxes[i].lo[0] < boxes[j].lo[0]; });
  Pairs pairs;
  for (std::size_t k = 0; k < order.size(); ++k)
    for (std::size_t l = k + 1; l < order.size() && boxes[order[l]].lo[0] <= boxes[order[k]].hi[0]; ++l)
      if (boxes[order[k]].overlaps(boxes[order[l]])) pairs.push_back(std::minmax(order[k], order[l]));
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

Pairs self_pairs(const Bvh& bvh) {
  Pairs pairs;
  bvh.self_pairs([&](Index i, Index j) { pairs.push_back(std::minmax(i, j)); });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

Pairs parallel_pairs(const Bvh& bvh) {
  std::vector<Pairs> found(bvh.task_count());
  bvh.self_pairs_parallel([&](Index task, Index i, Index j) { found[task].push_back(std::minmax(i, j)); });
  Pairs pairs;
  for (const Pairs& list : found) pairs.insert(pairs.end(), list.begin(), list.end());
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

TEST(Bvh, tells_whether_any_box_overlaps) {
  EXPECT_FALSE(Bvh().overlaps_any(random_boxes(1, 1, 1).front()));
  for (const Index n : {5, 300}) {
    const std::vector<Box> boxes = random_boxes(n, 0.6 / std::cbrt(n), static_cast<unsigned>(n));
    const Bvh bvh(boxes);
    int yes = 0;
    for (const Box& box : random_boxes(500, 0.1, 7)) {
      const bool any = std::any_of(boxes.begin(), boxes.end(), [&](const Box& b) { return b.overlaps(box); });
      EXPECT_EQ(bvh.overlaps_any(box), any);
      yes += any;
    }
    EXPECT_GT(yes, 0) << n;
    EXPECT_LT(yes, 500) << n;
  }
}

// Around the sizes of leaves (4), of tasks (1024) and of the parallel build (20000).
TEST(Bvh, finds_each_overlapping_pair_once) {
  for (const Index n : {0, 1, 2, 3, 4, 5, 8, 9, 100, 1000, 1023, 1024, 1025, 4097, 20001}) {
    const std::vector<Box> boxes = random_boxes(n, 1.5 / std::cbrt(n + 1.0), static_cast<unsigned>(n));
    const Bvh bvh(boxes);
    EXPECT_EQ(bvh.size(), n);
    const Pairs expected = brute_pairs(boxes);
    EXPECT_TRUE(self_pairs(bvh) == expected) << n << " boxes";
    EXPECT_TRUE(parallel_pairs(bvh) == expected) << n << " boxes in " << bvh.task_count() << " tasks";
    if (n > 100) {
      EXPECT_FALSE(expected.empty());
    }
  }
}

TEST(Bvh, tasks_are_the_same_on_every_run) {
  const std::vector<Box> boxes = random_boxes(9000, 0.05, 3);
  const auto lists = [&] {
    const Bvh bvh(boxes);
    std::vector<Pairs> found(bvh.task_count());
    bvh.self_pairs_parallel([&](Index task, Index i, Index j) { found[task].push_back({i, j}); });
    return found;
  };
  const auto first = lists();
  EXPECT_GT(first.size(), 2u);
  EXPECT_TRUE(lists() == first);
}

TEST(Bvh, queries) {
  const std::vector<Box> boxes = random_boxes(700, 0.1, 4), queries = random_boxes(200, 0.3, 5);
  const Bvh bvh(boxes);
  for (const Box& query : queries) {
    std::vector<Index> found, expected;
    bvh.query(query, [&](Index i) { found.push_back(i); });
    for (Index i = 0; i < bvh.size(); ++i)
      if (boxes[i].overlaps(query)) expected.push_back(i);
    std::sort(found.begin(), found.end());
    ASSERT_EQ(found, expected);
  }
  bvh.query(Box(), [](Index) { ADD_FAILURE() << "an empty box overlaps nothing"; });
  Bvh().query(boxes[0], [](Index) { ADD_FAILURE() << "there is nothing to find"; });
}

TEST(Bvh, refitted_to_other_boxes_it_finds_their_pairs) {
  for (const Index n : {1, 5, 300, 5000}) {
    Bvh bvh(random_boxes(n, 0.1, 6));
    for (unsigned round = 0; round < 3; ++round) {
      const std::vector<Box> moved = random_boxes(n, 0.07, 7 + round);
      bvh.refit(moved);
      EXPECT_TRUE(self_pairs(bvh) == brute_pairs(moved));
      EXPECT_TRUE(parallel_pairs(bvh) == brute_pairs(moved));
    }
  }
}

TEST(Bvh, visits_only_pairs_of_which_a_box_is_watched) {
  for (const Index n : {1, 5, 300, 5000}) {
    const std::vector<Box> boxes = random_boxes(n, 0.1, 9);
    const Pairs all = brute_pairs(boxes);
    Bvh bvh(boxes);
    for (const Index every : {1, 7, 1000000}) {  // all, some, and but the first none
      std::vector<std::uint8_t> watched(boxes.size(), 0);
      for (Index i = 0; i < n; i += every) watched[i] = 1;
      bvh.set_active(watched);
      Pairs expected = all;
      std::erase_if(expected, [&](const auto& pair) { return !watched[pair.first] && !watched[pair.second]; });
      EXPECT_TRUE(self_pairs(bvh) == expected);
      EXPECT_TRUE(parallel_pairs(bvh) == expected);
    }
  }
}

TEST(Bvh, what_few_boxes_change_is_what_all_would) {
  for (const Index n : {1, 5, 300, 5000}) {
    std::vector<Box> boxes = random_boxes(n, 0.1, 9);
    const std::vector<Box> others = random_boxes(n, 0.1, 10);
    Bvh some(boxes), all(boxes);
    for (const Index every : {7, 1000000, 3}) {
      std::vector<Index> chosen;
      std::vector<std::uint8_t> is_chosen(boxes.size(), 0);
      for (Index i = (n - 1) / 2; i < n; i += every) chosen.push_back(i);
      std::reverse(chosen.begin(), chosen.end());  // in any order
      for (Index i : chosen) is_chosen[i] = 1, boxes[i] = others[i];
      some.refit(boxes, chosen);
      all.refit(boxes);
      EXPECT_TRUE(self_pairs(some) == self_pairs(all));
      some.set_only_active(chosen);
      all.set_active(is_chosen);
      EXPECT_TRUE(parallel_pairs(some) == parallel_pairs(all));
      some.set_only_active(chosen);
      EXPECT_TRUE(self_pairs(some) == self_pairs(all));
    }
    some.set_active(std::vector<std::uint8_t>(boxes.size(), 1));
    EXPECT_TRUE(self_pairs(some) == brute_pairs(boxes));
    some.set_only_active({});
    EXPECT_TRUE(self_pairs(some).empty());
  }
}

TEST(Bvh, boxes_that_touch_overlap) {
  std::vector<Box> boxes(2);
  boxes[0].extend(Vec3(0, 0, 0));
  boxes[0].extend(Vec3(1, 1, 1));
  boxes[1].extend(Vec3(1, 1, 1));
  EXPECT_EQ(self_pairs(Bvh(boxes)).size(), 1u);
  boxes[1].lo = boxes[1].hi = Vec3(1, 1, std::nextafter(1.0, 2.0));
  EXPECT_TRUE(self_pairs(Bvh(boxes)).empty());
}

// All at one place, all on one line: the order of the tree has nothing to go by.
TEST(Bvh, degenerate_layouts) {
  std::vector<Box> same(300), line(300);
  for (Index i = 0; i < 300; ++i) {
    same[i].extend(Vec3(1, 2, 3));
    line[i].extend(Vec3(0.5 * i, 7, 7));
    line[i].extend(Vec3(0.5 * i + 0.6, 7, 7));
  }
  EXPECT_EQ(self_pairs(Bvh(same)).size(), 300u * 299 / 2);
  EXPECT_TRUE(self_pairs(Bvh(line)) == brute_pairs(line));
}

}  // namespace
}  // namespace unsnarl
