#include "geometry/scale.h"

#include <gtest/gtest.h>

#include <vector>

namespace unsnarl {
namespace {

TEST(Scale, moderate_numbers_are_taken_as_they_are) {
  for (const std::vector<double>& numbers : std::vector<std::vector<double>>{
           {}, {0, -0.0}, {1, 2, 3}, {0x1p99, 5e-324}, {-0x1p-100}, {1e30}, {INFINITY, 1, NAN}}) {
    const Scale scale(numbers);
    EXPECT_TRUE(scale.is_one());
    EXPECT_EQ(scale.exponent(), 0);
    EXPECT_EQ(scale.in(3.5), 3.5);
    EXPECT_EQ(scale.out(3.5), 3.5);
  }
}

TEST(Scale, others_come_near_one_and_back_as_they_were) {
  for (const std::vector<double>& numbers :
       std::vector<std::vector<double>>{{0x1.8p300, -3, 0},
                                        {0x1p-300, 0x1p-320},
                                        {std::numeric_limits<double>::max(), 0x1p10 + 0x1p-40},
                                        {0x1p-900, -0x1.23456789abcdep-960},
                                        {5e-324, -1e-323}}) {
    const Scale scale(numbers);
    EXPECT_FALSE(scale.is_one());
    const std::vector<double> scaled = scale.in(numbers);
    double largest = 0;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      largest = std::max(largest, std::abs(scaled[i]));
      EXPECT_EQ(scale.out(scaled[i]), numbers[i]);
    }
    EXPECT_GE(largest, 0.5);
    EXPECT_LT(largest, 1);
  }
}

// The largest would come near one, but the smallest would be lost.
TEST(Scale, no_bit_is_lost_for_the_sake_of_the_largest) {
  const std::vector<double> numbers = {0x1p1000, 0x1.123456789abcdp-60, 5e-324};
  const Scale scale(numbers);
  for (const double number : numbers) EXPECT_EQ(scale.out(scale.in(number)), number);
  const std::vector<double> wide = {0x1p800, 0x1.123456789abcdp-400};
  for (const double number : wide) EXPECT_EQ(Scale(wide).out(Scale(wide).in(number)), number);
}

TEST(Scale, beyond_double_is_its_largest_number) {
  const Scale scale(std::vector<double>{0x1p1023});
  EXPECT_EQ(scale.out(2), std::numeric_limits<double>::max());
  EXPECT_EQ(scale.out(-2), std::numeric_limits<double>::lowest());
}

}  // namespace
}  // namespace unsnarl
