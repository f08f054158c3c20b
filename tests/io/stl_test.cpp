#include "document_checks.h"
#include "io/byte_order.h"

namespace unsnarl::stl_files {
namespace {

const std::string ascii =
    "solid  My Part\n"
    "  facet normal 0.000000e+00 0 1\n"
    "    outer loop\n"
    "      vertex 0 0 0\n"
    "      vertex 1.000000e+00 0 0\n"
    "      vertex 0 1 0\n"
    "    endloop\n"
    "  endfacet\n"
    "  FACET NORMAL nan nan nan\n"
    "    OUTER LOOP\n"
    "      VERTEX 0 0 0.1\n"
    "      VERTEX 0 0 0.1\n"
    "      VERTEX 1 1 1\n"
    "    ENDLOOP\n"
    "  ENDFACET\n"
    "endsolid My Part\n"
    "solid other\n"
    "facet normal 0 0 0 outer loop vertex 5 5 5 vertex 6 5 5 vertex 5 6 5 endloop endfacet\n"
    "endsolid";

Document parse(const std::string& bytes) {
  return Document::parse(bytes, Format::stl);
}

std::string binary(const std::string& title, std::vector<std::array<float, 12>> facets) {
  std::string out = title;
  out.resize(84);
  store(out.data() + 80, static_cast<std::uint32_t>(facets.size()), std::endian::little);
  for (const auto& facet : facets) {
    for (const float value : facet) {
      out.resize(out.size() + 4);
      store(out.data() + out.size() - 4, value, std::endian::little);
    }
    out += "AB";  // colour of some programs
  }
  return out;
}

const std::vector<std::array<float, 12>> two_facets = {{0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0},
                                                       {0, 0, 0, 0, 0, 0.1f, 1, 0, 0, 0, 1, 5}};

TEST(Stl, reads_ascii) {
  const Document document = parse(ascii);
  EXPECT_EQ(document.surface().view().vertex_count(), 9u);
  EXPECT_EQ(document.surface().corners, (std::vector<std::int32_t>{0, 1, 2, 3, 4, 5, 6, 7, 8}));
  EXPECT_EQ(document.surface().positions[11], static_cast<double>(0.1f));
  EXPECT_TRUE(document.stores_float32());
  ASSERT_EQ(document.face_labels().size(), 1u);
  EXPECT_EQ(document.face_labels()[0].names, (std::vector<std::string>{"My Part", "other"}));
  EXPECT_EQ(document.face_labels()[0].of_face, (std::vector<std::int32_t>{0, 0, 1}));
}

TEST(Stl, reads_binary_whatever_its_header_says) {
  for (const char* title : {"made by us", "solid but binary", ""}) {
    const std::string bytes = binary(title, two_facets);
    const Document document = parse(bytes);
    EXPECT_EQ(document.surface().view().face_count(), 2u);
    EXPECT_EQ(document.surface().positions[11], static_cast<double>(0.1f));
    check_patching(bytes, Format::stl);
    check_patching(bytes + "trailing", Format::stl);
  }
}

TEST(Stl, keeps_every_promise_of_patching) {
  check_patching(ascii, Format::stl);
  std::string crlf;
  for (const char c : ascii) crlf += c == '\n' ? std::string("\r\n") : std::string(1, c);
  check_patching(crlf, Format::stl);
}

TEST(Stl, normals_of_moved_facets_follow) {
  const Document document = parse(ascii);
  std::vector<double> moved = document.surface().positions;
  moved[5] = 1;  // the facet now faces (-1, 0, 1) / sqrt(2)
  std::string expected = replaced(ascii, "1.000000e+00 0 0\n", "1.000000e+00 0 1\n");
  expected = replaced(expected, "normal 0.000000e+00 0 1", "normal -0.70710677 0 0.70710677");
  EXPECT_EQ(patched_bytes(document, moved), expected);

  const Document packed = parse(binary("x", two_facets));
  moved = packed.surface().positions;
  moved[5] = 1;
  const std::string bytes = patched_bytes(packed, moved);
  EXPECT_EQ(load<float>(bytes.data() + 84, std::endian::little), -0.70710677f);
  EXPECT_EQ(load<float>(bytes.data() + 92, std::endian::little), 0.70710677f);
  EXPECT_EQ(bytes.substr(84 + 50), packed.patched(packed.surface().positions, false)[0].bytes.substr(84 + 50));
}

TEST(Stl, zero_normals_stay_and_normals_without_area_become_zero) {
  const Document document = parse(ascii);
  std::vector<double> moved = document.surface().positions;
  moved[18] = 4;   // the facet with normal 0 0 0
  moved[9] = 0.5;  // the facet without area gets one
  const std::string result = patched_bytes(document, moved);
  EXPECT_NE(result.find("facet normal 0 0 0 outer loop vertex 4 5 5"), std::string::npos);
  EXPECT_EQ(result.find("nan"), std::string::npos);
  for (std::size_t i = 0; i < 9; ++i) moved[i] = 7;
  EXPECT_NE(patched_bytes(document, moved).find("facet normal 0 0 0\n"), std::string::npos);
}

TEST(Stl, the_last_endsolid_may_be_missing) {
  const std::string bytes = ascii.substr(0, ascii.rfind("endsolid"));
  const Document document = parse(bytes);
  EXPECT_EQ(document.surface().positions, parse(ascii).surface().positions);
  EXPECT_FALSE(document.notes().empty());
  check_patching(bytes, Format::stl);
  EXPECT_PARSE_ERROR(ascii.substr(0, ascii.rfind("endfacet")), Format::stl, "the file ends where 'endfacet' should be");
  EXPECT_PARSE_ERROR("solid a\n", Format::stl, "the file ends where 'facet or endsolid' should be");
}

TEST(Stl, errors_say_what_and_where) {
  EXPECT_PARSE_ERROR("", Format::stl, "empty");
  EXPECT_PARSE_ERROR("hello", Format::stl, "neither text that starts with 'solid' nor binary");
  EXPECT_PARSE_ERROR(binary("x", two_facets).substr(0, 140), Format::stl,
                     "promises 2 facets, but the file ends within facet 2");
  EXPECT_PARSE_ERROR(binary("x", {}) + std::string(60, 'x'), Format::stl, "promises no facets, but 60 bytes follow");
  EXPECT_PARSE_ERROR(ascii.substr(0, 100), Format::stl, "line ");
  EXPECT_PARSE_ERROR(replaced(ascii, "vertex 0 1 0", "vertex 0 1"), Format::stl,
                     "line 6: vertex 3 has fewer than three");
  EXPECT_PARSE_ERROR(replaced(ascii, "vertex 0 1 0", "vertex 0 inf 0"), Format::stl,
                     "line 6: coordinate 'inf' of vertex 3");
  EXPECT_PARSE_ERROR(replaced(ascii, "    endloop", "    vertex 1 1 1"), Format::stl,
                     "line 7: 'vertex' where 'endloop'");
  EXPECT_PARSE_ERROR(replaced(ascii, "endsolid My Part\nsolid", "endsolid My Part\nliquid"), Format::stl, "'liquid'");
  std::vector<std::array<float, 12>> facets = two_facets;
  facets[1][6] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_PARSE_ERROR(binary("x", facets), Format::stl, "byte 158: corner 2 of facet 2 (counting from 1) is not finite");
}

// A result whose numbers are shorter would have it nearer to the start, and be taken for binary.
TEST(Stl, a_zero_byte_anywhere_is_no_text) {
  const std::string name = "endsolid My Part\nsolid", far_away = std::string(2000, ' ') + '\0';
  EXPECT_PARSE_ERROR(replaced(ascii, name, name + far_away), Format::stl, "the header promises");
}

TEST(Stl, survives_damage) {
  check_damage(ascii, Format::stl);
  check_damage(binary("solid", two_facets), Format::stl);
}

}  // namespace
}  // namespace unsnarl::stl_files
