// Numbers are written as std::to_chars writes them, also where the standard library has none for them.
#include "text/write_number.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <tuple>

#include "geometry/bit_cast.h"
#include "text/read_number.h"

namespace unsnarl {
namespace {

template <class Real>
std::string written(Real value) {
  std::array<char, 32> digits;
  return {digits.data(), write_number(digits.data(), digits.data() + digits.size(), value)};
}

template <class Real>
std::string written_by_fmt(Real value) {
  std::array<char, 32> digits;
  return {digits.data(), write_number_by_fmt(digits.data(), value)};
}

TEST(WriteNumber, takes_the_shorter_notation_and_of_equal_ones_the_fixed) {
  for (const auto& [value, text] : {std::tuple{0.0, "0"},
                                    {-0.0, "-0"},
                                    {1.0, "1"},
                                    {-2.5, "-2.5"},
                                    {0.1, "0.1"},
                                    {0.001, "0.001"},
                                    {0.0001, "1e-04"},
                                    {0.00012, "0.00012"},
                                    {0.000012, "1.2e-05"},
                                    {10000.0, "10000"},
                                    {100000.0, "1e+05"},
                                    {120000.0, "120000"},
                                    {1234567.0, "1234567"},
                                    {9007199254740993.0, "9007199254740992"},
                                    {123456789012345678901.0, "123456789012345683968"},
                                    {1.5e300, "1.5e+300"},
                                    {5e-324, "5e-324"}}) {
    EXPECT_EQ(written_by_fmt(value), text);
    EXPECT_EQ(written(value), text);
  }
  EXPECT_EQ(written_by_fmt(0.1f), "0.1");
  EXPECT_EQ(written_by_fmt(33554432.0f), "33554432");
}

template <class Real, class Bits>
void compare_notations(std::mt19937_64& random) {
  for (int i = 0; i < 200000; ++i) {
    const Real any = bit_cast<Real>(static_cast<Bits>(random()));
    // Those of a mesh: few digits, and of middling size.
    const Real usual = static_cast<Real>(static_cast<std::int64_t>(random() % 2000001) - 1000000) /
                       static_cast<Real>(std::pow(10, random() % 12));
    for (const Real value : {any, usual, std::ldexp(Real(1), static_cast<int>(random() % 200) - 100)}) {
      if (!std::isfinite(value)) continue;
      const std::string text = written_by_fmt(value);
      ASSERT_EQ(text, written(value));
      Real read = 0;
      read_number(text.data(), text.data() + text.size(), read);
      ASSERT_EQ(bit_cast<Bits>(read), bit_cast<Bits>(value)) << text;
    }
  }
}

TEST(WriteNumber, by_fmt_is_as_by_the_standard_library_and_reads_as_the_same_number) {
  std::mt19937_64 random(7);
  compare_notations<double, std::uint64_t>(random);
  compare_notations<float, std::uint32_t>(random);
}

}  // namespace
}  // namespace unsnarl
