#include "io/json_text.h"

#include <gtest/gtest.h>

#include "unsnarl/document.h"

namespace unsnarl {
namespace {

TEST(JsonText, finds_values_and_their_places) {
  const std::string text =
      "\xEF\xBB\xBF { \"a\" : [1, -2.5e1 ,true] , \"b\":{\"c\":\"x\\/y\\n\\u00e4\\ud83d\\ude00\"}, \"n\":null }\n";
  const JsonText json(text);
  const JsonText::Value root = json.root();
  ASSERT_TRUE(root.is_object());
  const std::vector<JsonText::Value> a = root["a"].elements();
  ASSERT_EQ(a.size(), 3u);
  EXPECT_EQ(a[0].index(), 1u);
  EXPECT_EQ(a[1].number(), -25.0);
  EXPECT_EQ(a[1].index(), std::nullopt);
  EXPECT_EQ(a[1].text(), "-2.5e1");
  EXPECT_EQ(text.substr(a[1].begin(), a[1].end() - a[1].begin()), "-2.5e1");
  EXPECT_EQ(a[2].number(), std::nullopt);
  EXPECT_EQ(root["b"]["c"].string(), "x/y\n\xC3\xA4\xF0\x9F\x98\x80");
  EXPECT_FALSE(root["b"]["missing"]["deeper"]);
  EXPECT_FALSE(root["n"]["x"]);
  EXPECT_TRUE(root["n"]);
}

TEST(JsonText, keys_may_be_escaped_and_the_last_of_two_counts) {
  const std::string text = R"({"\u0061bc":1,"k":1,"k":2,"":3})";
  const JsonText json(text);
  EXPECT_EQ(json.root()["abc"].index(), 1u);
  EXPECT_EQ(json.root()["k"].index(), 2u);
  EXPECT_EQ(json.root()[""].index(), 3u);
}

TEST(JsonText, empty_containers) {
  const std::string text = R"([ {} , [ ], "" ])";
  const JsonText json(text);
  ASSERT_EQ(json.root().elements().size(), 3u);
  EXPECT_TRUE(json.root().elements()[0].is_object());
  EXPECT_TRUE(json.root().elements()[1].elements().empty());
}

TEST(JsonText, refuses_what_is_not_json) {
  for (const char* text :
       {"",       " ",      "{",    "[1", "[1,]",      "{\"a\"}", "{\"a\":}", "{a:1}",   "[1 2]",       "01",
        "1.",     ".5",     "+1",   "1e", "-",         "nul",     "\"",       "\"\\x\"", "\"\\u12g4\"", "\"\\",
        "\"\\u1", "\"\n\"", "{} x", "[}", "{\"a\":1,}"}) {
    const std::string owned = text;
    EXPECT_THROW(JsonText{owned}, FileError) << text;
  }
}

TEST(JsonText, refuses_bottomless_nesting) {
  const std::string text(1000000, '[');
  EXPECT_THROW(JsonText{text}, FileError);
}

TEST(JsonText, half_a_surrogate_pair_is_no_crash) {
  for (const char* text : {R"("\ud83d")", R"("\ud83dx")", R"("\ud83d\u0041")", R"("\ude00")"}) {
    const std::string owned = text;
    EXPECT_FALSE(JsonText(owned).root().string().empty());
  }
}

}  // namespace
}  // namespace unsnarl
