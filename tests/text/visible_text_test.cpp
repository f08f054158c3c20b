#include "unsnarl/visible_text.h"

#include <gtest/gtest.h>

namespace unsnarl {
namespace {

TEST(VisibleText, what_can_be_read_stays) {
  for (const char* const text : {"", "a b.obj", "it's 50 % \\ \"x\"", "hånd 手 \xf0\x9f\x98\x80", "a\xcc\x8a"})
    EXPECT_EQ(visible_text(text), text);
}

TEST(VisibleText, control_characters_are_spelled) {
  EXPECT_EQ(visible_text("\x1b]0;owned\a\x1b[2J"), "\\x1b]0;owned\\x07\\x1b[2J");
  EXPECT_EQ(visible_text("a\nb\r\tc\x7f"), "a\\x0ab\\x0d\\x09c\\x7f");
  EXPECT_EQ(visible_text(std::string_view("a\0b", 3)), "a\\x00b");
  EXPECT_EQ(visible_text("\xc2\x9b"
                         "31m"),
            "\\x9b31m");  // U+009B: what ESC [ is in 8 bits
}

TEST(VisibleText, bytes_that_are_no_text_are_spelled) {
  EXPECT_EQ(visible_text("h\xe5nd.obj"), "h\\xe5nd.obj");  // Latin-1
  EXPECT_EQ(visible_text("\x9b"
                         "31m"),
            "\\x9b31m");                                       // a C1 control of a terminal of 8 bits
  EXPECT_EQ(visible_text("\xc0\x9b"), "\\xc0\\x9b");           // longer than it need be
  EXPECT_EQ(visible_text("\xe2\x80"), "\\xe2\\x80");           // cut off
  EXPECT_EQ(visible_text("\xed\xa0\x80"), "\\xed\\xa0\\x80");  // half a surrogate pair
  EXPECT_EQ(visible_text("\xf5\x80\x80\x80"), "\\xf5\\x80\\x80\\x80");
}

TEST(VisibleText, tells_utf8_from_other_bytes) {
  EXPECT_TRUE(is_utf8("h\xc3\xa5nd\x1b\n"));
  EXPECT_FALSE(is_utf8("h\xe5nd"));
  EXPECT_FALSE(is_utf8("h\xc3"));
}

TEST(VisibleText, what_rearranges_text_is_spelled) {
  EXPECT_EQ(visible_text("a\xe2\x80\xaejbo.exe"), "a\\u{202e}jbo.exe");
  EXPECT_EQ(visible_text("a\xe2\x80\xa8"
                         "b"),
            "a\\u{2028}b");
}

}  // namespace
}  // namespace unsnarl
