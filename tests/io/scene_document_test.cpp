#include "unsnarl/scene_document.h"

#include <gtest/gtest.h>

#include "folder.h"
#include "image_bytes.h"

namespace unsnarl {
namespace {

TEST(SceneDocument, appearances_of_its_files_are_joined) {
  const TestFolder folder;
  folder.write("a.mtl", "newmtl red\nKd 1 0 0\nnewmtl skin\nmap_Kd a.png\n");
  folder.write("b.mtl", "newmtl skin\nmap_Kd b.png\nnewmtl gone\nmap_Kd gone.png\n");
  folder.write("a.png", png_bytes(4, 4, 100));
  folder.write("b.png", png_bytes(8, 8, 200));
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 1 1\n";
  const auto scene = [&] {
    std::vector<Document> documents;
    documents.push_back(Document::read(
        folder.write("a.obj", "mtllib a.mtl\n" + vertices + "usemtl red\nf 1 2 3\nusemtl skin\nf 1/1 2/1 3/1\n")));
    documents.push_back(Document::read(folder.write("plain.obj", vertices + "f 1 2 3\n")));
    documents.push_back(Document::read(
        folder.write("b.obj", "mtllib b.mtl\n" + vertices + "usemtl skin\nf 1/1 2/1 3/1\nusemtl gone\nf 3 2 1\n")));
    return SceneDocument(std::move(documents), {"a", "plain", "b"});
  }();

  const Appearance look = scene.appearance();
  EXPECT_EQ(look.material_of_face, (std::vector<std::int32_t>{0, 1, -1, 2, 3}));
  ASSERT_EQ(look.images.size(), 2u);
  EXPECT_EQ(look.images[1].width, 8u);
  EXPECT_EQ(look.materials[1].image, 0);
  EXPECT_EQ(look.materials[2].image, 1);
  EXPECT_EQ(look.materials[3].image, -1);
  ASSERT_EQ(look.uv_of_corner.size(), 2u * 15);
  EXPECT_EQ(look.uv_of_corner[2 * 3], 1);
  EXPECT_EQ(look.uv_of_corner[2 * 6], 0) << "the plain file has no places in images";
  EXPECT_EQ(look.uv_of_corner[2 * 9], 1);
  ASSERT_EQ(look.notes.size(), 1u);
  EXPECT_EQ(look.notes[0].rfind("b: Image gone.png is left out", 0), 0u);

  const Appearance less = scene.appearance(200);
  EXPECT_EQ(less.images.size(), 1u) << "the limit holds for all files together";
  EXPECT_EQ(less.notes.size(), 2u);
}

}  // namespace
}  // namespace unsnarl
