#include "unsnarl/depth_limit.h"

#include <gtest/gtest.h>

#include <string>

#include "io/parse_json.h"
#include "unsnarl/document.h"

namespace unsnarl {
namespace {

std::string brackets(std::size_t depth) {
  return std::string(depth, '[') + std::string(depth, ']');
}

TEST(DepthLimit, counts_open_brackets_outside_of_strings) {
  constexpr std::size_t none = std::string_view::npos;
  EXPECT_EQ(too_deep_bracket(brackets(deepest_nesting)), none);
  EXPECT_EQ(too_deep_bracket(brackets(deepest_nesting + 1)), deepest_nesting);
  std::string many = "[";
  for (std::size_t k = 0; k < 2 * deepest_nesting; ++k) many += "{\"a\": []}, ";
  EXPECT_EQ(too_deep_bracket(many), none);
  EXPECT_EQ(too_deep_bracket("\"\\\"" + brackets(1000) + "\""), none) << "within a string";
  EXPECT_EQ(too_deep_bracket("\"\\\\\"" + brackets(1000)), 4 + deepest_nesting) << "behind a string";
  EXPECT_EQ(too_deep_bracket("\"" + brackets(1000)), none);
  EXPECT_EQ(too_deep_bracket("]]]]" + brackets(deepest_nesting + 1)), 4 + deepest_nesting);
}

TEST(DepthLimit, json_that_is_nested_too_deeply_is_refused_before_it_is_built) {
  EXPECT_EQ(parse_json(brackets(deepest_nesting)).size(), 1u);
  for (const std::string& text : {brackets(deepest_nesting + 1), brackets(1000000), std::string(1000000, '[')}) {
    try {
      parse_json(text);
      ADD_FAILURE() << "accepted";
    } catch (const FileError& error) {
      EXPECT_STREQ(error.what(), "byte 256: nested too deeply: more than 256 brackets within each other");
    }
  }
}

}  // namespace
}  // namespace unsnarl
