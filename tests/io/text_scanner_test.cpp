#include "io/text_scanner.h"

#include <gtest/gtest.h>

namespace unsnarl {
namespace {

using Number = TextScanner::Number;

template <class T>
Number read(const std::string& text, T& value) {
  return TextScanner(text, {}).number(value);
}

TEST(TextScanner, numbers_are_exact) {
  double value = 0;
  for (const char* text : {"1", "+1", "1.", "1.0", "1e0", "10e-1", "+.1E1"}) {
    EXPECT_EQ(read(text, value), Number::ok) << text;
    EXPECT_EQ(value, 1.0) << text;
  }
  EXPECT_EQ(read("0.1", value), Number::ok);
  EXPECT_EQ(value, 0.1);
  float single = 0;
  EXPECT_EQ(read("0.1", single), Number::ok);
  EXPECT_EQ(single, 0.1f);
}

TEST(TextScanner, numbers_too_small_are_zero) {
  double value = 7;
  for (const char* text : {"1e-400", "-1e-99999999999999999999", "0.0000000001e-320", "123456789e-400", "0e999999"}) {
    value = 7;
    EXPECT_EQ(read(text, value), Number::ok) << text;
    EXPECT_NEAR(value, 0.0, 1e-300) << text;
  }
  float single = 7;
  EXPECT_EQ(read("1e-60", single), Number::ok);
  EXPECT_EQ(single, 0.0f);
  EXPECT_EQ(read("1e-40", single), Number::ok);
  EXPECT_NEAR(single, 1e-40f, 1e-44f);
}

TEST(TextScanner, what_is_no_finite_number) {
  double value = 7;
  for (const char* text : {"inf", "-inf", "nan", "1e400", "-1e99999999999999999999", "infinity"}) {
    EXPECT_EQ(read(text, value), Number::not_finite) << text;
  }
  float single = 7;
  EXPECT_EQ(read("1e39", single), Number::not_finite);
  for (const char* text : {"x", "1,5", "1x", "+-1", "--1", "0x10", "1e", "1.#QNAN", "-nan(ind)"}) {
    EXPECT_NE(read(text, value), Number::ok) << text;
  }
  EXPECT_EQ(read("", value), Number::missing);
  EXPECT_EQ(read(" 1", value), Number::missing);
  EXPECT_EQ(value, 7);
}

TEST(TextScanner, lines_end_in_three_ways) {
  const std::string text = "a\nb\r\nc\rd";
  const TextScanner scanner(text, {});
  EXPECT_EQ(scanner.line(0), 1u);
  EXPECT_EQ(scanner.line(2), 2u);
  EXPECT_EQ(scanner.line(5), 3u);
  EXPECT_EQ(scanner.line(7), 4u);
}

TEST(TextScanner, continuation_and_comments) {
  const std::string text = "a \\\n b # c \\\nd";
  TextScanner scanner(text, {.hash_comments = true, .continuation = true});
  EXPECT_EQ(scanner.token(), "a");
  EXPECT_TRUE(scanner.skip_blanks());
  EXPECT_EQ(scanner.token(), "b");
  EXPECT_FALSE(scanner.skip_blanks());
  scanner.next_line();
  EXPECT_EQ(scanner.token(), "d");
}

TEST(TextScanner, quotes_only_what_can_be_printed) {
  EXPECT_EQ(in_quotes(std::string("a\0b\xFF", 4)), "'a\\x00b\\xff'");
  EXPECT_EQ(in_quotes(std::string(29, 'x') + "\xc3\xa5y"), "'" + std::string(29, 'x') + "...'");
  EXPECT_EQ(in_quotes(std::string(100, 'x')), "'" + std::string(30, 'x') + "...'");
}

}  // namespace
}  // namespace unsnarl
