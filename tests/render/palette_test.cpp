#include "render/palette.h"

#include <gtest/gtest.h>

#include <set>

namespace unsnarl {
namespace {

TEST(Palette, has_white_and_no_more_colours_than_allowed) {
  Image image(64, 64);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = static_cast<std::uint8_t>(i * 2654435761U >> 24);
  for (const int size : {2, 16, 255, 256}) {
    const Palette palette(std::vector<Image>{image}, size);
    EXPECT_LE(palette.colours().size(), static_cast<std::size_t>(size));
    EXPECT_EQ(palette.colours()[0], (std::array<std::uint8_t, 3>{255, 255, 255}));
  }
  EXPECT_THROW(Palette(std::vector<Image>{image}, 257), std::invalid_argument);
}

TEST(Palette, small_areas_keep_their_colour) {
  // 20 red pixels on a large grey ramp.
  Image image(256, 256);
  for (int y = 0; y < 256; ++y)
    for (int x = 0; x < 256; ++x)
      for (int c = 0; c < 3; ++c) image.at(x, y)[c] = static_cast<std::uint8_t>(x);
  const std::array<std::uint8_t, 3> red = {220, 20, 20};
  for (int x = 0; x < 20; ++x) std::copy(red.begin(), red.end(), image.at(x, 0));
  const Palette palette(std::vector<Image>{image}, 16);
  EXPECT_EQ(palette.colours()[palette.nearest(red.data())], red);
}

TEST(Palette, nearest_is_nearest_to_a_bin) {
  Image image(32, 32);
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 32; ++x) {
      image.at(x, y)[0] = static_cast<std::uint8_t>(8 * x);
      image.at(x, y)[1] = static_cast<std::uint8_t>(8 * y);
    }
  const Palette palette(std::vector<Image>{image}, 64);
  const auto squared = [&](const std::uint8_t* p, std::size_t colour) {
    int sum = 0;
    for (std::size_t k = 0; k < 3; ++k)
      sum += (p[k] - palette.colours()[colour][k]) * (p[k] - palette.colours()[colour][k]);
    return sum;
  };
  for (std::size_t i = 0; i < image.pixels.size(); i += 3)
    for (std::size_t c = 0; c < palette.colours().size(); ++c)
      EXPECT_LE(squared(&image.pixels[i], palette.nearest(&image.pixels[i])), squared(&image.pixels[i], c));
}

}  // namespace
}  // namespace unsnarl
