#include "document_checks.h"

namespace unsnarl::off_files {
namespace {

const std::string tetrahedron =
    "OFF # a comment\n"
    "# another\n"
    "4 4 6\n"
    "\n"
    "0 0 0\n"
    "1.000 0  0   # a vertex\n"
    "0 1 0\n"
    "0 0 +1\n"
    "3 0 2 1  255 0 0\n"
    "3  0 1 3\n"
    "3 0 3 2 0.5 0.5 0.5 1\n"
    "3 1 2 3";

Document parse(const std::string& text) {
  return Document::parse(text, Format::off);
}

TEST(Off, reads_positions_and_faces) {
  const Document document = parse(tetrahedron);
  EXPECT_EQ(document.surface().positions, (std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}));
  EXPECT_EQ(document.surface().corners, (std::vector<std::int32_t>{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}));
}

TEST(Off, reads_every_header) {
  const std::string rest = "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  for (const char* header :
       {"OFF\n3 1 0\n", "OFF 3 1 0\n", "OFF\n3\n1 0\n", "OFF 3 1\n", "OFF3 1 0\n", "\n# c\nOFF\r\n3 1 0\r\n"}) {
    EXPECT_EQ(parse(header + rest).surface().corners, (std::vector<std::int32_t>{0, 1, 2})) << header;
    check_patching(header + rest, Format::off);
  }
}

TEST(Off, passes_on_whatever_else_a_vertex_has) {
  check_patching("COFF\n3 1 0\n0 0 0 255 0 0\n1 0 0 0 255 0\n0 1 0 0 0 255\n3 0 1 2\n", Format::off);
  check_patching("NOFF\n3 1 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n3 0 1 2\n", Format::off);
  check_patching(
      "STCNOFF\n3 1 0\n0 0 0 0 0 1 1 1 1 1 0.5 0.5\n1 0 0 0 0 1 1 1 1 1 0.5 0.5\n0 1 0 0 0 1 1 1 1 1 0.5 0.5\n3 0 1 2",
      Format::off);
}

TEST(Off, lines_need_not_match_vertices) {
  const std::string text = "NOFF 3 1 0 0 0 0 0 0 1 1 0 0 0 0 1 0 1 0 0 0 1 3 0 1 2";
  EXPECT_EQ(parse(text).surface().positions, (std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0}));
  check_patching(text, Format::off);
}

TEST(Off, keeps_every_promise_of_patching) {
  check_patching(tetrahedron, Format::off);
  check_patching("OFF\r\n5 2 0\r\n0 0 0\r\n1 0 0\r\n0 1 0\r\n1e-300 7 7\r\n1 1 1\r\n4 0 1 2 3\r\n3 1 2 4\r\n",
                 Format::off);
}

TEST(Off, only_the_moved_coordinate_changes) {
  const Document document = parse(tetrahedron);
  std::vector<double> moved = document.surface().positions;
  moved[3] = 1.25;
  EXPECT_EQ(patched_bytes(document, moved), replaced(tetrahedron, "1.000 0", "1.25 0"));
}

TEST(Off, errors_say_what_and_where) {
  EXPECT_PARSE_ERROR("", Format::off, "empty");
  EXPECT_PARSE_ERROR("solid", Format::off, "line 1: 'solid' where 'OFF' should be");
  EXPECT_PARSE_ERROR("4OFF\n1 0 0\n0 0 0 0\n", Format::off, "another dimension");
  EXPECT_PARSE_ERROR("nOFF 3\n", Format::off, "another dimension");
  EXPECT_PARSE_ERROR("OFF BINARY\n", Format::off, "binary OFF is not supported");
  EXPECT_PARSE_ERROR("OFF\n4 x 0\n0 0 0\n0 0 0\n", Format::off, "line 2: 'x' where the number of faces should be");
  EXPECT_PARSE_ERROR("OFF\n-1 0 0\n", Format::off, "number of vertices");
  EXPECT_PARSE_ERROR("OFF\n1000000000 1 0\n0 0 0\n", Format::off, "promises 1000000000 vertices");
  EXPECT_PARSE_ERROR("OFF\n2 1 0\n0 0 0\n0 0 inf\n3 0 1 1\n", Format::off, "line 4: coordinate 'inf' of vertex 1");
  EXPECT_PARSE_ERROR("OFF\n3 1 0\n0 0 0\n0 0 1\n1 0 0\n3 0 1 3\n", Format::off,
                     "line 6: face 0 uses vertex 3, but the file has 3 vertices");
  EXPECT_PARSE_ERROR("OFF\n3 2 0\n0 0 0\n0 0 1\n1 0 0\n3 0 1 2\n", Format::off, "ends after 1 of 2 faces");
  EXPECT_PARSE_ERROR("OFF\n3 1 0\n0 0 0\n0 0 1\n1 0 0\n99 0 1 2\n", Format::off, "face 0 claims 99 corners");
}

TEST(Off, survives_damage) {
  check_damage(tetrahedron, Format::off);
}

}  // namespace
}  // namespace unsnarl::off_files
