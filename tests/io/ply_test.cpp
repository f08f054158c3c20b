#include "document_checks.h"
#include "io/byte_order.h"

namespace unsnarl::ply_files {
namespace {

const std::string ascii =
    "ply\n"
    "format ascii 1.0\n"
    "comment by hand\n"
    "obj_info nothing\n"
    "element vertex 4\n"
    "property float x\n"
    "property float y\n"
    "property uchar red\n"
    "property float z\n"
    "element camera 1\n"
    "property double focus\n"
    "property list uchar float matrix\n"
    "element face 3\n"
    "property uchar quality\n"
    "property list uchar int vertex_indices\n"
    "property list uchar float texcoord\n"
    "end_header\n"
    "0 0 255 0\n"
    "1.10 0 255 0\n"
    "0 1 7 0.0\n"
    "0 0 9 1\n"
    "35.5 2 1 0\n"
    "1 3 0 2 1 6 0 0 0 0 0 0\n"
    "2 4 0 1 3 2 0\n"
    "3 3 1 2 3 0\n";

Document parse(const std::string& text) {
  return Document::parse(text, Format::ply);
}

/// The same mesh in binary: `scalar` for x and z, double for y, with a list within each vertex where wanted.
template <class Scalar>
std::string binary(std::endian order, const std::string& scalar_name, bool list_in_vertex,
                   const std::string& eol = "\n") {
  std::string out = "ply" + eol + "format binary_" + (order == std::endian::big ? "big" : "little") + "_endian 1.0" +
                    eol + "element vertex 4" + eol + "property short flags" + eol + "property " + scalar_name + " x" +
                    eol + (list_in_vertex ? "property list ushort char weights" + eol : "") + "property double y" +
                    eol + "property " + scalar_name + " z" + eol + "element face 2" + eol +
                    "property list int uint vertex_index" + eol + "property uchar red" + eol + "element edge 1" + eol +
                    "property list uint8 int8 extra" + eol + "end_header" + eol;
  const auto put = [&](auto value) {
    out.resize(out.size() + sizeof(value));
    store(out.data() + out.size() - sizeof(value), value, order);
  };
  const double xyz[4][3] = {{0, 0, 0}, {1, 0.1, 0}, {0, 1, 0}, {0, 0, 2}};
  for (int v = 0; v < 4; ++v) {
    put(static_cast<std::int16_t>(v));
    put(static_cast<Scalar>(xyz[v][0]));
    if (list_in_vertex) {
      put(static_cast<std::uint16_t>(v));
      for (int i = 0; i < v; ++i) put(static_cast<std::int8_t>(i));
    }
    put(xyz[v][1]);
    put(static_cast<Scalar>(xyz[v][2]));
  }
  for (const std::vector<std::uint32_t>& face : {std::vector<std::uint32_t>{0, 1, 2, 3}, {3, 2, 1}}) {
    put(static_cast<std::int32_t>(face.size()));
    for (const std::uint32_t v : face) put(v);
    put(std::uint8_t{77});
  }
  put(std::uint8_t{3});
  for (int i = 0; i < 3; ++i) put(static_cast<std::int8_t>(-i));
  return out;
}

TEST(Ply, reads_ascii) {
  const Document document = parse(ascii);
  EXPECT_EQ(document.surface().positions,
            (std::vector<double>{0, 0, 0, static_cast<double>(1.1f), 0, 0, 0, 1, 0, 0, 0, 1}));
  EXPECT_EQ(document.surface().corners, (std::vector<std::int32_t>{0, 2, 1, 0, 1, 3, 2, 1, 2, 3}));
  EXPECT_EQ(document.surface().offsets, (std::vector<std::int32_t>{0, 3, 7, 10}));
  EXPECT_TRUE(document.stores_float32());
}

TEST(Ply, reads_binary_of_both_orders) {
  for (const std::endian order : {std::endian::little, std::endian::big}) {
    for (const bool list_in_vertex : {false, true}) {
      const Document document = parse(binary<float>(order, "float32", list_in_vertex));
      EXPECT_EQ(document.surface().positions, (std::vector<double>{0, 0, 0, 1, 0.1, 0, 0, 1, 0, 0, 0, 2}));
      EXPECT_EQ(document.surface().corners, (std::vector<std::int32_t>{0, 1, 2, 3, 3, 2, 1}));
      EXPECT_FALSE(document.stores_float32());
    }
  }
}

TEST(Ply, keeps_every_promise_of_patching) {
  check_patching(ascii, Format::ply);
  std::string doubles = ascii;
  for (const char* axis : {"x", "y", "z"}) {
    doubles = replaced(doubles, std::string("property float ") + axis, std::string("property float64 ") + axis);
  }
  check_patching(doubles, Format::ply);
  std::string crlf;
  for (const char c : ascii) crlf += c == '\n' ? std::string("\r\n") : std::string(1, c);
  check_patching(crlf, Format::ply);
  crlf.resize(crlf.size() - 2);
  check_patching(crlf, Format::ply);
  for (const std::endian order : {std::endian::little, std::endian::big}) {
    for (const bool list_in_vertex : {false, true}) {
      for (const char* eol : {"\n", "\r\n", "\r"}) {
        check_patching(binary<float>(order, "float", list_in_vertex, eol), Format::ply);
        check_patching(binary<double>(order, "double", list_in_vertex, eol), Format::ply);
      }
    }
  }
}

TEST(Ply, only_the_moved_coordinate_changes) {
  const Document document = parse(ascii);
  std::vector<double> moved = document.surface().positions;
  moved[3] = 1.0 / 3;
  EXPECT_EQ(patched_bytes(document, moved), replaced(ascii, "1.10 0 255", "0.33333334 0 255"));
  EXPECT_EQ(document.as_written(moved, false)[3], static_cast<double>(1.0f / 3));
}

TEST(Ply, motion_below_float_keeps_the_token) {
  const Document document = parse(ascii);
  std::vector<double> moved = document.surface().positions;
  moved[3] += 1e-12;
  EXPECT_EQ(patched_bytes(document, moved), ascii);
}

TEST(Ply, faces_may_come_first) {
  const std::string text =
      "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_index\nelement vertex 3\n"
      "property double x\nproperty double y\nproperty double z\nend_header\n3 0 1 2\n0 0 0\n1 0 0\n0 1 0";
  EXPECT_EQ(parse(text).surface().corners, (std::vector<std::int32_t>{0, 1, 2}));
  check_patching(text, Format::ply);
}

TEST(Ply, integer_positions_are_read_but_not_changed) {
  std::string text = ascii;
  text = replaced(text, "property float y", "property int y");
  const Document document = parse(text);
  ASSERT_EQ(document.notes().size(), 1u);
  std::vector<double> moved = document.surface().positions;
  EXPECT_EQ(patched_bytes(document, moved), text);
  moved[0] = 0.5;
  EXPECT_NO_THROW(document.patched(moved, false));
  moved[1] = 0.5;
  EXPECT_THROW(document.patched(moved, false), FileError);
}

TEST(Ply, too_large_for_float_is_a_write_error) {
  const Document document = parse(ascii);
  std::vector<double> moved = document.surface().positions;
  moved[0] = 1e300;
  EXPECT_THROW(document.patched(moved, false), WriteError);
}

TEST(Ply, errors_say_what_and_where) {
  EXPECT_PARSE_ERROR("", Format::ply, "empty");
  EXPECT_PARSE_ERROR("4 4 6\n", Format::ply, "'ply' missing");
  EXPECT_PARSE_ERROR("ply\nformat ascii 1.0\n", Format::ply, "within the header");
  EXPECT_PARSE_ERROR(replaced(ascii, "format ascii", "format morse"), Format::ply, "line 2: unknown format 'morse'");
  EXPECT_PARSE_ERROR(replaced(ascii, "property uchar red", "property rgb red"), Format::ply,
                     "line 8: unknown property type 'rgb'");
  EXPECT_PARSE_ERROR(replaced(ascii, "float y", "float why"), Format::ply, "no property 'y'");
  EXPECT_PARSE_ERROR(replaced(ascii, "vertex_indices", "corners"), Format::ply, "no list 'vertex_indices'");
  EXPECT_PARSE_ERROR(replaced(ascii, "element camera", "element tristrips"), Format::ply, "triangle strips");
  EXPECT_PARSE_ERROR(replaced(ascii, "element vertex 4", "element vertex 4000000000"), Format::ply,
                     "promises 4000000000");
  EXPECT_PARSE_ERROR(replaced(ascii, "element vertex 4", "element vertex -4"), Format::ply, "element NAME COUNT");
  EXPECT_PARSE_ERROR(replaced(ascii, "1.10", "nan"), Format::ply,
                     "line 19: coordinate 'nan' of vertex 1 is not finite");
  EXPECT_PARSE_ERROR(replaced(ascii, "1.10", "1e39"), Format::ply, "not finite in 32 bits");
  EXPECT_PARSE_ERROR(replaced(ascii, "3 0 2 1 6", "3 0 2 4 6"), Format::ply,
                     "line 23: face 0 uses vertex 4, but the file has 4 vertices");
  EXPECT_PARSE_ERROR(replaced(ascii, "2 4 0 1", "2 999 0 1"), Format::ply, "a list 'vertex_indices' of 999 entries");
  EXPECT_PARSE_ERROR(ascii.substr(0, ascii.size() - 4), Format::ply, "cut short");

  const std::string packed = binary<float>(std::endian::big, "float", false);
  EXPECT_PARSE_ERROR(packed.substr(0, packed.size() - 1), Format::ply, "byte");
  EXPECT_PARSE_ERROR(packed.substr(0, packed.size() - 60), Format::ply, "cut short");
  std::string not_finite = packed;
  store(not_finite.data() + packed.find("end_header\n") + 11 + 2, std::numeric_limits<float>::infinity(),
        std::endian::big);
  EXPECT_PARSE_ERROR(not_finite, Format::ply, "vertex 0 (counting from 0) is not finite");
}

TEST(Ply, survives_damage) {
  check_damage(ascii, Format::ply);
  check_damage(binary<float>(std::endian::little, "float", false), Format::ply);
  check_damage(binary<double>(std::endian::big, "double", true), Format::ply);
}

}  // namespace
}  // namespace unsnarl::ply_files
