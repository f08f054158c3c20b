#include "io/content.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "io/mesh_file.h"

namespace unsnarl {
namespace {

TEST(Content, tells_formats_by_their_first_bytes) {
  const std::vector<std::pair<std::string, Format>> starts = {
      {"ply\nformat ascii 1.0\n", Format::ply},
      {"OFF\n3 1 0\n", Format::off},
      {"glTF\x02", Format::glb},
      {" {\"asset\": {\"version\": \"2.0\"}}", Format::gltf},
      {"\xFF\xFF\xFEmade by\n\n", Format::surf},
      {"<?xml version=\"1.0\"?>\n<GIFTI Version=\"1.0\">", Format::gii},
      {"<VTKFile type=\"PolyData\">", Format::vtp},
      {"# vtk DataFile Version 3.0\n", Format::vtk},
      {"$MeshFormat\n2.2 0 8\n", Format::msh},
      {"*HEADING\n", Format::inp},
      {"PK\x03\x04", Format::threemf},
      {"solid part\n facet normal 0 0 1\n", Format::stl}};
  for (const auto& [start, format] : starts) {
    EXPECT_EQ(format_of_content(start), format) << start;
    EXPECT_NO_THROW(refuse_other_content(start, format)) << start;
    EXPECT_THROW(refuse_other_content(start, Format::obj), FileError) << start;
  }
}

TEST(Content, leaves_alone_what_could_be_anything) {
  // Binary STL may begin with any 80 bytes, and OBJ with any comment or keyword.
  for (const std::string& start : {std::string(), std::string("v 0 0 0\n"), std::string("# solid facet normal"),
                                   std::string("solid but binary ") + std::string(80, '\0'), std::string("{}"),
                                   std::string("<svg>"), std::string(checked_start - 1, '\0')}) {
    EXPECT_FALSE(format_of_content(start)) << start;
    EXPECT_NO_THROW(refuse_other_content(start, Format::stl)) << start;
  }
  EXPECT_THROW(refuse_other_content(std::string(checked_start, '\0'), Format::stl), FileError);
}

}  // namespace
}  // namespace unsnarl
