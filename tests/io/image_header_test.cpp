#include "io/image_header.h"

#include <gtest/gtest.h>

#include "image_bytes.h"

namespace unsnarl {
namespace {

TEST(ImageHeader, tells_size_and_kind) {
  const std::optional<ImageHeader> png = image_header(png_bytes(70000, 3));
  ASSERT_TRUE(png);
  EXPECT_EQ(png->media_type, "image/png");
  EXPECT_EQ(png->width, 70000u);
  EXPECT_EQ(png->height, 3u);
  const std::optional<ImageHeader> jpeg = image_header(jpeg_bytes(640, 480));
  ASSERT_TRUE(jpeg);
  EXPECT_EQ(jpeg->media_type, "image/jpeg");
  EXPECT_EQ(jpeg->width, 640u);
  EXPECT_EQ(jpeg->height, 480u);
}

TEST(ImageHeader, of_what_is_no_image_there_is_none) {
  EXPECT_FALSE(image_header(""));
  EXPECT_FALSE(image_header("GIF89a........................"));
  EXPECT_FALSE(image_header("RIFF....WEBPVP8 ................."));
  EXPECT_FALSE(image_header(png_bytes(0, 5)));
  for (const std::string& whole : {png_bytes(20, 30), jpeg_bytes(20, 30)}) {
    // The JPEG's last four bytes come after what is read.
    const std::size_t needed = whole.size() - (whole[0] == '\xFF' ? 4 : 0);
    for (std::size_t size = 0; size < needed; ++size) EXPECT_FALSE(image_header(whole.substr(0, size))) << size;
  }
}

}  // namespace
}  // namespace unsnarl
