// GIFTI surfaces (Geometry format under the NIfTI initiative, version 1.0): the points of POINTSET arrays, joined by
// the TRIANGLE arrays in the same order. Coordinate systems, metadata and all other arrays are passed on. Numbers may
// lie in other files (ExternalFileBinary), as bytes of the stated type, order of bytes and offset.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <limits>
#include <optional>
#include <utility>

#include "io/base64_numbers.h"
#include "io/formats.h"
#include "io/linked_file.h"
#include "io/point_file.h"
#include "io/text_scanner.h"
#include "io/xml_text.h"
#include "unsnarl/paths.h"

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

namespace fs = std::filesystem;

/// A GIFTI file and where it names others.
class GiftiFile final : public PointFile {
 public:
  /// The value of an attribute ExternalFileName.
  struct Reference {
    ByteRange value;
    std::size_t file = 0;  ///< number in external_files
  };

  std::vector<OutputFile> patched_as(const std::string& main_name, const std::string&,
                                     std::span<const double> positions, bool float32_digits) const override {
    std::vector<TextEdit> edits;
    for (const Reference& reference : references) {
      const std::string name = own_name(main_name, reference.file);
      if (path_of(name) != external_files[reference.file]->name)
        edits.push_back({reference.value.begin, reference.value.begin + reference.value.size, in_attribute(name)});
    }
    std::vector<OutputFile> files = patched_with(std::move(edits), positions, float32_digits);
    for (std::size_t i = 1; i < files.size(); ++i) files[i].name = path_of(own_name(main_name, i - 1));
    return files;
  }

  std::vector<Reference> references;

 private:
  /// The first is called as Connectome Workbench calls the only one that it writes.
  static std::string own_name(const std::string& main_name, std::size_t i) {
    return i == 0 ? main_name + ".data" : fmt::format("{}.{}.data", main_name, i + 1);
  }
};

class GiftiParser {
 public:
  GiftiParser(GiftiFile& file, fs::path folder) : file_(file), folder_(std::move(folder)), xml_(file.bytes, "GIFTI") {
    if (folder_.empty()) folder_ = ".";
  }

