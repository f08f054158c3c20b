#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>

#include "document_checks.h"
#include "io/base64.h"
#include "io/zlib_stream.h"
#include "packed_numbers.h"

namespace unsnarl::gii_files {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr std::endian little = std::endian::little;

std::string data_array(const std::string& intent, const std::string& type, std::size_t rows,
                       const std::string& encoding, const std::string& data,
                       const std::string& more = "Endian=\"LittleEndian\"") {
  return fmt::format(
      "  <DataArray Intent=\"NIFTI_INTENT_{}\" DataType=\"NIFTI_TYPE_{}\" Dimensionality=\"2\" Dim0=\"{}\"\n"
      "     Dim1=\"3\" Encoding='{}' {}>\n"
      "    <MetaData><MD><Name><![CDATA[Name]]></Name><Value>a &lt; b</Value></MD></MetaData>\n"
      "    <CoordinateSystemTransformMatrix><MatrixData>1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</MatrixData>\n"
      "    </CoordinateSystemTransformMatrix>\n"
      "    <Data>{}</Data>\n  </DataArray>\n",
      intent, type, rows, encoding, more, data);
}
std::string gifti(const std::string& arrays) {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<!DOCTYPE GIFTI SYSTEM "
         "\"http://gifti.projects.nitrc.org/gifti.dtd\">\n"
         "<GIFTI Version=\"1.0\" NumberOfDataArrays=\"2\"> <!-- a comment -->\n" +
         arrays + "</GIFTI>\n";
}

const std::vector<double> positions = {0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 4.25};
const std::vector<std::int32_t> corners = {0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2};
const std::string points_text = "\n 0 0 0\n 4.000 0 0\n 0 4 0\n 0 0 4.25";
const std::string corners_text = "0 2 1 0 1 3 1 2 3 0 3 2 ";

std::string as_base64(const std::string& bytes) {
  return base64_encoded(bytes);
}
std::string as_zlib(const std::string& bytes) {
  return base64_encoded(deflated(bytes, false));
}

const std::string ascii = gifti(data_array("POINTSET", "FLOAT32", 4, "ASCII", points_text) +
                                data_array("TRIANGLE", "INT32", 4, "ASCII", corners_text));

/// The tetrahedron in binary.
template <class Point = float, class Corner = std::int32_t>
std::string binary(const std::string& encoding, std::endian order, const char* point_type = "FLOAT32",
                   const char* corner_type = "INT32") {
  const auto encoded = encoding == "Base64Binary" ? as_base64 : as_zlib;
  const std::string endian = order == little ? "Endian=\"LittleEndian\"" : "Endian=\"BigEndian\"";
  return gifti(data_array("POINTSET", point_type, 4, encoding, encoded(packed_all<Point>(positions, order)), endian) +
               data_array("TRIANGLE", corner_type, 4, encoding, encoded(packed_all<Corner>(corners, order)), endian));
}

std::vector<std::string> all_encodings() {
  return {ascii,
          binary("Base64Binary", little),
          binary("Base64Binary", std::endian::big),
          binary("GZipBase64Binary", little),
          binary("GZipBase64Binary", std::endian::big),
          binary<double>("GZipBase64Binary", little, "FLOAT64"),
          binary<double, std::int64_t>("Base64Binary", little, "FLOAT64", "INT64")};
}

TEST(Gii, reads_every_encoding) {
  for (const std::string& bytes : all_encodings()) {
    const Document document = Document::parse(bytes, Format::gii);
    EXPECT_EQ(document.surface().positions, positions);
    EXPECT_EQ(document.surface().corners, corners);
    EXPECT_TRUE(document.surface().offsets.empty());
  }
  EXPECT_TRUE(Document::parse(ascii, Format::gii).stores_float32());
}

TEST(Gii, keeps_every_promise_of_patching) {
  for (const std::string& bytes : all_encodings()) check_patching(bytes, Format::gii);
}

TEST(Gii, only_the_moved_token_changes) {
  const Document document = Document::parse(ascii, Format::gii);
  std::vector<double> moved = positions;
  moved[11] = 0.1;
  EXPECT_EQ(patched_bytes(document, moved), replaced(ascii, "4.25", "0.1"));
}

TEST(Gii, only_the_block_of_points_changes) {
  for (const char* encoding : {"Base64Binary", "GZipBase64Binary"}) {
    const std::string bytes = binary(encoding, little);
    std::vector<double> moved = positions;
    moved[11] = 0.1;
    const auto encoded = encoding == std::string("Base64Binary") ? as_base64 : as_zlib;
    EXPECT_EQ(
        patched_bytes(Document::parse(bytes, Format::gii), moved),
        replaced(bytes, encoded(packed_all<float>(positions, little)), encoded(packed_all<float>(moved, little))));
  }
}

TEST(Gii, lines_of_base64_stay_where_the_digits_are_as_many) {
  const std::string digits = as_base64(packed_all<float>(positions, little));
  const std::string lines = std::string("\n") + digits.substr(0, 20) + "\r\n\t" + digits.substr(20) + "\n";
  const std::string bytes = replaced(binary("Base64Binary", little), digits, lines);
  check_patching(bytes, Format::gii);
  std::vector<double> moved = positions;
  moved[0] = 1;
  const std::string patched = patched_bytes(Document::parse(bytes, Format::gii), moved);
  EXPECT_EQ(patched.size(), bytes.size());
  EXPECT_EQ(patched.find("\r\n\t"), bytes.find("\r\n\t"));
}

TEST(Gii, reads_gzip_columns_and_other_arrays) {
  const std::string by_columns = "ArrayIndexingOrder=\"ColumnMajorOrder\" Endian=\"LittleEndian\"";
  const std::string columns =
      gifti(data_array("SHAPE", "FLOAT32", 4, "ExternalFileBinary", "") +
            data_array("TRIANGLE", "INT32", 4, "ASCII", "0 0 1 0 2 1 2 3 1 3 3 2", by_columns) +
            data_array("POINTSET", "FLOAT32", 4, "GZipBase64Binary",
                       base64_encoded(deflated(packed<float>({0, 4, 0, 0, 0, 0, 4, 0, 0, 0, 0, 4.25}, little), true)),
                       by_columns));
  const Document document = Document::parse(columns, Format::gii);
  EXPECT_EQ(document.surface().positions, positions);
  EXPECT_EQ(document.surface().corners, corners);
  check_patching(columns, Format::gii);
  check_patching(gifti(data_array("POINTSET", "FLOAT64", 4, "ASCII", "0 4 0 0 0 0 4 0 0 0 0 4.25", by_columns) +
                       data_array("TRIANGLE", "INT32", 4, "ASCII", corners_text)),
                 Format::gii);
}

TEST(Gii, triangles_may_be_stored_as_floats) {
  // slam does so, and nibabel reads it.
  const std::string floats = binary<float, float>("GZipBase64Binary", little, "FLOAT32", "FLOAT32");
  EXPECT_EQ(Document::parse(floats, Format::gii).surface().corners, corners);
  check_patching(floats, Format::gii);
  const std::string halves = gifti(data_array("POINTSET", "FLOAT32", 4, "ASCII", points_text) +
                                   data_array("TRIANGLE", "FLOAT32", 1, "ASCII", "0 1.0 2"));
  EXPECT_EQ(Document::parse(halves, Format::gii).surface().corners, (std::vector<std::int32_t>{0, 1, 2}));
  EXPECT_PARSE_ERROR(replaced(halves, "0 1.0 2", "0 1.5 2"), Format::gii, "'1.5' in DataArray 2");
}

TEST(Gii, several_surfaces_are_one_scene) {
  const std::string two = gifti(data_array("POINTSET", "FLOAT32", 4, "ASCII", points_text) +
                                data_array("POINTSET", "FLOAT32", 3, "Base64Binary",
                                           as_base64(packed<float>({5, 5, 5, 6, 5, 5, 5, 6, 5}, little))) +
                                data_array("TRIANGLE", "INT32", 4, "ASCII", corners_text) +
                                data_array("TRIANGLE", "INT32", 1, "ASCII", "0 1 2"));
  const Document document = Document::parse(two, Format::gii);
  EXPECT_EQ(document.surface().view().vertex_count(), 7u);
  EXPECT_EQ(document.surface().corners.back(), 6);
  check_patching(two, Format::gii);
}

TEST(Gii, missing_vertices_stay_and_so_do_their_faces) {
  const std::string text = replaced(ascii, "0 4 0", "NaN -nan 7");
  std::vector<double> with_nan = positions;
  with_nan[6] = nan;
  const std::string packed_text =
      replaced(binary("GZipBase64Binary", little), as_zlib(packed_all<float>(positions, little)),
               as_zlib(packed_all<float>(with_nan, little)));
  for (const std::string& bytes : {text, packed_text}) {
    const Document document = Document::parse(bytes, Format::gii);
    EXPECT_EQ(document.surface().corners, (std::vector<std::int32_t>{0, 1, 3}));
    ASSERT_EQ(document.notes().size(), 1u);
    EXPECT_EQ(document.notes()[0], "1 missing vertex (NaN) and the 3 faces around stay as they are.");
    EXPECT_EQ(patched_bytes(document, document.surface().positions), bytes);
    std::vector<double> moved = document.surface().positions;
    for (double& x : moved) x += 2;
    const Document again = Document::parse(patched_bytes(document, moved), Format::gii);
    EXPECT_TRUE(same_bits(again.surface().positions, document.as_written(moved, false)));
    EXPECT_EQ(again.surface().corners, document.surface().corners);
  }
  EXPECT_NE(patched_bytes(Document::parse(text, Format::gii), std::vector<double>(12, 1.5)).find("NaN -nan 7"),
            std::string::npos);
}

TEST(Gii, errors_say_what_and_where) {
  EXPECT_PARSE_ERROR("", Format::gii, "empty");
  EXPECT_PARSE_ERROR("v 0 0 0\n", Format::gii, "line 1: this is not XML");
  EXPECT_PARSE_ERROR("<Mesh/>", Format::gii, "line 1: the root element is <Mesh>, but <GIFTI> should be here");
  EXPECT_PARSE_ERROR(ascii.substr(0, 700), Format::gii, "this is not XML");
  EXPECT_PARSE_ERROR(gifti(""), Format::gii, "no DataArray of NIFTI_INTENT_POINTSET");
  EXPECT_PARSE_ERROR(gifti(data_array("POINTSET", "FLOAT32", 4, "ASCII", points_text)), Format::gii,
                     "no DataArray of NIFTI_INTENT_TRIANGLE");
  EXPECT_PARSE_ERROR(replaced(ascii, "Encoding='ASCII'", "Encoding='ExternalFileBinary'"), Format::gii,
                     "line 4: DataArray 1 (NIFTI_INTENT_POINTSET): its numbers are in another file, but");
  EXPECT_PARSE_ERROR(replaced(ascii, "Encoding='ASCII'", "Encoding='Morse'"), Format::gii, "Encoding is none of");
  EXPECT_PARSE_ERROR(replaced(ascii, "Dim0=\"4\"", "Dim0=\"5\""), Format::gii,
                     "line 13: DataArray 1 (NIFTI_INTENT_POINTSET) ends after 12 of 15 numbers");
  EXPECT_PARSE_ERROR(replaced(ascii, "Dim0=\"4\"", "Dim0=\"four\""), Format::gii, "line 4: 'four' in attribute Dim0");
  EXPECT_PARSE_ERROR(replaced(ascii, "Dim0=\"4\"", "Dim0=\"400000000000\""), Format::gii, "cannot be in a file of");
  EXPECT_PARSE_ERROR(replaced(ascii, "Dim1=\"3\"", "Dim1=\"2\""), Format::gii, "Dim1 3");
  EXPECT_PARSE_ERROR(replaced(ascii, "FLOAT32", "FLOAT33"), Format::gii, "DataType is not a type of GIFTI");
  EXPECT_PARSE_ERROR(replaced(ascii, "FLOAT32", "INT32"), Format::gii, "points should be floating-point numbers");
  EXPECT_PARSE_ERROR(replaced(ascii, "4.25", "inf"), Format::gii,
                     "line 13: coordinate 'inf' of vertex 3 is not finite");
  EXPECT_PARSE_ERROR(replaced(ascii, "4.25", "<x/>4.25"), Format::gii, "the text of <Data> should be one piece");
  EXPECT_PARSE_ERROR(replaced(ascii, "0 3 2", "0 3 4"), Format::gii, "triangle 3 uses vertex 4, but there are 4");
  EXPECT_PARSE_ERROR(replaced(ascii, "0 3 2", "0 3 x"), Format::gii, "'x' in DataArray 2");
  const std::string zipped = binary("GZipBase64Binary", little);
  EXPECT_PARSE_ERROR(replaced(zipped, "Dim0=\"4\"", "Dim0=\"5\""), Format::gii,
                     "line 9: DataArray 1 (NIFTI_INTENT_POINTSET) cannot be decompressed to 60 bytes");
  EXPECT_PARSE_ERROR(replaced(zipped, "<Data>", "<Data>!"), Format::gii, "not base64");
  EXPECT_PARSE_ERROR(replaced(binary("Base64Binary", little), "Dim0=\"4\"", "Dim0=\"5\""), Format::gii,
                     "should hold 15 numbers of 4 bytes, but has 48 bytes");
}

TEST(Gii, entities_do_not_grow) {
  const std::string bomb =
      replaced(replaced(ascii, "<!DOCTYPE GIFTI SYSTEM \"http://gifti.projects.nitrc.org/gifti.dtd\">",
                        "<!DOCTYPE GIFTI [<!ENTITY a \"ha\"><!ENTITY b \"&a;&a;&a;&a;&a;&a;&a;&a;\"><!ENTITY c "
                        "\"&b;&b;&b;&b;&b;\">]>"),
               "a &lt; b", "&c;&c;&c;");
  check_patching(bomb, Format::gii);
}

TEST(Gii, survives_damage) {
  check_damage(ascii, Format::gii);
  check_damage(binary("Base64Binary", std::endian::big), Format::gii);
  check_damage(binary("GZipBase64Binary", little), Format::gii);
}

namespace fs = std::filesystem;

/// GIFTI files whose numbers lie in others.
class GiiFolder : public ::testing::Test {
 protected:
  GiiFolder() {
    std::string name = (fs::temp_directory_path() / "unsnarl-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
  }
  ~GiiFolder() override { fs::remove_all(folder_); }

  void file(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
  }
  static std::string array(const std::string& intent, const std::string& type, const std::string& file,
                           std::size_t offset, const char* endian = "LittleEndian", std::size_t rows = 4) {
    return data_array(intent, type, rows, "ExternalFileBinary", "",
                      fmt::format("Endian='{}' ExternalFileName='{}' ExternalFileOffset=\"{}\"", endian, file, offset));
  }
  /// The tetrahedron in one file, between other bytes.
  std::string in_one_file(std::endian order = little) const {
    file("all.dat",
         "head" + packed_all<float>(positions, order) + "gap" + packed_all<std::int32_t>(corners, order) + "tail");
    const char* endian = order == little ? "LittleEndian" : "BigEndian";
    return gifti(array("POINTSET", "FLOAT32", "all.dat", 4, endian) +
                 array("TRIANGLE", "INT32", "all.dat", 55, endian));
  }
  Document parse(const std::string& bytes) const { return Document::parse(bytes, Format::gii, folder_); }
  void expect_error(const std::string& bytes, const std::string& words) const {
    try {
      parse(bytes);
      ADD_FAILURE() << words;
    } catch (const FileError& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  }
  fs::path folder_;
};

TEST_F(GiiFolder, reads_and_patches_external_files) {
  for (const std::endian order : {little, std::endian::big}) {
    const std::string bytes = in_one_file(order);
    const Document document = parse(bytes);
    EXPECT_EQ(document.surface().positions, positions);
    EXPECT_EQ(document.surface().corners, corners);
    EXPECT_TRUE(document.stores_float32());
    std::vector<double> moved = positions;
    moved[11] = 0.1;
    const std::vector<OutputFile> files = document.patched(moved, true);
    ASSERT_EQ(files.size(), 2u);
    EXPECT_EQ(files[0].bytes, bytes);
    EXPECT_EQ(files[1].name, "all.dat");
    EXPECT_EQ(files[1].bytes,
              "head" + packed_all<float>(moved, order) + "gap" + packed_all<std::int32_t>(corners, order) + "tail");
    file("all.dat", files[1].bytes);
    EXPECT_TRUE(same_bits(parse(bytes).surface().positions, document.as_written(moved, true)));
  }
}

TEST_F(GiiFolder, a_result_has_external_files_of_its_own) {
  fs::create_directory(folder_ / "sub");
  const std::string points = packed_all<double>(positions, little), faces = packed_all<std::int32_t>(corners, little);
  file("sub/p & q.dat", points);
  file("faces.dat", faces);
  file("depth.dat", "depth");
  const std::string shape = data_array("SHAPE", "FLOAT32", 4, "ExternalFileBinary", "", "ExternalFileName='depth.dat'");
  const std::string bytes = gifti(array("TRIANGLE", "INT32", "./faces.dat", 0) + shape +
                                  array("POINTSET", "FLOAT64", "sub/p &amp; q.dat", 0));
  const Document document = parse(bytes);
  EXPECT_EQ(document.surface().positions, positions);
  EXPECT_TRUE(document.notes().empty());
  std::vector<double> moved = positions;
  moved[11] = 0.1;
  const std::vector<OutputFile> files = document.patched(moved, false, "out/a'b.gii");
  ASSERT_EQ(files.size(), 4u);
  EXPECT_EQ(files[0].bytes,
            replaced(replaced(replaced(bytes, "./faces.dat", "a&#39;b.gii.data"), "depth.dat", "a&#39;b.gii.2.data"),
                     "sub/p &amp; q.dat", "a&#39;b.gii.3.data"));
  EXPECT_EQ(files[1].name, "a'b.gii.data");
  EXPECT_EQ(files[1].bytes, faces);
  EXPECT_EQ(files[2].bytes, "depth");
  EXPECT_EQ(files[3].bytes, packed_all<double>(moved, little));
  for (std::size_t i = 1; i < files.size(); ++i) file(files[i].name.string(), files[i].bytes);
  const Document again = parse(files[0].bytes);
  EXPECT_EQ(again.surface().positions, moved);
  EXPECT_EQ(again.patched(moved, false, "a'b.gii")[0].bytes, files[0].bytes);
}

TEST_F(GiiFolder, what_need_not_be_read_is_passed_on_or_noted) {
  const std::string one = in_one_file();
  const auto with = [&](const std::string& name) {
    return replaced(one, "</GIFTI>", array("SHAPE", "FLOAT32", name, 0) + "</GIFTI>");
  };
  ASSERT_EQ(parse(with("/no/such.dat")).notes().size(), 1u);
  EXPECT_EQ(parse(with("/no/such.dat")).notes()[0],
            "DataArray 3 (NIFTI_INTENT_SHAPE) is not part of the surface, and its file is not copied: '/no/such.dat' "
            "is not in the folder of the file that names it, or is a link out of it; put it there.");
  EXPECT_EQ(parse(with("missing.dat")).notes().size(), 1u);
  EXPECT_EQ(parse(with("missing.dat")).patched(positions, true, "b.gii").size(), 2u);
}

TEST_F(GiiFolder, external_files_may_be_shared) {
  file("two.dat", packed<float>({5, 5, 5, 6, 5, 5, 5, 6, 5}, little) + packed_all<float>(positions, little) +
                      packed_all<std::int32_t>(corners, little));
  const std::string corners_of_both =
      array("TRIANGLE", "INT32", "two.dat", 84, "LittleEndian", 1) + array("TRIANGLE", "INT32", "two.dat", 84);
  const std::string bytes = gifti(array("POINTSET", "FLOAT32", "two.dat", 0, "LittleEndian", 3) +
                                  array("POINTSET", "FLOAT32", "two.dat", 36) + corners_of_both);
  const Document document = parse(bytes);
  EXPECT_EQ(document.surface().view().vertex_count(), 7u);
  std::vector<double> moved = document.surface().positions;
  moved[0] = 1;
  moved[20] = 2;
  const std::vector<OutputFile> files = document.patched(moved, true);
  ASSERT_EQ(files.size(), 2u);
  file("two.dat", files[1].bytes);
  EXPECT_EQ(parse(bytes).surface().positions, moved);
  // Points that are something else too would change it.
  expect_error(replaced(bytes, "Offset=\"36\"", "Offset=\"35\""),
               "DataArray 1 (NIFTI_INTENT_POINTSET) and DataArray 2 (NIFTI_INTENT_POINTSET) use the same bytes of "
               "'two.dat'; store them apart");
  expect_error(replaced(bytes, "Offset=\"36\"", "Offset=\"37\""),
               "DataArray 2 (NIFTI_INTENT_POINTSET) and DataArray 3 (NIFTI_INTENT_TRIANGLE) use the same bytes");
}

TEST_F(GiiFolder, references_out_of_the_folder_and_damage_are_refused) {
  const std::string good = in_one_file();
  file("inside.dat", "");
  fs::create_directory(folder_ / "sub");
  fs::create_symlink("../all.dat", folder_ / "sub/link.dat");
  fs::create_symlink("/etc/hostname", folder_ / "out.dat");
  fs::create_symlink("/etc", folder_ / "etc");
  const auto named = [&](const std::string& name) { return replaced(good, "all.dat", name); };
  EXPECT_EQ(parse(named("sub/link.dat")).surface().positions, positions);
  const std::string where = "line 4: DataArray 1 (NIFTI_INTENT_POINTSET): ";
  for (const std::string name : {"/etc/hostname", "../all.dat", "sub/../all.dat", "out.dat", "etc/hostname"})
    expect_error(named(name), where + "'" + name + "' is not in the folder");
  expect_error(named("none.dat"), "none.dat: cannot open");
  expect_error(named("sub"), "is a folder");
  expect_error(named(""), "ExternalFileName does not say which");
  expect_error(named("inside.dat"), "its numbers should be bytes 4 to 52 of 'inside.dat', which has 0 bytes");
  expect_error(replaced(good, "Offset=\"55\"", "Offset=\"60\""), "bytes 60 to 108 of 'all.dat', which has 107 bytes");
  expect_error(replaced(good, "Offset=\"4\"", "Offset=\"18446744073709551615\""), "cut short or damaged");
  expect_error(replaced(good, "Offset=\"4\"", "Offset=\"-4\""), "'-4' in attribute ExternalFileOffset");
  expect_error(replaced(good, "Dim0=\"4\"", "Dim0=\"6148914691236517206\""), "cut short or damaged");
  expect_error(replaced(good, "Dim0=\"4\"", "Dim0=\"400000000000\""), "cut short or damaged");
}

TEST_F(GiiFolder, survives_damage) {
  const std::string good = in_one_file();
  FixedNumbers numbers;
  const std::size_t begin = good.find("<DataArray"), end = good.find("<MetaData>");
  for (std::size_t round = 0; round < 4000; ++round) {
    std::string damaged = good;
    for (std::uint32_t k = 0; k <= numbers.next(3); ++k)
      damaged[begin + numbers.next(static_cast<std::uint32_t>(end - begin))] = "0987654321./&;'\" x"[numbers.next(19)];
    try {
      const Document document = parse(damaged);
      EXPECT_EQ(document.patched(document.surface().positions, true)[0].bytes, damaged);
    } catch (const FileError&) {
    }
  }
}

}  // namespace
}  // namespace unsnarl::gii_files
