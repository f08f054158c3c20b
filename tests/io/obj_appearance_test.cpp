#include <gtest/gtest.h>

#include "folder.h"
#include "image_bytes.h"
#include "unsnarl/document.h"

namespace unsnarl {
namespace {

class ObjAppearance : public ::testing::Test {
 protected:
  Appearance appearance_of(const std::string& obj, const std::string& mtl = mtl_text,
                           std::size_t image_bytes = most_image_bytes) const {
    folder_.write("look.mtl", mtl);
    folder_.write("images/skin.png", png_bytes(4, 2));
    return Document::read(folder_.write("mesh.obj", obj)).appearance(image_bytes);
  }
  static inline const std::string mtl_text = "newmtl red\nKd 1 0 0\nnewmtl skin\nKd 0 0 0\nmap_Kd images\\skin.png\n";
  static inline const std::string vertices = "mtllib look.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
  TestFolder folder_;
};

TEST_F(ObjAppearance, has_colours_and_images) {
  const Appearance look = appearance_of(vertices +
                                        "vt 0 0\nvt 0.5 0.25 0\nvt 1 1\nf 1 2 3\nusemtl red\nf 1 2\nf 1 2 4\n"
                                        "usemtl skin\nf 1/1 2/2/7 3/-1 4//1\nusemtl unknown\nf 2 3 4\n");
  EXPECT_EQ(look.material_of_face, (std::vector<std::int32_t>{-1, 0, 1, -1}));
  ASSERT_EQ(look.materials.size(), 2u);
  EXPECT_EQ(look.materials[0].colour, (std::array<float, 3>{1, 0, 0}));
  EXPECT_EQ(look.materials[0].image, -1);
  EXPECT_EQ(look.materials[1].colour, (std::array<float, 3>{1, 1, 1})) << "the image alone counts";
  EXPECT_EQ(look.materials[1].image, 0);
  ASSERT_EQ(look.images.size(), 1u);
  EXPECT_EQ(look.images[0].bytes, png_bytes(4, 2));
  EXPECT_EQ(look.images[0].width, 4u);
  ASSERT_EQ(look.uv_of_corner.size(), 2u * 13);
  const std::vector<float> quad(look.uv_of_corner.begin() + 12, look.uv_of_corner.begin() + 20);
  EXPECT_EQ(quad, (std::vector<float>{0, 1, 0.5f, 0.75f, 1, 0, 0, 0}));
  EXPECT_TRUE(look.notes.empty());
  EXPECT_TRUE(look.is_worth_showing());
}

TEST_F(ObjAppearance, coordinates_are_scaled_and_shifted) {
  const Appearance look = appearance_of(vertices + "vt 0.5 0.5\nusemtl skin\nf 1/1 2/1 3/1\n",
                                        "newmtl skin\nmap_Kd -s 2 4 -o 0.25 0 images/skin.png\n");
  EXPECT_EQ(look.uv_of_corner[0], 1.25f);
  EXPECT_EQ(look.uv_of_corner[1], -1.0f);
}

TEST_F(ObjAppearance, images_of_other_machines_are_looked_for_beside_the_mesh) {
  folder_.write("skin.png", png_bytes(8, 8));
  const Appearance look =
      appearance_of(vertices + "usemtl skin\nf 1 2 3\n", "newmtl skin\nmap_Kd C:\\work\\skin.png\n");
  ASSERT_EQ(look.images.size(), 1u);
  EXPECT_EQ(look.images[0].width, 8u);
}

TEST_F(ObjAppearance, what_is_missing_is_said) {
  const auto notes = [&](const std::string& obj, const std::string& mtl) { return appearance_of(obj, mtl).notes; };
  EXPECT_NE(notes("mtllib absent.mtl\n" + vertices + "f 1 2 3\n", "").at(0).find("absent.mtl"), std::string::npos);
  EXPECT_NE(notes("mtllib ../look.mtl\n" + vertices + "f 1 2 3\n", "").at(0).find("not in the folder"),
            std::string::npos);
  const std::string skinned = vertices + "usemtl skin\nf 1 2 3\n";
  EXPECT_NE(notes(skinned, "newmtl skin\nmap_Kd gone.png\n").at(0).find("gone.png"), std::string::npos);
  EXPECT_NE(notes(skinned, "newmtl skin\nmap_Kd ../../secret.png\n").at(0).find("not in the folder"),
            std::string::npos);
  EXPECT_NE(notes(skinned, "newmtl skin\nmap_Kd look.mtl\n").at(0).find("neither PNG nor JPEG"), std::string::npos);
  EXPECT_NE(appearance_of(skinned, mtl_text, 10).notes.at(0).find("0 MB"), std::string::npos);
  EXPECT_TRUE(appearance_of(skinned, mtl_text, 10).images.empty());
  EXPECT_TRUE(appearance_of(skinned, mtl_text, 10).uv_of_corner.empty());
}

TEST_F(ObjAppearance, links_out_of_the_folder_are_not_followed) {
  const TestFolder elsewhere;
  std::filesystem::create_symlink(elsewhere.write("other.mtl", mtl_text), folder_.path() / "link.mtl");
  std::filesystem::create_symlink(elsewhere.write("secret.png", png_bytes(3, 3)), folder_.path() / "link.png");
  EXPECT_NE(appearance_of("mtllib link.mtl\n" + vertices + "f 1 2 3\n").notes.at(0).find("a link out of it"),
            std::string::npos);
  const Appearance look = appearance_of(vertices + "usemtl skin\nf 1 2 3\n", "newmtl skin\nmap_Kd link.png\n");
  EXPECT_TRUE(look.images.empty());
  EXPECT_NE(look.notes.at(0).find("a link out of it"), std::string::npos);
}

TEST_F(ObjAppearance, notes_end_somewhere) {
  std::string obj = vertices, mtl;
  for (int i = 0; i < 30; ++i) {
    mtl += "newmtl m" + std::to_string(i) + "\nmap_Kd " + std::to_string(i) + ".png\n";
    obj += "usemtl m" + std::to_string(i) + "\nf 1 2 3\n";
  }
  const std::vector<std::string> notes = appearance_of(obj, mtl).notes;
  ASSERT_EQ(notes.size(), 9u);
  EXPECT_EQ(notes.back(), "So it is with 22 more.");
}

TEST_F(ObjAppearance, one_colour_is_not_worth_showing) {
  EXPECT_FALSE(appearance_of(vertices + "usemtl red\nf 1 2 3\n").is_worth_showing());
  EXPECT_TRUE(appearance_of(vertices + "usemtl red\nf 1 2 3\nusemtl none\nf 1 2 4\n").is_worth_showing());
  EXPECT_FALSE(appearance_of("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").is_worth_showing());
}

}  // namespace
}  // namespace unsnarl
