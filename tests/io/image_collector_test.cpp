#include "io/image_collector.h"

#include <gtest/gtest.h>

#include "image_bytes.h"
#include "unsnarl/document.h"

namespace unsnarl {
namespace {

TEST(ImageCollector, takes_each_image_once) {
  Appearance appearance;
  ImageCollector images(appearance, 1000);
  int taken = 0;
  const auto take = [&] { return ++taken, png_bytes(2, 2); };
  EXPECT_EQ(images.add("a", take), 0);
  EXPECT_EQ(images.add("b", take), 1);
  EXPECT_EQ(images.add("a", take), 0);
  EXPECT_EQ(taken, 2);
  EXPECT_EQ(appearance.images.size(), 2u);
  EXPECT_TRUE(appearance.notes.empty());
}

TEST(ImageCollector, says_what_it_leaves_out) {
  Appearance appearance;
  ImageCollector images(appearance, 1000);
  const auto note_on = [&](const std::string& name, const std::string& bytes) {
    EXPECT_EQ(images.add(name, [&] { return bytes; }), -1);
    return appearance.notes.back();
  };
  EXPECT_EQ(note_on("text.png", "hello"), "Image text.png is left out: neither PNG nor JPEG.");
  EXPECT_EQ(note_on("bomb.png", png_bytes(20000, 20000)),
            "Image bomb.png is left out: 20000 x 20000 pixels; 100 million are the most.");
  EXPECT_EQ(images.add("bomb.png", [] { return png_bytes(1, 1); }), -1) << "the same image";
  EXPECT_EQ(images.add("missing.png", []() -> std::string { throw FileError("no such file"); }), -1);
  EXPECT_EQ(appearance.notes.back(), "Image missing.png is left out: no such file.");
  EXPECT_EQ(appearance.notes.size(), 3u);
}

TEST(ImageCollector, all_images_together_have_a_limit) {
  Appearance appearance;
  ImageCollector images(appearance, 2'000'000);
  EXPECT_EQ(images.add("first", [] { return png_bytes(1, 1, 1'200'000); }), 0);
  EXPECT_EQ(images.add("second", [] { return png_bytes(1, 1, 900'000); }), -1);
  EXPECT_EQ(appearance.notes.back(), "Image second is left out: 0.9 MB; all images together may have 2 MB.");
  EXPECT_EQ(images.add("third", [] { return png_bytes(1, 1, 700'000); }), 1);
}

TEST(ImageCollector, reads_only_below_the_folder) {
  Appearance appearance;
  const ImageCollector images(appearance, 1000);
  EXPECT_THROW(images.read_beside("/tmp", "../etc/passwd"), FileError);
  EXPECT_THROW(images.read_beside("/tmp", "/etc/passwd"), FileError);
  EXPECT_THROW(images.read_beside("/tmp", ""), FileError);
}

}  // namespace
}  // namespace unsnarl
