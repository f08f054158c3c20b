// GIFTI surfaces (Geometry format under the NIfTI initiative, version 1.0): the points of POINTSET arrays, joined by
// the TRIANGLE arrays in the same order. Coordinate systems, metadata and all other arrays are passed on.
#include <fmt/format.h>

#include <array>
#include <optional>

#include "io/base64_numbers.h"
#include "io/formats.h"
#include "io/point_file.h"
#include "io/xml_text.h"

namespace unsnarl {
namespace {

constexpr auto gii_types = std::to_array<NumberTypeName>({{"NIFTI_TYPE_INT8", NumberType::int8},
                                                          {"NIFTI_TYPE_UINT8", NumberType::uint8},
                                                          {"NIFTI_TYPE_INT16", NumberType::int16},
                                                          {"NIFTI_TYPE_UINT16", NumberType::uint16},
                                                          {"NIFTI_TYPE_INT32", NumberType::int32},
                                                          {"NIFTI_TYPE_UINT32", NumberType::uint32},
                                                          {"NIFTI_TYPE_INT64", NumberType::int64},
                                                          {"NIFTI_TYPE_UINT64", NumberType::uint64},
                                                          {"NIFTI_TYPE_FLOAT32", NumberType::float32},
                                                          {"NIFTI_TYPE_FLOAT64", NumberType::float64}});

class GiftiParser {
 public:
  explicit GiftiParser(PointFile& file) : file_(file), xml_(file.bytes, "GIFTI") {}

  void parse() {
    std::vector<DataArray> points, triangles;
    std::size_t number = 0;
    for (const pugi::xml_node& element : xml_.root().children("DataArray")) {
      ++number;
      const std::string_view intent = element.attribute("Intent").value();
      if (intent == "NIFTI_INTENT_POINTSET") points.push_back(data_array(element, number));
      if (intent == "NIFTI_INTENT_TRIANGLE") triangles.push_back(data_array(element, number));
    }
    if (points.empty() || triangles.empty()) {
      xml_.fail(
          xml_.root(),
          fmt::format("the file has no DataArray of {}; it is no surface. Give the file of the surface it belongs to",
                      points.empty() ? "NIFTI_INTENT_POINTSET" : "NIFTI_INTENT_TRIANGLE"));
    }
    if (points.size() != triangles.size()) {
      xml_.fail(triangles.back().element,
                fmt::format("{} arrays of points and {} of triangles do not tell which belong together; store each "
                            "surface in a file of its own",
                            points.size(), triangles.size()));
    }
    for (std::size_t i = 0; i < points.size(); ++i) add_surface(points[i], triangles[i]);
    file_.finish();
  }

 private:
  struct DataArray {
    pugi::xml_node element;
    NumberArray numbers;
    std::size_t rows = 0;
    bool by_columns = false;
  };

  DataArray data_array(const pugi::xml_node& element, std::size_t number) {
    DataArray result;
    result.element = element;
    NumberArray& numbers = result.numbers;
    numbers.where = fmt::format("DataArray {} ({})", number, element.attribute("Intent").value());
    const auto fail = [&](const std::string& message) { xml_.fail(element, numbers.where + ": " + message); };
    result.rows = xml_.whole_number(element, "Dim0", 0);
    if (xml_.whole_number(element, "Dimensionality", 0) != 2 || xml_.whole_number(element, "Dim1", 0) != 3)
      fail("Dimensionality should be 2 and Dim1 3, for three numbers a row");
    if (result.rows > file_.bytes.size() * largest_numbers_per_byte)
      fail(fmt::format("{} rows cannot be in a file of {} bytes; it is cut short or damaged", result.rows,
                       file_.bytes.size()));
    numbers.count = 3 * result.rows;
    result.by_columns = element.attribute("ArrayIndexingOrder").value() == std::string_view("ColumnMajorOrder");
    const std::string_view type_name = element.attribute("DataType").value();
    const std::optional<NumberType> type = number_type(type_name, gii_types);
    if (!type) fail("DataType is no type of GIFTI");
    numbers.type = *type;
    const bool is_big = element.attribute("Endian").value() == std::string_view("BigEndian");
    numbers.order = is_big ? std::endian::big : std::endian::little;

    const pugi::xml_node data = element.child("Data");
    const std::string_view encoding = element.attribute("Encoding").value();
    if (encoding == "ExternalFileBinary")
      fail(
          "its numbers are in another file (ExternalFileBinary), which is not supported; store them in this one, as "
          "with 'wb_command -gifti-convert GZIP_BASE64_BINARY'");
    if (!data) fail("it has no <Data>; the file is damaged");
    if (encoding == "ASCII") {
      numbers.is_text = true;
      numbers.text = xml_.content(data);
    } else if (encoding == "Base64Binary" || encoding == "GZipBase64Binary") {
      try {
        numbers.encoded =
            std::make_shared<Base64Numbers>(file_.bytes, xml_.content(data), encoding == "GZipBase64Binary",
                                            numbers.count * size_of(numbers.type), numbers.where);
      } catch (const FileError& error) {
        xml_.fail(data, error.what());
      }
    } else {
      fail("Encoding is none of ASCII, Base64Binary and GZipBase64Binary");
    }
    return result;
  }

  void add_surface(const DataArray& points, const DataArray& triangles) {
    if (is_integer(points.numbers.type)) xml_.fail(points.element, "points should be floating-point numbers");
    const std::size_t first = file_.vertex_count();
    PointFile::Layout layout;
    if (points.by_columns) layout = {1, points.rows};
    file_.add_points(points.numbers, layout, PointFile::Missing::marked_by_nan);
    const std::vector<std::int64_t> ids = whole_numbers(triangles.numbers, file_.bytes);
    for (std::size_t f = 0; f < triangles.rows; ++f) {
      std::array<std::int64_t, 3> face{};
      for (std::size_t k = 0; k < 3; ++k) {
        face[k] = triangles.by_columns ? ids[k * triangles.rows + f] : ids[3 * f + k];
        if (face[k] < 0 || static_cast<std::uint64_t>(face[k]) >= points.rows)
          xml_.fail(triangles.element, fmt::format("{}: triangle {} uses vertex {}, but there are {} (counting from 0)",
                                                   triangles.numbers.where, f, face[k], points.rows));
        face[k] += static_cast<std::int64_t>(first);
      }
      const std::string wrong = file_.add_face(face);
      if (!wrong.empty()) xml_.fail(triangles.element, fmt::format("triangle {} {}", f, wrong));
    }
  }

  /// More than deflate can pack.
  static constexpr std::size_t largest_numbers_per_byte = 1100;
  PointFile& file_;
  XmlText xml_;
};

}  // namespace

std::unique_ptr<MeshFile> parse_gii(std::string bytes, const std::filesystem::path&) {
  auto file = std::make_unique<PointFile>();
  file->bytes = std::move(bytes);
  GiftiParser(*file).parse();
  return file;
}

}  // namespace unsnarl
