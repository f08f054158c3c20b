#include "render/font.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

namespace unsnarl {
namespace {

std::string drawn(const std::string& text) {
  Image image(120, 30);
  draw_text(image, text, 2, 4, 14, {0, 0, 0}, 120);
  return {image.pixels.begin(), image.pixels.end()};
}

TEST(Font, every_printable_character_looks_different) {
  std::set<std::string> pictures;
  for (char c = ' '; c <= '~'; ++c) pictures.insert(drawn(std::string(1, c)));
  EXPECT_EQ(pictures.size(), 95U);
}

TEST(Font, what_cannot_be_printed_is_a_blank) {
  EXPECT_EQ(drawn("a\tb\xC3"), drawn("a b "));
}

TEST(Font, width_is_that_of_what_is_drawn) {
  for (const std::string text : {"before", "123 pairs", "W"}) {
    Image image(200, 30);
    draw_text(image, text, 10, 4, 14, {0, 0, 0}, 200);
    int last = 0;
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x)
        if (image.at(x, y)[0] < 128) last = std::max(last, x);
    EXPECT_NEAR(last + 1, 10 + text_width(text, 14), 1.5) << text;
  }
}

TEST(Font, is_cut_off_at_the_given_column_and_at_the_image) {
  Image image(100, 20);
  draw_text(image, "MMMMMMMMMMMMMMM", 0, 2, 14, {0, 0, 0}, 50);
  for (int y = 0; y < image.height; ++y)
    for (int x = 50; x < image.width; ++x) EXPECT_EQ(image.at(x, y)[0], 255);
  EXPECT_NO_THROW(draw_text(image, "outside", -500, -500, 14, {0, 0, 0}, 100));
  EXPECT_NO_THROW(draw_text(image, "outside", 90, 15, 14, {0, 0, 0}, 1000));
}

}  // namespace
}  // namespace unsnarl
