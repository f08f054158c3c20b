#include <fmt/format.h>

#include "document_checks.h"
#include "io/base64.h"
#include "io/zlib_stream.h"
#include "packed_numbers.h"

namespace unsnarl::vtp_files {
namespace {

constexpr std::endian little = std::endian::little;
const std::vector<double> positions = {0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 4.25};
const std::vector<double> corners = {0, 2, 1, 0, 1, 3, 2};
const std::vector<double> ends = {3, 7};

/// How the data of a file are stored.
struct Storage {
  std::string format = "ascii";  ///< "ascii", "binary", "appended"
  std::string encoding = "raw";  ///< of appended data
  bool compressed = false, wide_header = false;
  std::endian order = little;
  std::size_t block_size = 20;
};

/// Writes files as vtkXMLPolyDataWriter does.
class Writer {
 public:
  explicit Writer(Storage storage) : storage_(std::move(storage)) {}

  std::string array(const std::string& attributes, const std::string& text, const std::string& bytes) {
    std::string more, content;
    if (storage_.format == "ascii") {
      content = text;
    } else if (storage_.format == "binary") {
      content = encoded(bytes, true);
    } else {
      more = fmt::format(" offset=\"{}\"", appended_.size());
      appended_ += encoded(bytes, storage_.encoding == "base64");
    }
    return fmt::format(
        "<DataArray {} format=\"{}\" RangeMin=\"0\"{}>\n  {}\n<InformationKey "
        "name=\"L2\">5</InformationKey></DataArray>\n",
        attributes, storage_.format, more, content);
  }
  std::string file(const std::string& pieces) const {
    return fmt::format(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"{}\" header_type=\"{}\"{}>\n"
        "<PolyData>\n{}</PolyData>\n{}</VTKFile>\n",
        storage_.order == little ? "LittleEndian" : "BigEndian", storage_.wide_header ? "UInt64" : "UInt32",
        storage_.compressed ? " compressor=\"vtkZLibDataCompressor\"" : "", pieces,
        storage_.format == "appended"
            ? "<AppendedData encoding=\"" + storage_.encoding + "\">\n _" + appended_ + "\n</AppendedData>\n"
            : "");
  }
  std::string encoded(const std::string& bytes, bool in_base64) const {
    std::string header, body;
    if (!storage_.compressed) {
      append(header, bytes.size());
      return in_base64 ? base64_encoded(header + bytes) : header + bytes;
    }
    const std::size_t count = (bytes.size() + storage_.block_size - 1) / storage_.block_size;
    append(header, count);
    append(header, storage_.block_size);
    append(header, bytes.size() % storage_.block_size);
    for (std::size_t b = 0; b < count; ++b) {
      const std::string block = deflated(bytes.substr(b * storage_.block_size, storage_.block_size), false);
      append(header, block.size());
      body += block;
    }
    return in_base64 ? base64_encoded(header) + base64_encoded(body) : header + body;
  }