  void parse() {
    std::vector<DataArray> points, triangles;
    std::size_t number = 0;
    for (const pugi::xml_node& element : xml_.root().children("DataArray")) {
      ++number;
      const std::string_view intent = element.attribute("Intent").value();
      if (intent == "NIFTI_INTENT_POINTSET")
        points.push_back(data_array(element, number));
      else if (intent == "NIFTI_INTENT_TRIANGLE")
        triangles.push_back(data_array(element, number));
      else if (is_external(element))
        pass_on(element, number);
    }
    require_points_apart();
    if (points.empty() || triangles.empty()) {
      xml_.fail(xml_.root(),
                fmt::format(
                    "the file has no DataArray of {}; it is not a surface. Give the file of the surface it belongs to",
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

  /// What an array of any kind takes of an external file.
  struct ExternalRange {
    std::size_t file = 0, begin = 0, end = 0;
    bool is_points = false;
    std::string where;
    bool operator<(const ExternalRange& other) const {
      return std::pair(file, begin) < std::pair(other.file, other.begin);
    }
  };

  static bool is_external(const pugi::xml_node& element) {
    return element.attribute("Encoding").value() == std::string_view("ExternalFileBinary");
  }
  static std::string place_of(const pugi::xml_node& element, std::size_t number) {
    return fmt::format("DataArray {} ({})", number, element.attribute("Intent").value());
  }

  /// The file that an array lies in, read when it is first named. Throws FileError.
  std::size_t external_file(const pugi::xml_node& element) {
    const pugi::xml_attribute attribute = element.attribute("ExternalFileName");
    const fs::path given = named_path(XmlText::value(attribute)), name = given.lexically_normal();
    if (given.empty())
      throw FileError("its numbers are in another file, but ExternalFileName does not say which; the file is damaged");
    const fs::path place = linked_file(folder_, given);
    auto& files = file_.external_files;
    const auto known = std::find_if(files.begin(), files.end(), [&](const auto& file) { return file->name == name; });
    const auto i = static_cast<std::size_t>(known - files.begin());
    if (known == files.end()) {
      FileRead read = read_stamped_file(place);
      ExternalFile file{name, std::move(read.bytes), read.stamp};
      files.push_back(std::make_shared<ExternalFile>(std::move(file)));
    }
    file_.references.push_back({xml_.range(attribute), i});
    return i;
  }

  /// Offset of the first number in an external file.
  std::size_t offset(const pugi::xml_node& element) {
    const bool is_given = *element.attribute("ExternalFileOffset").value() != '\0';
    return is_given ? xml_.whole_number(element, "ExternalFileOffset", 0) : 0;
  }

  /// The bytes from there on that an array takes; the largest number where there are more than that.
  std::size_t bytes_of(const pugi::xml_node& element) {
    std::size_t bytes =
        size_of(number_type(element.attribute("DataType").value(), gii_types).value_or(NumberType::uint8));
    const std::size_t dimensions = std::min(xml_.whole_number(element, "Dimensionality", 0), most_dimensions);
    for (std::size_t k = 0; k < dimensions; ++k) {
      const std::size_t count = xml_.whole_number(element, fmt::format("Dim{}", k).c_str(), 1);
      if (count > 0 && bytes > largest / count) return largest;
      bytes *= count;
    }
    return bytes;
  }

  /// Reads the file that an array lies in and notes which of its bytes are taken. Throws FileError.
  ExternalRange external_range(const pugi::xml_node& element, bool is_points, const std::string& where) {
    ExternalRange range;
    range.begin = offset(element);
    range.end = range.begin + std::min(bytes_of(element), largest - range.begin);
    range.file = external_file(element);
    range.is_points = is_points;
    range.where = where;
    if (range.end > range.begin) ranges_.push_back(range);
    return range;
  }

  /// An array that is no part of the surface stays as it is; its file comes along.
  void pass_on(const pugi::xml_node& element, std::size_t number) {
    const std::string where = place_of(element, number);
    try {
      external_range(element, false, where);
    } catch (const FileError& error) {
      file_.notes.push_back(
          fmt::format("{} is not part of the surface, and its file is not copied: {}.", where, error.what()));
    }
  }

  /// Where points move, nothing else may change.
  void require_points_apart() {
    std::stable_sort(ranges_.begin(), ranges_.end());
    const ExternalRange *last = nullptr, *last_points = nullptr;  // those that reach furthest so far
    for (const ExternalRange& range : ranges_) {
      const ExternalRange* other = range.is_points ? last : last_points;
      if (other != nullptr && other->file == range.file && other->end > range.begin)
        throw FileError(fmt::format("{} and {} use the same bytes of {}; store them apart", other->where, range.where,
                                    in_quotes(file_.external_files[range.file]->name.string())));
      const auto take = [&](const ExternalRange*& furthest) {
        if (furthest == nullptr || furthest->file != range.file || furthest->end < range.end) furthest = &range;
      };
      take(last);
      if (range.is_points) take(last_points);
    }
  }

  void find_in_external_file(DataArray& array, bool is_points) {
    NumberArray& numbers = array.numbers;
    const auto fail = [&](const std::string& why) { xml_.fail(array.element, numbers.where + ": " + why); };
    ExternalRange range;
    try {
      range = external_range(array.element, is_points, numbers.where);
    } catch (const FileError& error) {
      if (error.error_number() != 0) throw FileError(numbers.where + ": " + error.what(), error.error_number());
      fail(error.what());
    }
    numbers.external = file_.external_files[range.file];
    numbers.start = range.begin;
    const std::size_t size = numbers.external->bytes.size();
    if (range.end > size)
      fail(fmt::format("its numbers should be bytes {} to {} of {}, which has {} bytes; it is cut short or damaged",
                       range.begin, range.end, in_quotes(numbers.external->name.string()), size));
  }

  DataArray data_array(const pugi::xml_node& element, std::size_t number) {
    DataArray result;
    result.element = element;
    NumberArray& numbers = result.numbers;
    numbers.where = place_of(element, number);
    const auto fail = [&](const std::string& message) { xml_.fail(element, numbers.where + ": " + message); };
    result.rows = xml_.whole_number(element, "Dim0", 0);
    if (xml_.whole_number(element, "Dimensionality", 0) != 2 || xml_.whole_number(element, "Dim1", 0) != 3)
      fail("Dimensionality should be 2 and Dim1 3, for three numbers a row");
    if (!is_external(element) && result.rows > file_.bytes.size() * largest_numbers_per_byte)
      fail(fmt::format("{} rows cannot be in a file of {} bytes; it is cut short or damaged", result.rows,
                       file_.bytes.size()));
    numbers.count = 3 * result.rows;
    result.by_columns = element.attribute("ArrayIndexingOrder").value() == std::string_view("ColumnMajorOrder");
    const std::string_view type_name = element.attribute("DataType").value();
    const std::optional<NumberType> type = number_type(type_name, gii_types);
    if (!type) fail("DataType is not a type of GIFTI");
    numbers.type = *type;
    const bool is_big = element.attribute("Endian").value() == std::string_view("BigEndian");
    numbers.order = is_big ? std::endian::big : std::endian::little;

    const pugi::xml_node data = element.child("Data");
    const std::string_view encoding = element.attribute("Encoding").value();
    if (is_external(element)) {
      find_in_external_file(result, element.attribute("Intent").value() == std::string_view("NIFTI_INTENT_POINTSET"));
      return result;
    }
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
      fail("Encoding is none of ASCII, Base64Binary, GZipBase64Binary and ExternalFileBinary");
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

  /// A file that declares more numbers than this for each of its bytes is refused: deflate cannot pack them (fixed by
  /// deflate)
  static constexpr std::size_t largest_numbers_per_byte = 1100;
  /// An array of more dimensions is refused; the format allows 6 (fixed by the format)
  static constexpr std::size_t most_dimensions = 16;
  static constexpr std::size_t largest = std::numeric_limits<std::size_t>::max();
  GiftiFile& file_;
  fs::path folder_;
  XmlText xml_;
  std::vector<ExternalRange> ranges_;
};

}  // namespace

std::unique_ptr<MeshFile> parse_gii(std::string bytes, const std::filesystem::path& folder) {
  auto file = std::make_unique<GiftiFile>();
  file->bytes = std::move(bytes);
  GiftiParser(*file, folder).parse();
  return file;
}

}  // namespace unsnarl
