#include <filesystem>
#include <limits>

#include "document_checks.h"
#include "io/formats.h"

namespace unsnarl {
namespace {

const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

TEST(Document, format_by_extension) {
  EXPECT_EQ(format_from_extension("a/b.c/Mesh.OBJ"), Format::obj);
  EXPECT_EQ(format_from_extension("gltf"), Format::gltf);
  EXPECT_EQ(format_from_extension(".stl"), Format::stl);
  EXPECT_EQ(format_from_extension("mesh.fbx"), std::nullopt);
  EXPECT_EQ(format_from_extension("folder.obj/mesh"), std::nullopt);
  EXPECT_EQ(format_from_extension(""), std::nullopt);
  EXPECT_EQ(format_from_extension("lh.pial"), Format::surf);
  EXPECT_EQ(format_from_extension("freesurfer"), Format::surf);
  EXPECT_EQ(format_from_extension("pial inflated"), std::nullopt);
  EXPECT_EQ(format_from_extension("lh.pial.surf.gii"), Format::gii);
  for (const FormatEntry& entry : formats) EXPECT_EQ(format_from_extension(to_string(entry.format)), entry.format);
}

TEST(Document, names_its_formats) {
  EXPECT_TRUE(format_names().starts_with("obj, off, ply, stl, glb, gltf, surf, gii"));
  EXPECT_NE(format_names(" or ").find(" or "), std::string::npos);
}

TEST(Document, free_surfer_surfaces_need_no_extension) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "document_test";
  std::filesystem::create_directories(folder);
  const auto error_of = [&](const char* name, const std::string& bytes) -> std::string {
    write_atomically(folder / name, bytes);
    try {
      return std::string("read as ").append(to_string(Document::read(folder / name).format()));
    } catch (const FileError& error) {
      return error.what();
    }
  };
  EXPECT_EQ(
      error_of("lh.pial_semi", std::string("\xFF\xFF\xFE\n\n\0\0\0\0\0\0\0\0", 13)),
      (folder / "lh.pial_semi").string() +
          ": the file has 0 vertices and no faces, so there is nothing to repair; it is cut short, or holds points "
          "or lines only");
  EXPECT_PRED2(message_contains, error_of("mesh", triangle), "neither the extension nor the content tells the format");
  EXPECT_PRED2(message_contains, error_of("a.FBX", "anything"), "FBX files are not read; import it into Blender");
  EXPECT_PRED2(message_contains, error_of("a.usdz", "PK"), "USD files are not read");
  EXPECT_PRED2(message_contains, error_of("a.obj", "Kaydara FBX Binary  "), "FBX files are not read");
  EXPECT_PRED2(message_contains, error_of("a", "BLENDER-v300"), "Blend files are not read");
  EXPECT_PRED2(message_contains, error_of("a.ply", "#usda 1.0\n"), "USD files are not read");
  std::filesystem::remove_all(folder);
}

TEST(Document, what_has_no_faces_is_refused) {
  const std::string gii_points =
      "<GIFTI><DataArray Intent=\"NIFTI_INTENT_POINTSET\" DataType=\"NIFTI_TYPE_FLOAT32\" Dimensionality=\"2\" "
      "Dim0=\"1\" Dim1=\"3\" Encoding=\"ASCII\"><Data>0 0 0</Data></DataArray><DataArray "
      "Intent=\"NIFTI_INTENT_TRIANGLE\" DataType=\"NIFTI_TYPE_INT32\" Dimensionality=\"2\" Dim0=\"0\" Dim1=\"3\" "
      "Encoding=\"ASCII\"><Data></Data></DataArray></GIFTI>";
  const std::string vtp_points =
      "<VTKFile type=\"PolyData\" byte_order=\"LittleEndian\"><PolyData><Piece NumberOfPoints=\"1\"><Points><DataArray "
      "type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0</DataArray></Points></Piece></PolyData>"
      "</VTKFile>";
  const std::vector<std::pair<Format, std::string>> files = {
      {Format::obj, "v 0 0 0\nv 1 0 0\nv 0 1 0\n"},
      {Format::obj, "v 0 0 0\nv 1 0 0\nl 1 2\nf 1 2\n"},
      {Format::obj, "# nothing\n"},
      {Format::off, "OFF\n1 0 0\n0 0 0\n"},
      {Format::ply,
       "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n"
       "0 0 0\n"},
      {Format::stl, "solid a\nendsolid a\n"},
      {Format::gltf, R"({"asset":{"version":"2.0"}})"},
      {Format::gii, gii_points},
      {Format::vtk, "# vtk DataFile Version 3.0\na\nASCII\nDATASET POLYDATA\nPOINTS 1 float\n0 0 0\n"},
      {Format::vtk,
       "# vtk DataFile Version 3.0\na\nASCII\nDATASET POLYDATA\nPOINTS 2 float\n0 0 0 1 1 1\nLINES 1 3\n2 0 1\n"},
      {Format::vtp, vtp_points},
      {Format::msh, "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n1\n1 0 0 0\n$EndNodes\n"},
      {Format::inp, "*NODE\n1, 0, 0, 0\n"}};
  for (const auto& [format, bytes] : files) {
    try {
      Document::parse(bytes, format);
      ADD_FAILURE() << "read: " << bytes;
    } catch (const FileError& error) {
      EXPECT_STRNE(error.what(), "");
    }
  }
}

TEST(Document, refuses_positions_that_are_not_its_own) {
  const Document document = Document::parse(triangle, Format::obj);
  std::vector<double> positions = document.surface().positions;
  positions.pop_back();
  EXPECT_THROW(document.patched(positions, false), std::invalid_argument);
  positions.push_back(std::numeric_limits<double>::quiet_NaN());
  EXPECT_THROW(document.as_written(positions, false), std::invalid_argument);
}

TEST(Document, can_be_moved) {
  Document document = Document::parse(triangle, Format::obj);
  const Document other = std::move(document);
  EXPECT_EQ(patched_bytes(other, other.surface().positions), triangle);
}

/// The same triangle and quad (STL: triangle) in every text format.
const std::vector<std::pair<Format, std::string>> texts = {
    {Format::obj, "# a\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1.5 0\nf 1 2 3\nf -4 -3 -2 -1\n"},
    {Format::off, "OFF # a\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1.5 0\n3 0 1 2\n4 0 1 2 3\n"},
    {Format::ply,
     "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\nproperty double z\n"
     "element face 2\nproperty list uchar int vertex_indices\nend_header\n"
     "0 0 0\n1 0 0\n1 1 0\n0 1.5 0\n3 0 1 2\n4 0 1 2 3\n"},
    {Format::stl,
     "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1.5 0\nendloop\nendfacet\n"
     "endsolid\n"}};

std::string with_line_ends(const std::string& text, const std::string& line_end) {
  std::string result;
  for (const char c : text) result += c == '\n' ? line_end : std::string(1, c);
  return result;
}

TEST(Document, line_ends_and_a_missing_last_one_do_not_matter) {
  for (const auto& [format, text] : texts) {
    const Surface expected = Document::parse(text, format).surface();
    for (const char* line_end : {"\n", "\r\n", "\r"})
      for (const bool is_last_missing : {false, true}) {
        std::string bytes = with_line_ends(is_last_missing ? text.substr(0, text.size() - 1) : text, line_end);
        const Document document = Document::parse(bytes, format);
        EXPECT_EQ(document.surface().positions, expected.positions) << to_string(format);
        EXPECT_EQ(document.surface().corners, expected.corners) << to_string(format);
        check_patching(bytes, format);
      }
  }
}

TEST(Document, coordinates_that_are_not_finite_are_refused_by_place) {
  for (const auto& [format, text] : texts)
    for (const char* word : {"nan", "NaN", "-nan", "inf", "-inf", "Infinity", "1e999", "-1e999", "1e99999999999"}) {
      const std::string error = parse_error(replaced(text, "1.5", word), format);
      EXPECT_NE(error.find("line "), std::string::npos) << to_string(format) << " " << word << ": " << error;
      EXPECT_NE(error.find(word), std::string::npos) << to_string(format) << " " << word << ": " << error;
    }
}

}  // namespace
}  // namespace unsnarl
