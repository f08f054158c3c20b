#include "io/mtl.h"

#include <gtest/gtest.h>

namespace unsnarl {
namespace {

std::map<std::string, MtlMaterial, std::less<>> materials_of(std::string_view text) {
  std::map<std::string, MtlMaterial, std::less<>> materials;
  read_mtl(text, materials);
  return materials;
}

TEST(Mtl, reads_colours_and_images) {
  const auto materials = materials_of(
      "# by hand\nKd 1 0 0\nnewmtl skin tone\r\n  Kd 0.25 0.5 7\nNs 10\nmap_Kd skin 1.png\n"
      "newmtl tiles\nmap_Kd -blendu on -s 2 3 1 -o 0.5 -mm 0 1 -clamp on tiles.jpg\nnewmtl plain");
  ASSERT_EQ(materials.size(), 3u);
  const MtlMaterial& skin = materials.at("skin tone");
  EXPECT_EQ(skin.colour, (std::array<float, 3>{0.25f, 0.5f, 1}));
  EXPECT_EQ(skin.image, "skin 1.png");
  EXPECT_FALSE(skin.clamp);
  const MtlMaterial& tiles = materials.at("tiles");
  EXPECT_EQ(tiles.image, "tiles.jpg");
  EXPECT_EQ(tiles.scale, (std::array<double, 2>{2, 3}));
  EXPECT_EQ(tiles.offset, (std::array<double, 2>{0.5, 0}));
  EXPECT_TRUE(tiles.clamp);
  EXPECT_EQ(materials.at("plain").colour, (std::array<float, 3>{1, 1, 1}));
}

TEST(Mtl, passes_over_what_makes_no_sense) {
  const auto materials = materials_of("newmtl a\nKd 1 2\nKd x y z\nmap_Kd -clamp\nmap_Kd -s\n\xff\x00 0\nnewmtl\n");
  EXPECT_EQ(materials.at("a").colour, (std::array<float, 3>{1, 1, 1}));
  EXPECT_EQ(materials.at("a").image, "");
  EXPECT_TRUE(materials_of("").empty());
}

}  // namespace
}  // namespace unsnarl
