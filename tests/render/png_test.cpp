#include "render/png.h"

#include <gtest/gtest.h>
#include <png.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace unsnarl {
namespace {

Image pattern(int width, int height) {
  Image image(width, height);
  for (std::size_t k = 0; k < image.pixels.size(); ++k) image.pixels[k] = static_cast<std::uint8_t>(k * 37 + k / 11);
  return image;
}

/// By libpng's other interface than the one that the encoder uses.
Image decoded(const std::string& bytes) {
  struct Source {
    const std::string* bytes;
    std::size_t at;
  } source{&bytes, 0};
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_set_read_fn(png, &source, [](png_structp p, png_bytep out, std::size_t count) {
    auto* from = static_cast<Source*>(png_get_io_ptr(p));
    if (from->at + count > from->bytes->size()) png_error(p, "truncated");
    std::memcpy(out, from->bytes->data() + from->at, count);
    from->at += count;
  });
  png_read_png(png, info, PNG_TRANSFORM_IDENTITY, nullptr);
  EXPECT_EQ(png_get_color_type(png, info), PNG_COLOR_TYPE_RGB);
  EXPECT_EQ(png_get_bit_depth(png, info), 8);
  Image image(static_cast<int>(png_get_image_width(png, info)), static_cast<int>(png_get_image_height(png, info)));
  png_bytepp rows = png_get_rows(png, info);
  for (int y = 0; y < image.height; ++y) std::memcpy(image.at(0, y), rows[y], std::size_t{3} * image.width);
  png_destroy_read_struct(&png, &info, nullptr);
  return image;
}

TEST(Png, decodes_to_the_same_pixels) {
  for (const auto& [width, height] : {std::pair(1, 1), std::pair(7, 3), std::pair(120, 77)}) {
    const Image image = pattern(width, height);
    const Image back = decoded(encode_png(image));
    EXPECT_EQ(back.width, width);
    EXPECT_EQ(back.height, height);
    EXPECT_EQ(back.pixels, image.pixels);
  }
}

TEST(Png, refuses_an_empty_image) {
  EXPECT_THROW(encode_png(Image()), std::invalid_argument);
}

TEST(Png, writes_the_file_and_nothing_beside_it) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "unsnarl_png_test";
  std::filesystem::create_directories(folder);
  const Image image = pattern(20, 10);
  write_png(image, folder / "picture.png");
  std::ifstream file(folder / "picture.png", std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  file.close();  // Windows removes no file that is open
  EXPECT_EQ(bytes, encode_png(image));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), std::filesystem::directory_iterator()), 1);
  std::filesystem::remove_all(folder);
}

TEST(Png, names_the_path_that_cannot_be_written) {
  const auto path = std::filesystem::path(testing::TempDir()) / "no_such_folder" / "picture.png";
  try {
    write_png(pattern(2, 2), path);
    FAIL() << "written into a folder that does not exist";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("no_such_folder"), std::string::npos);
  }
}

}  // namespace
}  // namespace unsnarl