 private:
  void append(std::string& bytes, std::size_t value) const {
    bytes += storage_.wide_header ? packed<std::uint64_t>({double(value)}, storage_.order)
                                  : packed<std::uint32_t>({double(value)}, storage_.order);
  }
  Storage storage_;
  std::string appended_;
};

template <class Point>
std::string file_of(const Storage& storage, const std::vector<double>& at = positions) {
  Writer writer(storage);
  std::string piece =
      "<Piece NumberOfPoints=\"4\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" "
      "NumberOfPolys=\"2\">\n<PointData>\n";
  piece += writer.array("type=\"UInt8\" Name=\"before\"", "1 2 3 4", "\1\2\3\4") + "</PointData><Points>\n";
  piece += writer.array(std::string("type=\"") + (sizeof(Point) == 4 ? "Float32" : "Float64") +
                            "\" Name=\"Points\" NumberOfComponents=\"3\"",
                        "0 0 0 4.000 0 0\n 0 4 0 0 0 4.25", packed_all<Point>(at, storage.order));
  piece += "</Points><Polys>\n" + writer.array("type=\"Int64\" Name=\"connectivity\"", "0 2 1 0 1 3 2",
                                               packed_all<std::int64_t>(corners, storage.order));
  piece += writer.array("type=\"Int32\" Name=\"offsets\"", "3 7", packed_all<std::int32_t>(ends, storage.order)) +
           "</Polys></Piece>\n";
  return writer.file(piece);
}

const std::string ascii = file_of<float>({});

std::vector<Storage> all_storages() {
  std::vector<Storage> result = {{}};
  for (const char* format : {"binary", "appended"})
    for (const char* encoding : {"raw", "base64"})
      for (const bool compressed : {false, true})
        for (const bool wide : {false, true})
          result.push_back({format, encoding, compressed, wide, wide && compressed ? std::endian::big : little});
  return result;
}

/// A triangle and a quad, as meshio and ParaView store surfaces that they do not take for PolyData.
std::string grid() {
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
         "<UnstructuredGrid><Piece NumberOfPoints=\"4\" NumberOfCells=\"2\"><Points>\n<DataArray type=\"Float64\" "
         "NumberOfComponents=\"3\" format=\"ascii\">0 0 0 4 0 0 0 4 0 0 0 4.25</DataArray></Points>\n<Cells>"
         "<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">0 2 1 0 1 3 2</DataArray>\n"
         "<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">3 7</DataArray>\n"
         "<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">5 9</DataArray></Cells></Piece>"
         "</UnstructuredGrid></VTKFile>\n";
}

TEST(Vtp, faces_of_unstructured_grids_are_the_surface) {
  const Document document = Document::parse(grid(), Format::vtp);
  EXPECT_EQ(document.surface().positions, positions);
  EXPECT_EQ(document.surface().corners, (std::vector<std::int32_t>{0, 2, 1, 0, 1, 3, 2}));
  EXPECT_EQ(format_from_extension("a/b.VTU"), Format::vtp);
  check_patching(grid(), Format::vtp);
  check_damage(grid(), Format::vtp);
}

TEST(Vtp, reads_every_encoding) {
  for (const Storage& storage : all_storages()) {
    for (const std::string& bytes : {file_of<float>(storage), file_of<double>(storage)}) {
      const Document document = Document::parse(bytes, Format::vtp);
      EXPECT_EQ(document.surface().positions, positions);
      EXPECT_EQ(document.surface().corners, (std::vector<std::int32_t>{0, 2, 1, 0, 1, 3, 2}));
      EXPECT_EQ(document.surface().offsets, (std::vector<std::int32_t>{0, 3, 7}));
    }
  }
}

TEST(Vtp, keeps_every_promise_of_patching) {
  for (const Storage& storage : all_storages()) {
    check_patching(file_of<float>(storage), Format::vtp);
    check_patching(file_of<double>(storage), Format::vtp);
  }
}

TEST(Vtp, only_the_points_change_and_what_follows_is_found) {
  std::vector<double> moved = positions;
  for (std::size_t i = 0; i < moved.size(); ++i) moved[i] += 0.1 * double(i * i % 7) + 1e-7 * double(i);
  std::vector<double> rounded;
  for (const double x : moved) rounded.push_back(static_cast<float>(x));
  for (const Storage& storage : all_storages()) {
    const std::string patched = patched_bytes(Document::parse(file_of<float>(storage), Format::vtp), moved);
    if (storage.format == "ascii") continue;
    EXPECT_EQ(patched, file_of<float>(storage, rounded)) << storage.format << storage.encoding << storage.compressed;
  }
}

TEST(Vtp, blocks_that_did_not_change_are_kept) {
  // The first block of a level that is not ours: it must come back as it is.
  Storage storage{"appended", "raw", true};
  const std::string bytes = file_of<float>(storage);
  std::vector<double> moved = positions;
  moved[11] = 1.5;
  const std::string patched = patched_bytes(Document::parse(bytes, Format::vtp), moved);
  const std::string first = deflated(packed_all<float>(positions, little).substr(0, 20), false);
  EXPECT_NE(patched.find(first), std::string::npos);
  EXPECT_NE(patched, bytes);
}

TEST(Vtp, several_pieces_are_one_scene) {
  Writer writer({"appended", "base64", true});
  std::string pieces;
  for (int i = 0; i < 2; ++i) {
    pieces += "<Piece NumberOfPoints=\"3\" NumberOfStrips=\"1\" NumberOfPolys=\"0\"><Points>" +
              writer.array("type=\"Float32\" NumberOfComponents=\"3\"", "",
                           packed<float>({0., 0., double(i), 1, 0, 0, 0, 1, 0}, little)) +
              "</Points><Strips>" +
              writer.array("type=\"Int32\" Name=\"connectivity\"", "", packed<std::int32_t>({0, 1, 2}, little)) +
              writer.array("type=\"Int32\" Name=\"offsets\"", "", packed<std::int32_t>({3}, little)) +
              "</Strips></Piece>";
  }
  const std::string bytes = writer.file(pieces);
  EXPECT_EQ(Document::parse(bytes, Format::vtp).surface().corners, (std::vector<std::int32_t>{0, 1, 2, 3, 4, 5}));
  check_patching(bytes, Format::vtp);
}

TEST(Vtp, errors_say_what_and_where) {
  EXPECT_PARSE_ERROR("", Format::vtp, "empty");
  EXPECT_PARSE_ERROR("<Mesh/>", Format::vtp, "the root element is <Mesh>, but <VTKFile> should be here");
  EXPECT_PARSE_ERROR(replaced(ascii, "PolyData", "StructuredGrid"), Format::vtp,
                     "line 2: type 'StructuredGrid': only PolyData and UnstructuredGrid");
  EXPECT_PARSE_ERROR(replaced(grid(), ">5 9<", ">5 10<"), Format::vtp, "cell 1 is of type 10: only triangles");
  EXPECT_PARSE_ERROR(replaced(grid(), "Name=\"types\"", "Name=\"kinds\""), Format::vtp,
                     "should have the array 'types'");
  EXPECT_PARSE_ERROR(replaced(file_of<float>({"binary", "raw", true}), "vtkZLib", "vtkLZ4"), Format::vtp,
                     "line 2: compressor 'vtkLZ4DataCompressor': only vtkZLibDataCompressor is read");
  EXPECT_PARSE_ERROR(replaced(ascii, "NumberOfPoints=\"4\"", "NumberOfPoints=\"5\""), Format::vtp,
                     "the points of piece 0 ends after 12 of 15 numbers");
  EXPECT_PARSE_ERROR(replaced(ascii, "NumberOfPoints=\"4\"", "NumberOfPoints=\"9999999999999\""), Format::vtp,
                     "cannot be in a file of");
  EXPECT_PARSE_ERROR(replaced(ascii, "NumberOfComponents=\"3\"", "NumberOfComponents=\"2\""), Format::vtp,
                     "line 10: the points should have 3 components");
  EXPECT_PARSE_ERROR(replaced(ascii, "4.25", "inf"), Format::vtp,
                     "line 12: coordinate 'inf' of vertex 3 is not finite");
  EXPECT_PARSE_ERROR(replaced(ascii, "1 3 2", "1 3 4"), Format::vtp,
                     "Polys of piece 0: cell 1 uses point 4, but there are 4");
  EXPECT_PARSE_ERROR(replaced(ascii, "3 7", "7 3"), Format::vtp, "the offset of cell 1 decreases");
  EXPECT_PARSE_ERROR(replaced(ascii, "\"offsets\"", "\"onsets\""), Format::vtp, "should have the arrays");
  EXPECT_PARSE_ERROR(replaced(ascii, "Float32", "String"), Format::vtp, "type 'String' is not read");
  const std::string raw = file_of<float>({"appended", "raw", false});
  EXPECT_PARSE_ERROR(raw.substr(0, raw.size() - 32), Format::vtp, "reach beyond the end of the file");
  EXPECT_PARSE_ERROR(replaced(raw, "offset=\"8\"", "offset=\"800000\""), Format::vtp,
                     "its offset lies beyond the file");
  EXPECT_PARSE_ERROR(replaced(raw, " _", " +"), Format::vtp, "should start with '_'");
  EXPECT_PARSE_ERROR(replaced(raw, "offset=\"120\"", "offset=\"8\""), Format::vtp, "two arrays share their data");
  const std::string zipped = file_of<float>({"appended", "raw", true});
  EXPECT_PARSE_ERROR(zipped.substr(0, zipped.size() - 60), Format::vtp, "line ");
  EXPECT_PARSE_ERROR(replaced(file_of<float>({"binary"}), "  MAAAA", "  M!AAA"), Format::vtp, "not base64");
}

TEST(Vtp, survives_damage) {
  check_damage(ascii, Format::vtp);
  check_damage(file_of<float>({"binary", "raw", false}), Format::vtp);
  check_damage(file_of<float>({"binary", "raw", true, true}), Format::vtp);
  check_damage(file_of<float>({"appended", "raw", true}), Format::vtp);
  check_damage(file_of<float>({"appended", "base64", false}), Format::vtp);
}

}  // namespace
}  // namespace unsnarl::vtp_files
