#include <fmt/format.h>

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

TEST(Gii, ReadsEveryEncoding) {
  for (const std::string& bytes : all_encodings()) {
    const Document document = Document::parse(bytes, Format::gii);
    EXPECT_EQ(document.surface().positions, positions);
    EXPECT_EQ(document.surface().corners, corners);
    EXPECT_TRUE(document.surface().offsets.empty());
  }
  EXPECT_TRUE(Document::parse(ascii, Format::gii).stores_float32());
}

TEST(Gii, KeepsEveryPromiseOfPatching) {
  for (const std::string& bytes : all_encodings()) check_patching(bytes, Format::gii);
}

TEST(Gii, OnlyTheMovedTokenChanges) {
  const Document document = Document::parse(ascii, Format::gii);
  std::vector<double> moved = positions;
  moved[11] = 0.1;
  EXPECT_EQ(patched_bytes(document, moved), replaced(ascii, "4.25", "0.1"));
}

TEST(Gii, OnlyTheBlockOfPointsChanges) {
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

TEST(Gii, LinesOfBase64StayWhereTheDigitsAreAsMany) {
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

TEST(Gii, ReadsGzipColumnsAndOtherArrays) {
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

TEST(Gii, TrianglesMayBeStoredAsFloats) {
  // slam does so, and nibabel reads it.
  const std::string floats = binary<float, float>("GZipBase64Binary", little, "FLOAT32", "FLOAT32");
  EXPECT_EQ(Document::parse(floats, Format::gii).surface().corners, corners);
  check_patching(floats, Format::gii);
  const std::string halves = gifti(data_array("POINTSET", "FLOAT32", 4, "ASCII", points_text) +
                                   data_array("TRIANGLE", "FLOAT32", 1, "ASCII", "0 1.0 2"));
  EXPECT_EQ(Document::parse(halves, Format::gii).surface().corners, (std::vector<std::int32_t>{0, 1, 2}));
  EXPECT_PARSE_ERROR(replaced(halves, "0 1.0 2", "0 1.5 2"), Format::gii, "'1.5' in DataArray 2");
}

TEST(Gii, SeveralSurfacesAreOneScene) {
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

TEST(Gii, MissingVerticesStayAndSoDoTheirFaces) {
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

TEST(Gii, ErrorsSayWhatAndWhere) {
  EXPECT_PARSE_ERROR("", Format::gii, "empty");
  EXPECT_PARSE_ERROR("v 0 0 0\n", Format::gii, "line 1: this is no XML");
  EXPECT_PARSE_ERROR("<Mesh/>", Format::gii, "line 1: the root element is <Mesh>, but <GIFTI> should be here");
  EXPECT_PARSE_ERROR(ascii.substr(0, 700), Format::gii, "this is no XML");
  EXPECT_PARSE_ERROR(gifti(""), Format::gii, "no DataArray of NIFTI_INTENT_POINTSET");
  EXPECT_PARSE_ERROR(gifti(data_array("POINTSET", "FLOAT32", 4, "ASCII", points_text)), Format::gii,
                     "no DataArray of NIFTI_INTENT_TRIANGLE");
  EXPECT_PARSE_ERROR(replaced(ascii, "Encoding='ASCII'", "Encoding='ExternalFileBinary'"), Format::gii,
                     "line 4: DataArray 1 (NIFTI_INTENT_POINTSET): its numbers are in another file");
  EXPECT_PARSE_ERROR(replaced(ascii, "Encoding='ASCII'", "Encoding='Morse'"), Format::gii, "Encoding is none of");
  EXPECT_PARSE_ERROR(replaced(ascii, "Dim0=\"4\"", "Dim0=\"5\""), Format::gii,
                     "line 13: DataArray 1 (NIFTI_INTENT_POINTSET) ends after 12 of 15 numbers");
  EXPECT_PARSE_ERROR(replaced(ascii, "Dim0=\"4\"", "Dim0=\"four\""), Format::gii, "line 4: 'four' in attribute Dim0");
  EXPECT_PARSE_ERROR(replaced(ascii, "Dim0=\"4\"", "Dim0=\"400000000000\""), Format::gii, "cannot be in a file of");
  EXPECT_PARSE_ERROR(replaced(ascii, "Dim1=\"3\"", "Dim1=\"2\""), Format::gii, "Dim1 3");
  EXPECT_PARSE_ERROR(replaced(ascii, "FLOAT32", "FLOAT33"), Format::gii, "DataType is no type of GIFTI");
  EXPECT_PARSE_ERROR(replaced(ascii, "FLOAT32", "INT32"), Format::gii, "points should be floating-point numbers");
  EXPECT_PARSE_ERROR(replaced(ascii, "4.25", "inf"), Format::gii,
                     "line 13: coordinate 'inf' of vertex 3 is not finite");
  EXPECT_PARSE_ERROR(replaced(ascii, "4.25", "<x/>4.25"), Format::gii, "the text of <Data> should be one piece");
  EXPECT_PARSE_ERROR(replaced(ascii, "0 3 2", "0 3 4"), Format::gii, "triangle 3 uses vertex 4, but there are 4");
  EXPECT_PARSE_ERROR(replaced(ascii, "0 3 2", "0 3 x"), Format::gii, "'x' in DataArray 2");
  const std::string zipped = binary("GZipBase64Binary", little);
  EXPECT_PARSE_ERROR(replaced(zipped, "Dim0=\"4\"", "Dim0=\"5\""), Format::gii,
                     "line 9: DataArray 1 (NIFTI_INTENT_POINTSET) cannot be decompressed to 60 bytes");
  EXPECT_PARSE_ERROR(replaced(zipped, "<Data>", "<Data>!"), Format::gii, "no base64");
  EXPECT_PARSE_ERROR(replaced(binary("Base64Binary", little), "Dim0=\"4\"", "Dim0=\"5\""), Format::gii,
                     "should hold 15 numbers of 4 bytes, but has 48 bytes");
}

TEST(Gii, EntitiesDoNotGrow) {
  const std::string bomb =
      replaced(replaced(ascii, "<!DOCTYPE GIFTI SYSTEM \"http://gifti.projects.nitrc.org/gifti.dtd\">",
                        "<!DOCTYPE GIFTI [<!ENTITY a \"ha\"><!ENTITY b \"&a;&a;&a;&a;&a;&a;&a;&a;\"><!ENTITY c "
                        "\"&b;&b;&b;&b;&b;\">]>"),
               "a &lt; b", "&c;&c;&c;");
  check_patching(bomb, Format::gii);
}

TEST(Gii, SurvivesDamage) {
  check_damage(ascii, Format::gii);
  check_damage(binary("Base64Binary", std::endian::big), Format::gii);
  check_damage(binary("GZipBase64Binary", little), Format::gii);
}

}  // namespace
}  // namespace unsnarl::gii_files
