#include <cmath>
#include <limits>

#include "document_checks.h"
#include "packed_numbers.h"

namespace unsnarl::surf_files {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr std::endian big = std::endian::big;

const std::string footer = std::string("\0\0\0\2\0\0\0\x14valid = 1\nfilename", 23);

std::string triangles(const std::string& points, const std::string& faces,
                      const std::string& comment = "created by\n\n", const std::string& after = footer) {
  return std::string("\xFF\xFF\xFE") + comment +
         packed<std::int32_t>({points.size() / 12.0, faces.size() / 12.0}, big) + points + faces + after;
}

const std::string points = packed<float>({0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 4.25}, big);
const std::string faces = packed<std::int32_t>({0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2}, big);
const std::string tetrahedron = triangles(points, faces);

/// Three bytes each.
std::string short_words(std::initializer_list<unsigned> numbers) {
  std::string bytes;
  for (const unsigned n : numbers)
    bytes += {static_cast<char>(n >> 16), static_cast<char>(n >> 8), static_cast<char>(n)};
  return bytes;
}
const std::string quads_of_floats = "\xFF\xFF\xFD" + short_words({4, 1}) +
                                    packed<float>({0, 0, 0, 1, 0, 0, 1, 1, 0.5, 0, 1, 0}, big) +
                                    short_words({0, 1, 2, 3});
const std::string quads_of_integers = "\xFF\xFF\xFF" + short_words({4, 1}) +
                                      packed<std::int16_t>({0, 0, 0, 100, 0, 0, 150, 100, -50, 0, 100, 0}, big) +
                                      short_words({0, 1, 2, 3});

TEST(Surf, reads_triangles) {
  const Document document = Document::parse(tetrahedron, Format::surf);
  EXPECT_EQ(document.surface().positions, (std::vector<double>{0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 4.25}));
  EXPECT_EQ(document.surface().corners, (std::vector<std::int32_t>{0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2}));
  EXPECT_TRUE(document.stores_float32());
  EXPECT_TRUE(document.notes().empty());
}

TEST(Surf, reads_quadrangles) {
  for (const std::string& bytes : {quads_of_floats, quads_of_integers}) {
    const Document document = Document::parse(bytes, Format::surf);
    EXPECT_EQ(document.surface().corners, (std::vector<std::int32_t>{0, 1, 2, 3}));
    EXPECT_EQ(document.surface().offsets, (std::vector<std::int32_t>{0, 4}));
  }
  EXPECT_EQ(Document::parse(quads_of_integers, Format::surf).surface().positions,
            (std::vector<double>{0, 0, 0, 1, 0, 0, 1.5, 1, -0.5, 0, 1, 0}));
}

TEST(Surf, keeps_every_promise_of_patching) {
  check_patching(tetrahedron, Format::surf);
  check_patching(triangles(points, faces, "no second line end\n", ""), Format::surf);
  check_patching(triangles(points, faces, "\n\n"), Format::surf);
  check_patching(quads_of_floats, Format::surf);
}

TEST(Surf, only_the_moved_coordinate_changes) {
  const Document document = Document::parse(tetrahedron, Format::surf);
  std::vector<double> moved = document.surface().positions;
  moved[11] = 0.1;
  EXPECT_EQ(patched_bytes(document, moved),
            replaced(tetrahedron, packed<float>({4.25}, big), packed<float>({0.1}, big)));
}

TEST(Surf, hundredths_cannot_hold_a_repaired_mesh) {
  const Document document = Document::parse(quads_of_integers, Format::surf);
  EXPECT_EQ(patched_bytes(document, document.surface().positions), quads_of_integers);
  EXPECT_FALSE(document.notes().empty());
  std::vector<double> moved = document.surface().positions;
  moved[0] = 0.5;
  EXPECT_THROW(document.patched(moved, false), FileError);
}

TEST(Surf, missing_vertices_stay_and_so_do_their_faces) {
  const std::string with_missing = triangles(packed<float>({0, nan, 0, 4, 0, 0, 0, 4, 0, 0, 0, 4, 1, 1, 1}, big),
                                             packed<std::int32_t>({0, 2, 1, 4, 1, 3, 1, 2, 3, 0, 3, 2}, big));
  const Document document = Document::parse(with_missing, Format::surf);
  EXPECT_EQ(document.surface().corners, (std::vector<std::int32_t>{4, 1, 3, 1, 2, 3}));
  EXPECT_EQ(std::vector<double>(document.surface().positions.begin(), document.surface().positions.begin() + 3),
            (std::vector<double>{4, 0, 0}));
  ASSERT_EQ(document.notes().size(), 1u);
  EXPECT_EQ(document.notes()[0], "1 missing vertex (NaN) and the 2 faces around stay as they are.");
  EXPECT_EQ(patched_bytes(document, document.surface().positions), with_missing);
  std::vector<double> moved = document.surface().positions;
  for (double& x : moved) x += 2;
  const std::string patched = patched_bytes(document, moved);
  const std::size_t header = 3 + 12 + 8;
  EXPECT_EQ(patched.substr(0, header + 12), with_missing.substr(0, header + 12));
  EXPECT_NE(patched, with_missing);
  EXPECT_TRUE(same_bits(Document::parse(patched, Format::surf).surface().positions, document.as_written(moved, false)));
}

TEST(Surf, where_all_is_missing_nothing_is_left) {
  const std::string bytes =
      triangles(packed<float>({nan, nan, nan, nan, 0, 0, 0, nan, 0}, big), packed<std::int32_t>({0, 1, 2}, big));
  EXPECT_PARSE_ERROR(bytes, Format::surf, "no faces");
}

TEST(Surf, errors_say_what_and_where) {
  EXPECT_PARSE_ERROR("", Format::surf, "empty");
  EXPECT_PARSE_ERROR("v 0 0 0\n", Format::surf, "byte 0: a FreeSurfer surface starts with");
  EXPECT_PARSE_ERROR("\xFF\xFF\xFE no end", Format::surf, "the comment of the file does not end");
  EXPECT_PARSE_ERROR(tetrahedron.substr(0, 18), Format::surf, "byte 15: 2 numbers of vertices and faces");
  EXPECT_PARSE_ERROR(tetrahedron.substr(0, 40), Format::surf, "byte 23: 4 vertices of 12 bytes should follow");
  EXPECT_PARSE_ERROR(tetrahedron.substr(0, 100), Format::surf, "byte 71: 4 faces of 12 bytes should follow");
  EXPECT_PARSE_ERROR(triangles(points, packed<std::int32_t>({0, 1, 4}, big)), Format::surf,
                     "byte 71: face 0 (counting from 0) uses vertex 4, but the file has 4 vertices");
  EXPECT_PARSE_ERROR(triangles(points, packed<std::int32_t>({0, 1, -1}, big)), Format::surf, "uses vertex -1");
  EXPECT_PARSE_ERROR(triangles(packed<float>({0, 0, INFINITY}, big), ""), Format::surf,
                     "byte 23: vertex 0 (counting from 0) is not finite");
  EXPECT_PARSE_ERROR(quads_of_floats.substr(0, 30), Format::surf, "byte 9: 4 vertices of 12 bytes");
}

TEST(Surf, survives_damage) {
  check_damage(tetrahedron, Format::surf);
  check_damage(quads_of_floats, Format::surf);
  check_damage(quads_of_integers, Format::surf);
}

}  // namespace
}  // namespace unsnarl::surf_files
