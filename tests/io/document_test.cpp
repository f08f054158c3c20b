#include "document_checks.h"

#include <limits>

namespace unsnarl {
namespace {

const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

TEST(Document, FormatByExtension) {
  EXPECT_EQ(format_from_extension("a/b.c/Mesh.OBJ"), Format::obj);
  EXPECT_EQ(format_from_extension("gltf"), Format::gltf);
  EXPECT_EQ(format_from_extension(".stl"), Format::stl);
  EXPECT_EQ(format_from_extension("mesh.fbx"), std::nullopt);
  EXPECT_EQ(format_from_extension("folder.obj/mesh"), std::nullopt);
  EXPECT_EQ(format_from_extension(""), std::nullopt);
  for (const Format format : {Format::obj, Format::off, Format::ply, Format::stl, Format::glb, Format::gltf}) {
    EXPECT_EQ(format_from_extension(to_string(format)), format);
  }
}

TEST(Document, RefusesPositionsThatAreNotItsOwn) {
  const Document document = Document::parse(triangle, Format::obj);
  std::vector<double> positions = document.surface().positions;
  positions.pop_back();
  EXPECT_THROW(document.patched(positions, false), std::invalid_argument);
  positions.push_back(std::numeric_limits<double>::quiet_NaN());
  EXPECT_THROW(document.as_written(positions, false), std::invalid_argument);
}

TEST(Document, CanBeMoved) {
  Document document = Document::parse(triangle, Format::obj);
  const Document other = std::move(document);
  EXPECT_EQ(patched_bytes(other, other.surface().positions), triangle);
}

}  // namespace
}  // namespace unsnarl
