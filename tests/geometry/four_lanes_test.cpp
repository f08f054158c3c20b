#include "geometry/four_lanes.h"

#include <gtest/gtest.h>

namespace unsnarl {
namespace {

TEST(FourLanes, bits_are_those_of_the_comparisons) {
  for (unsigned bits = 0; bits < 16; ++bits) {
    FourFloats numbers = {};
    FourIndices indices = {};
    for (int k = 0; k < 4; ++k) {
      numbers[k] = bits >> k & 1 ? 2.0f : -2.0f;
      indices[k] = bits >> k & 1 ? 7 : -7;
    }
    EXPECT_EQ(bits_of(numbers > four_times(0.5f)), bits);
    EXPECT_EQ(bits_of(indices == four_times(Index{7})), bits);
    EXPECT_EQ(bits_of((numbers > four_times(0.5f)) | (numbers < four_times(-0.5f))), 15u);
  }
}

}  // namespace
}  // namespace unsnarl
