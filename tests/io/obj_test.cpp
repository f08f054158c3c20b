#include "document_checks.h"

namespace unsnarl::obj_files {
namespace {

const std::string tetrahedron =
    "# a comment \\\n"
    "mtllib some.mtl\n"
    "o Body\n"
    "v 0 0 0\n"
    "v   1.000000\t0 -0.0   0.5 0.25 1 # coloured\n"
    "vt 0.5 0.5\n"
    "vn 0 0 1\n"
    "g left arm\n"
    "usemtl skin\n"
    "v 0 1.5e0 +0.0 1.0\n"
    "f 1/1/1 3/1/1 2/1/1\n"
    "v 0 0 1.\n"
    "s 1\n"
    "usemtl cloth\n"
    "f -4//1 2//1 \\\n  4//1\n"
    "f -4/1 -1/1 -2/1\n"
    "l 1 2\n"
    "p 1\n"
    "f 2 3 4";

Document parse(const std::string& text) {
  return Document::parse(text, Format::obj);
}

TEST(Obj, reads_positions_and_corners_of_every_kind) {
  const Document document = parse(tetrahedron);
  EXPECT_EQ(document.surface().positions, (std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1.5, 0, 0, 0, 1}));
  EXPECT_EQ(document.surface().corners, (std::vector<std::int32_t>{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}));
  EXPECT_TRUE(document.surface().offsets.empty());
  EXPECT_FALSE(document.stores_float32());
  EXPECT_TRUE(document.notes().empty());
}

TEST(Obj, marks_at_the_end_of_the_file_are_no_line) {
  using namespace std::string_literals;
  const std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  for (const std::string& end : {"\0"s, "\x1a"s, "\x1a\0\0\0"s}) {
    const Document document = Document::parse(text + end, Format::obj);
    EXPECT_EQ(document.surface().corners, (std::vector<std::int32_t>{0, 1, 2}));
    EXPECT_EQ(patched_bytes(document, document.surface().positions), text + end);
    EXPECT_PARSE_ERROR("v 0 0 0\n" + end + text, Format::obj, "this is not text");
  }
}

TEST(Obj, polygons_have_offsets) {
  const Document document = parse("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 2 0\nf 1 2 3\nf 1 2 3 4\nf 1 2 5 3 4\n");
  EXPECT_EQ(document.surface().offsets, (std::vector<std::int32_t>{0, 3, 7, 12}));
}

TEST(Obj, faces_may_come_before_their_vertices) {
  const Document document = parse("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 1 1 0\n");
  EXPECT_EQ(document.surface().corners, (std::vector<std::int32_t>{0, 1, 2}));
}

TEST(Obj, labels_of_faces) {
  const std::vector<FaceLabels> labels = parse(tetrahedron).face_labels();
  ASSERT_EQ(labels.size(), 3u);
  EXPECT_EQ(labels[0].kind, "object");
  EXPECT_EQ(labels[0].names, std::vector<std::string>{"Body"});
  EXPECT_EQ(labels[1].kind, "group");
  EXPECT_EQ(labels[1].names, std::vector<std::string>{"left arm"});
  EXPECT_EQ(labels[2].kind, "material");
  EXPECT_EQ(labels[2].names, (std::vector<std::string>{"skin", "cloth"}));
  EXPECT_EQ(labels[2].of_face, (std::vector<std::int32_t>{0, 1, 1, 1}));
}

TEST(Obj, faces_before_the_first_name_have_none) {
  const Document document = parse("v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\ng a\nf 1 2 3\ng b\nf 1 2 3\ng a\nf 1 3 2\n");
  ASSERT_EQ(document.face_labels().size(), 1u);
  EXPECT_EQ(document.face_labels()[0].of_face, (std::vector<std::int32_t>{-1, 0, 1, 0}));
}

TEST(Obj, keeps_every_promise_of_patching) {
  check_patching(tetrahedron, Format::obj);
  check_patching("\xEF\xBB\xBFv 1 2 3\r\nv 4 5 6\r\nv 7 8 10 1\r\nf 1 2 3\r\n", Format::obj);  // CR LF, byte order mark
  check_patching("v 1 2 3\rv 4 5 6\rv 7 8 10\rf 1 2 3\r", Format::obj);                        // CR alone
  check_patching("v 0.1 \\\n 0.2 \\\r\n0.3\nv 1e-400 1e30 -7\nv 3 3 3\n\n\nf 1 2 3", Format::obj);
}

TEST(Obj, only_the_moved_coordinate_changes) {
  const Document document = parse(tetrahedron);
  std::vector<double> moved = document.surface().positions;
  moved[4] = 0.1;
  EXPECT_EQ(patched_bytes(document, moved), replaced(tetrahedron, "\t0 -0.0", "\t0.1 -0.0"));
  moved[4] = 1.0 / 3;
  EXPECT_EQ(patched_bytes(document, moved), replaced(tetrahedron, "\t0 -0.0", "\t0.3333333333333333 -0.0"));
  EXPECT_EQ(patched_bytes(document, moved, true), replaced(tetrahedron, "\t0 -0.0", "\t0.33333334 -0.0"));
}

TEST(Obj, digits_of_floats_read_back_as_the_double_that_they_show) {
  const Document document = parse(tetrahedron);
  std::vector<double> moved = document.surface().positions;
  moved[0] = 0.1;
  EXPECT_EQ(document.as_written(moved, true)[0], 0.1);  // not float 0.1 as a double
  moved[0] = 0.1 + 1e-12;
  EXPECT_EQ(document.as_written(moved, true)[0], 0.1);
  EXPECT_EQ(document.as_written(moved, false)[0], 0.1 + 1e-12);
}

TEST(Obj, faces_with_fewer_than_three_corners_are_left_out) {
  const Document document = parse("v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2\nf 1 2 3\nf\nf 1 1 2\n");
  EXPECT_EQ(document.surface().corners, (std::vector<std::int32_t>{0, 1, 2, 0, 0, 1}));
  ASSERT_EQ(document.notes().size(), 1u);
  EXPECT_PRED2(message_contains, document.notes()[0], "2 faces with fewer than three corners");
}

TEST(Obj, errors_say_what_and_where) {
  const std::string three = "v 0 0 0\nv 1 0 0\nv 1 1 0\n";
  EXPECT_PARSE_ERROR("", Format::obj, "empty");
  EXPECT_PARSE_ERROR("hello\nworld\n", Format::obj, "no vertices");
  EXPECT_PARSE_ERROR(three + "f 1 2 9", Format::obj, "line 4: face 1 uses vertex 9, but the file has 3 vertices");
  EXPECT_PARSE_ERROR(three + "f 1 2 3\nf 1 2 -4\n", Format::obj, "line 5: face 2 uses vertex -4");
  EXPECT_PARSE_ERROR(three + "f 0 1 2\n", Format::obj, "OBJ counts from 1");
  EXPECT_PARSE_ERROR(three + "f 1 2 99999999999999999999\n", Format::obj, "line 4: corner '99999999999999999999'");
  EXPECT_PARSE_ERROR(three + "f 1 2 4294967297\n", Format::obj, "face 1 uses vertex 4294967297");
  EXPECT_PARSE_ERROR(three + "f 1 2 3x\n", Format::obj, "corner '3x' of face 1");
  EXPECT_PARSE_ERROR("v 0 0\n", Format::obj, "line 1: vertex 1 has fewer than three");
  EXPECT_PARSE_ERROR("v 0 0 0\r\nv 0,5 0 0\r\n", Format::obj, "line 2: coordinate '0,5' of vertex 2 is not a number");
  EXPECT_PARSE_ERROR("v 0 nan 0\n", Format::obj, "coordinate 'nan' of vertex 1 is not finite");
  EXPECT_PARSE_ERROR("v 0 0 0\nv 0 0 -inf\n", Format::obj, "line 2: coordinate '-inf' of vertex 2 is not finite");
  EXPECT_PARSE_ERROR("v 1e999 0 0\n", Format::obj, "not finite");
  EXPECT_PARSE_ERROR("v 1.#QNAN 0 0\n", Format::obj, "vertex 1");
  EXPECT_PARSE_ERROR(std::string("\0\1\2\3 binary", 11), Format::obj, "not text");
}

TEST(Obj, survives_damage) {
  check_damage(tetrahedron, Format::obj);
}

}  // namespace
}  // namespace unsnarl::obj_files
