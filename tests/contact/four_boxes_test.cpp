#include "contact/four_boxes.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

namespace unsnarl {
namespace {

TEST(FourBoxes, that_overlap_are_all_seen) {
  std::mt19937_64 engine(1);
  int overlapping = 0, seen = 0;
  for (const double size : {1e-300, 1.0, 1e39, 1e300})
    for (int round = 0; round < 2000; ++round) {
      FourBoxes four[2];
      std::array<Box, 4> boxes[2];
      for (int side = 0; side < 2; ++side)
        for (int k = 0; k < 4; ++k) {
          Box& box = boxes[side][k];
          for (int i = 0; i < 3; ++i) {  // of few values, so that many touch
            box.lo[i] = size * (static_cast<double>(engine() % 9) / 8 - 0.5);
            box.hi[i] = box.lo[i] + size * static_cast<double>(engine() % 3) / 8;
          }
          if (k == 3 && round % 2) box = Box();
          four[side].set(k, RoundedBox(box));
        }
      for (int k = 0; k < 4; ++k) {
        const unsigned bits = four[0].overlapping(four[1], k);
        EXPECT_EQ(bits, four[0].overlapping(RoundedBox(boxes[1][k])));
        EXPECT_LT(bits, 16u);
        for (int l = 0; l < 4; ++l) {
          const bool overlap = boxes[0][l].overlaps(boxes[1][k]);
          const bool is_seen = bits >> l & 1;
          EXPECT_TRUE(is_seen || !overlap);
          overlapping += overlap && size == 1;
          seen += is_seen && size == 1;
        }
      }
    }
  EXPECT_GT(overlapping, 500);
  EXPECT_EQ(seen, overlapping);  // these coordinates are not rounded
}

}  // namespace
}  // namespace unsnarl
