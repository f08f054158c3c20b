#include "scene/independent_batches.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>

#include "geometry/parallel.h"

namespace unsnarl {
namespace {

Box interval(double lo, double hi) {
  Box box;
  box.extend(Vec3(lo, 0, 0));
  box.extend(Vec3(hi, 1, 1));
  return box;
}

std::vector<std::size_t> finishing_order(const std::vector<Box>& boxes) {
  std::vector<std::size_t> order;
  run_in_batches(
      boxes, [](std::size_t) {}, [&](std::size_t i) { order.push_back(i); });
  return order;
}

TEST(Waves, items_apart_are_finished_in_order) {
  EXPECT_TRUE(finishing_order({}).empty());
  EXPECT_EQ(finishing_order({interval(0, 1), interval(2, 3), interval(4, 5)}), (std::vector<std::size_t>{0, 1, 2}));
}

TEST(Waves, an_item_waits_for_earlier_ones_that_it_overlaps) {
  // 1 overlaps 0; 2 overlaps nobody; 3 overlaps 1.
  const std::vector<Box> boxes = {interval(0, 2), interval(1, 4), interval(10, 11), interval(3, 5)};
  EXPECT_EQ(finishing_order(boxes), (std::vector<std::size_t>{0, 2, 1, 3}));
  std::vector<std::uint8_t> finished(4, 0);
  run_in_batches(
      boxes,
      [&](std::size_t i) {
        for (std::size_t j = 0; j < i; ++j)
          EXPECT_TRUE(finished[j] || !boxes[i].overlaps(boxes[j])) << i << " began before " << j << " was finished";
      },
      [&](std::size_t i) { finished[i] = 1; });
}

// Cells on a line; each item reads those of its interval and writes them when finished. Mixing is not commutative, so
// that any other order gives other numbers.
std::vector<std::uint64_t> mixed(const std::vector<Box>& boxes, bool in_waves) {
  std::vector<std::uint64_t> cells(100, 1);
  std::vector<std::uint64_t> result(boxes.size());
  const auto work = [&](std::size_t i) {
    std::uint64_t sum = i + 1;
    for (int c = static_cast<int>(boxes[i].lo[0]); c <= static_cast<int>(boxes[i].hi[0]); ++c)
      sum = sum * 6364136223846793005ULL + cells[c];
    result[i] = sum;
  };
  const auto finish = [&](std::size_t i) {
    for (int c = static_cast<int>(boxes[i].lo[0]); c <= static_cast<int>(boxes[i].hi[0]); ++c)
      cells[c] = cells[c] * 31 + result[i];
  };
  if (in_waves) {
    run_in_batches(boxes, work, finish);
  } else {
    for (std::size_t i = 0; i < boxes.size(); ++i) work(i), finish(i);
  }
  return cells;
}

TEST(Waves, the_result_is_that_of_one_after_the_other) {
  std::mt19937 random(1);
  for (int round = 0; round < 200; ++round) {
    std::vector<Box> boxes;
    for (int i = 0; i < 40; ++i) {
      const double lo = random() % 90;
      boxes.push_back(interval(lo, lo + random() % 10));
    }
    const auto expected = mixed(boxes, false);
    for (const std::size_t threads : {1, 4}) {
      const ThreadLimit limit(threads);
      ASSERT_EQ(mixed(boxes, true), expected) << "round " << round << ", " << threads << " threads";
    }
  }
}

}  // namespace
}  // namespace unsnarl
