// Numbers are read as std::from_chars reads them, also where the standard library has none for them.
#include "text/read_number.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <random>
#include <string>
#include <tuple>

#include "geometry/bit_cast.h"

namespace unsnarl {
namespace {

struct Reading {
  std::ptrdiff_t length;
  std::errc error;
  double value;
};

Reading read(const std::string& text) {
  double value = 7;  // stays where nothing is read
  const auto [end, error] = read_number(text.data(), text.data() + text.size(), value);
  return {end - text.data(), error, value};
}

TEST(ReadNumber, ends_where_the_number_ends) {
  for (const auto& [text, length, value] : {std::tuple{"1", 1, 1.0},
                                            {"-2.5e3x", 6, -2500.0},
                                            {".5", 2, 0.5},
                                            {"5.", 2, 5.0},
                                            {"1e", 1, 1.0},
                                            {"1e+", 1, 1.0},
                                            {"0x10", 1, 0.0},
                                            {"1,5", 1, 1.0},
                                            {"1 2", 1, 1.0},
                                            {"1E2", 3, 100.0},
                                            {"-0", 2, 0.0},
                                            {"0e999", 5, 0.0}}) {
    const Reading r = read(text);
    EXPECT_EQ(r.error, std::errc{}) << text;
    EXPECT_EQ(r.length, length) << text;
    EXPECT_EQ(r.value, value) << text;
  }
  EXPECT_TRUE(std::signbit(read("-0").value));
}

TEST(ReadNumber, takes_words_for_what_has_no_digits) {
  EXPECT_EQ(read("inf").value, std::numeric_limits<double>::infinity());
  EXPECT_EQ(read("-Infinity").value, -std::numeric_limits<double>::infinity());
  EXPECT_EQ(read("-INFINITY!").length, 9);
  EXPECT_TRUE(std::isnan(read("NaN").value));
  EXPECT_EQ(read("NaN").length, 3);
}

TEST(ReadNumber, leaves_the_value_where_there_is_no_number) {
  for (const char* text : {"", "-", "+1", " 1", ".", "e5", "-x", "x"}) {
    const Reading r = read(text);
    EXPECT_EQ(r.error, std::errc::invalid_argument) << text;
    EXPECT_EQ(r.length, 0) << text;
    EXPECT_EQ(r.value, 7) << text;
  }
}

TEST(ReadNumber, says_what_is_out_of_range) {
  for (const char* text : {"1e400", "-1e400", "1e-400", "-0.001e-330"}) {
    const Reading r = read(text);
    EXPECT_EQ(r.error, std::errc::result_out_of_range) << text;
    EXPECT_EQ(r.length, static_cast<std::ptrdiff_t>(std::string(text).size())) << text;
    EXPECT_EQ(r.value, 7) << text;
  }
  EXPECT_EQ(read("5e-324").value, std::numeric_limits<double>::denorm_min());
}

TEST(ReadNumber, gives_back_what_is_written_with_all_digits) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 20000; ++i) {
    const double value = bit_cast<double>(static_cast<std::uint64_t>(random()));
    const float single = bit_cast<float>(static_cast<std::uint32_t>(random()));
    if (!std::isfinite(value) || !std::isfinite(single)) continue;
    char text[64];
    EXPECT_EQ(read({text, text + std::snprintf(text, sizeof text, "%.17g", value)}).value, value);
    float again = 0;
    read_number(text, text + std::snprintf(text, sizeof text, "%.9g", single), again);
    EXPECT_EQ(again, single);
  }
}

}  // namespace
}  // namespace unsnarl
