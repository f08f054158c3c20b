#include "render/gif.h"

#include <gif_lib.h>
#include <gtest/gtest.h>

#include <cstring>
#include <vector>

namespace unsnarl {
namespace {

struct Decoded {
  int width = 0, height = 0;
  std::vector<Image> images;  ///< as a viewer shows them
  std::vector<int> delays;    ///< hundredths of a second
};

struct Source {
  const std::string& bytes;
  std::size_t at = 0;
};

int read_bytes(GifFileType* file, GifByteType* to, int size) {
  auto& source = *static_cast<Source*>(file->UserData);
  const std::size_t count = std::min(static_cast<std::size_t>(size), source.bytes.size() - source.at);
  std::memcpy(to, source.bytes.data() + source.at, count);
  source.at += count;
  return static_cast<int>(count);
}

Decoded decode(const std::string& bytes) {
  Source source{bytes};
  int error = 0;
  GifFileType* file = DGifOpen(&source, read_bytes, &error);
  EXPECT_NE(file, nullptr) << GifErrorString(error);
  if (!file) return {};
  EXPECT_EQ(DGifSlurp(file), GIF_OK) << GifErrorString(file->Error);
  Decoded decoded{file->SWidth, file->SHeight, {}, {}};
  Image screen(file->SWidth, file->SHeight, 0);
  for (int f = 0; f < file->ImageCount; ++f) {
    const SavedImage& saved = file->SavedImages[f];
    GraphicsControlBlock control;
    EXPECT_EQ(DGifSavedExtensionToGCB(file, f, &control), GIF_OK);
    const GifImageDesc& part = saved.ImageDesc;
    for (int y = 0; y < part.Height; ++y)
      for (int x = 0; x < part.Width; ++x) {
        const int index = saved.RasterBits[y * part.Width + x];
        if (index == control.TransparentColor) continue;
        const GifColorType& colour = file->SColorMap->Colors[index];
        std::uint8_t* pixel = screen.at(part.Left + x, part.Top + y);
        pixel[0] = colour.Red;
        pixel[1] = colour.Green;
        pixel[2] = colour.Blue;
      }
    decoded.images.push_back(screen);
    decoded.delays.push_back(control.DelayTime);
  }
  DGifCloseFile(file, &error);
  return decoded;
}

// A square that moves over a gradient.
Image scene(int step) {
  Image image(60, 40);
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 60; ++x) {
      std::uint8_t* p = image.at(x, y);
      p[0] = static_cast<std::uint8_t>(4 * x);
      p[1] = static_cast<std::uint8_t>(6 * y);
      p[2] = 128;
      if (x >= 4 * step && x < 4 * step + 10 && y >= 10 && y < 20) p[0] = p[1] = p[2] = 255;
    }
  return image;
}

TEST(Gif, decodes_to_what_was_drawn) {
  std::vector<Image> images;
  for (int step = 0; step < 6; ++step) images.push_back(scene(step));
  const Decoded decoded = decode(encode_gif(images, std::vector<double>{1, 0.1, 0.1, 0.1, 0.1, 2.5}));
  EXPECT_EQ(decoded.width, 60);
  EXPECT_EQ(decoded.height, 40);
  EXPECT_EQ(decoded.delays, (std::vector<int>{100, 10, 10, 10, 10, 250}));
  ASSERT_EQ(decoded.images.size(), images.size());
  for (std::size_t f = 0; f < images.size(); ++f) {
    int farthest = 0;
    for (std::size_t i = 0; i < images[f].pixels.size(); ++i)
      farthest = std::max(farthest, std::abs(int{images[f].pixels[i]} - int{decoded.images[f].pixels[i]}));
    // 2400 colours in 255.
    EXPECT_LE(farthest, 24) << "image " << f;
    const std::uint8_t* white = decoded.images[f].at(4 * static_cast<int>(f) + 5, 15);
    EXPECT_TRUE(white[0] == 255 && white[1] == 255 && white[2] == 255);
  }
}

TEST(Gif, keeps_few_colours_exactly) {
  Image image(8, 8);
  for (int x = 0; x < 8; ++x)
    for (int y = 0; y < 8; ++y) {
      image.at(x, y)[0] = static_cast<std::uint8_t>(30 * x);
      image.at(x, y)[2] = static_cast<std::uint8_t>(30 * y);
    }
  const Decoded decoded = decode(encode_gif(std::vector<Image>{image}, std::vector<double>{1}));
  ASSERT_EQ(decoded.images.size(), 1u);
  EXPECT_EQ(decoded.images[0].pixels, image.pixels);
}

TEST(Gif, stores_little_for_images_that_stay_the_same) {
  const std::vector<Image> one = {scene(0)}, many(50, scene(0));
  const std::string once = encode_gif(one, std::vector<double>(1, 0.1));
  const std::string often = encode_gif(many, std::vector<double>(50, 0.1));
  EXPECT_LT(often.size(), once.size() + 50 * 40);
  EXPECT_EQ(decode(often).images.size(), 50u);
}

TEST(Gif, refuses_what_is_no_animation) {
  const std::vector<Image> different = {Image(8, 8), Image(8, 9)};
  EXPECT_THROW(encode_gif({}, {}), std::invalid_argument);
  EXPECT_THROW(encode_gif(different, std::vector<double>{1, 1}), std::invalid_argument);
  EXPECT_THROW(encode_gif(std::span(different).first(1), std::vector<double>{1, 1}), std::invalid_argument);
  EXPECT_THROW(encode_gif(std::vector<Image>{Image()}, std::vector<double>{1}), std::invalid_argument);
}

}  // namespace
}  // namespace unsnarl
