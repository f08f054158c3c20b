// Stanford PLY: ASCII, binary little and big endian; any elements and properties beside the positions.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "io/byte_order.h"
#include "io/formats.h"
#include "io/mesh_file.h"
#include "io/ply_header.h"
#include "io/surface_builder.h"
#include "io/text_scanner.h"
#include "io/token_edits.h"
#include "io/vertex_normals.h"

namespace unsnarl {
namespace {

constexpr double largest_whole = 1e15;  ///< Whole numbers up to this are exact (fixed by float64)

class PlyFile final : public MeshFile {
 public:
  std::vector<OutputFile> patched(std::span<const double> positions, bool float32_digits) const override {
    const std::vector<double>& old = surface.positions;
    const std::vector<double> written = as_written(positions, float32_digits);
    const std::vector<double> turned =
        recompute_normals ? turned_normals(surface, written, normals, normal_of_corner()) : normals;
    if (ascii) {
      TokenEdits edits;
      for (std::size_t i = 0; i < old.size(); ++i) {
        if (written[i] != old[i]) edits.replace_number(bytes, begin(i), positions[i], precision(i, float32_digits));
      }
      for (std::size_t i = 0; i < normals.size(); ++i) {
        const bool is_float = normal_types[i % 3] == PlyScalar::float32;
        const TextPrecision digits = is_float ? TextPrecision::stored_float : TextPrecision::float_digits;
        if (value_as_written(turned[i], digits) != normals[i])
          edits.replace_number(bytes, normal_begins[i], turned[i], digits);
      }
      return {{{}, edits.apply(bytes)}};
    }
    std::string result = bytes;
    for (std::size_t i = 0; i < old.size(); ++i) {
      if (written[i] == old[i]) continue;
      if (types[i % 3] == PlyScalar::float32) {
        store(result.data() + begin(i), static_cast<float>(written[i]), order);
      } else {
        store(result.data() + begin(i), written[i], order);
      }
    }
    for (std::size_t i = 0; i < normals.size(); ++i) {
      const auto value = static_cast<float>(turned[i]);
      if (turned[i] == normals[i] || value == normals[i]) continue;
      if (normal_types[i % 3] == PlyScalar::float32) {
        store(result.data() + normal_begins[i], value, order);
      } else {
        store(result.data() + normal_begins[i], static_cast<double>(value), order);
      }
    }
    return {{{}, std::move(result)}};
  }
  bool has_vertex_normals() const override { return !normals.empty(); }

  std::vector<double> as_written(std::span<const double> positions, bool float32_digits) const override {
    std::vector<double> result = surface.positions;
    for (std::size_t i = 0; i < result.size(); ++i) {
      if (positions[i] == result[i]) continue;
      if (is_integer(types[i % 3])) {
        throw FileError(
            fmt::format("property {} of the vertices is an integer and cannot hold the new position of vertex {} "
                        "(counting from 0); convert the file to float or double",
                        "xyz"[i % 3], i / 3));
      }
      const double written = value_as_written(positions[i], precision(i, float32_digits));
      if (written != result[i]) result[i] = written;
    }
    return result;
  }

  /// Start of coordinate i.
  std::size_t begin(std::size_t i) const { return begins.empty() ? first + i / 3 * stride + within[i % 3] : begins[i]; }

  bool ascii = false;
  std::endian order = std::endian::little;
  std::array<PlyScalar, 3> types{};  ///< of x, y, z
  std::array<PlyScalar, 3> normal_types{};
  std::vector<double> normals;  ///< 3 a vertex; empty: none, or not as floating-point numbers
  std::vector<std::size_t> normal_begins;
  std::vector<std::size_t> begins;  ///< where each coordinate starts; empty where all records are of one size:
  std::size_t first = 0, stride = 0;
  std::array<std::size_t, 3> within{};

 private:
  TextPrecision precision(std::size_t i, bool float32_digits) const {
    if (types[i % 3] == PlyScalar::float32) return TextPrecision::stored_float;
    // In binary a double holds the float itself; only digits need the detour through text.
    if (float32_digits) return ascii ? TextPrecision::float_digits : TextPrecision::stored_float;
    return TextPrecision::double_digits;
  }
  /// A vertex has one normal.
  std::span<const std::int32_t> normal_of_corner() const { return surface.corners; }
};

/// Sources of a body: AsciiSource and BinarySource look the same to the parser below.
class AsciiSource {
 public:
  AsciiSource(std::string_view bytes, const PlyHeader& header) : text_(bytes, {}) { text_.seek(header.size); }

  static constexpr std::size_t least_bytes(const PlyElement& element) { return 2 * element.properties.size(); }
  /// The last token needs no white space after it.
  std::size_t remaining() const { return text_.remaining() + 1; }
  std::size_t offset() const { return text_.offset(); }
  void seek(std::size_t offset) { text_.seek(offset); }
  [[noreturn]] void fail(const std::string& message) const { text_.fail(message); }

  std::size_t to_next_value() {
    if (!text_.skip_space()) fail_at_end();
    return text_.offset();
  }
  void skip(PlyScalar) {
    to_next_value();
    text_.token();
  }
  double coordinate(PlyScalar type, std::size_t vertex) {
    to_next_value();
    return type == PlyScalar::float32 ? static_cast<double>(text_.coordinate<float>(vertex))
                                      : text_.coordinate<double>(vertex);
  }
  /// A number of any type; 0 where it is not finite.
  double number(PlyScalar type) {
    to_next_value();
    double value = 0;
    float single = 0;
    const TextScanner::Number read = type == PlyScalar::float32 ? text_.number(single) : text_.number(value);
    if (read != TextScanner::Number::ok) {
      text_.token();
      return 0;
    }
    return type == PlyScalar::float32 ? static_cast<double>(single) : value;
  }
  std::int64_t whole_number(PlyScalar) {
    to_next_value();
    std::int64_t value = 0;
    if (text_.integer(value)) return value;
    double number = 0;  // some write 3.0
    if (text_.number(number) == TextScanner::Number::ok && number == std::floor(number) &&
        std::abs(number) < largest_whole) {
      return static_cast<std::int64_t>(number);
    }
    text_.fail(fmt::format("{} where a whole number should be", in_quotes(text_.peek())));
  }

 private:
  [[noreturn]] void fail_at_end() const { text_.fail("the file ends before all elements were read; it is cut short"); }
  TextScanner text_;
};

class BinarySource {
 public:
  BinarySource(std::string_view bytes, const PlyHeader& header)
      : bytes_(bytes), at_(header.size), order_(header.order) {}

  static std::size_t least_bytes(const PlyElement& element) { return element.smallest_record(); }
  std::size_t remaining() const { return bytes_.size() - at_; }
  std::size_t offset() const { return at_; }
  void seek(std::size_t offset) { at_ = offset; }
  [[noreturn]] void fail(const std::string& message) const {
    throw FileError(fmt::format("byte {}: {}", at_, message));
  }

  std::size_t to_next_value() const { return at_; }
  void skip(PlyScalar type, std::size_t count = 1) {
    if (count > remaining() / size_of(type)) {
      fail("the file ends before all elements were read; it is cut short");
    }
    at_ += count * size_of(type);
  }
  double value(PlyScalar type) {
    const std::size_t start = at_;
    skip(type);
    return load_scalar(bytes_.data() + start, type, order_);
  }
  double number(PlyScalar type) {
    const double result = value(type);
    return std::isfinite(result) ? result : 0;
  }
  double coordinate(PlyScalar type, std::size_t vertex) {
    const double result = value(type);
    if (!std::isfinite(result)) {
      at_ -= size_of(type);
      fail(fmt::format("vertex {} (counting from 0) is not finite; correct or remove it", vertex));
    }
    return result;
  }
  std::int64_t whole_number(PlyScalar type) {
    const double result = value(type);
    if (!(std::abs(result) < largest_whole) || result != std::floor(result)) {
      at_ -= size_of(type);
      fail("a number that is not whole where a whole number should be");
    }
    return static_cast<std::int64_t>(result);
  }

 private:
  std::string_view bytes_;
  std::size_t at_;
  std::endian order_;
};

template <class Source>
class BodyParser {
 public:
  BodyParser(PlyFile& file, const PlyHeader& header) : file_(file), header_(header), source_(file.bytes, header) {}

  void parse() {
    const PlyElement* vertices = nullptr;
    const PlyElement* faces = nullptr;
    for (const PlyElement& element : header_.elements) {
      if (element.name == "tristrips") {
        throw FileError(
            "the faces are stored as triangle strips ('element tristrips'), which is not supported; "
            "convert the file to faces");
      }
      if (element.name == "vertex") vertices = &element;
      if (element.name == "face") faces = &element;
    }
    if (vertices == nullptr) throw FileError("the header has no 'element vertex'; a mesh needs vertices");
    vertex_count_ = vertices->count;
    for (const PlyElement& element : header_.elements) {
      check_count(element);
      if (&element == vertices) {
        read_vertices(element);
      } else if (&element == faces) {
        read_faces(element);
      } else {
        for (std::size_t i = 0; i < element.count && !element.properties.empty(); ++i) skip_record(element);
      }
    }
    faces_.note_ignored(file_.notes);
  }

 private:
  void check_count(const PlyElement& element) const {
    const std::size_t least = Source::least_bytes(element);
    if (least > 0 && element.count > source_.remaining() / least) {
      source_.fail(
          fmt::format("the header promises {} records of '{}', but only {} bytes are left; the file is cut short or "
                      "damaged",
                      element.count, element.name, file_.bytes.size() - source_.offset()));
    }
    if ((element.name == "vertex" || element.name == "face") &&
        element.count > std::numeric_limits<std::int32_t>::max()) {
      source_.fail(fmt::format("{} records of '{}' are more than 32-bit ids can count", element.count, element.name));
    }
  }

  /// The length of the list at this place, which has to fit into the file.
  std::size_t list_length(const PlyProperty& property) {
    const std::size_t start = source_.to_next_value();
    const std::int64_t length = source_.whole_number(*property.count_type);
    if (length < 0 || static_cast<std::uint64_t>(length) > source_.remaining()) {
      source_.seek(start);
      source_.fail(fmt::format("a list '{}' of {} entries, more than the file can hold", property.name, length));
    }
    return static_cast<std::size_t>(length);
  }
  void skip_property(const PlyProperty& property) {
    const std::size_t length = property.count_type ? list_length(property) : 1;
    for (std::size_t i = 0; i < length; ++i) source_.skip(property.type);
  }
  void skip_record(const PlyElement& element) {
    for (const PlyProperty& property : element.properties) skip_property(property);
  }

  void read_vertices(const PlyElement& element) {
    std::array<std::size_t, 3> xyz{};
    bool fixed_size = !header_.ascii;
    for (int k = 0; k < 3; ++k) {
      const std::string name(1, "xyz"[k]);
      const std::optional<std::size_t> found = element.find(name);
      if (!found || element.properties[*found].count_type) {
        throw FileError(fmt::format("the vertices have no property '{}'; a mesh needs x, y and z", name));
      }
      xyz[k] = *found;
      file_.types[k] = element.properties[*found].type;
    }
    for (const PlyProperty& property : element.properties) fixed_size &= !property.count_type;
    note_types();
    const std::array<std::size_t, 3> normal = find_normal(element);
    const bool has_normals = normal[0] < element.properties.size();
    if (has_normals) file_.normals.reserve(3 * element.count);

    file_.surface.positions.resize(3 * element.count);
    if (fixed_size) {
      file_.first = source_.offset();
      file_.stride = element.smallest_record();
    } else {
      file_.begins.resize(3 * element.count);
    }
    for (std::size_t v = 0; v < element.count; ++v) {
      for (std::size_t p = 0; p < element.properties.size(); ++p) {
        const auto k = static_cast<std::size_t>(std::find(xyz.begin(), xyz.end(), p) - xyz.begin());
        if (has_normals && std::find(normal.begin(), normal.end(), p) != normal.end()) {
          file_.normal_begins.push_back(source_.to_next_value());
          file_.normals.push_back(source_.number(element.properties[p].type));
          continue;
        }
        if (k == 3) {
          skip_property(element.properties[p]);
          continue;
        }
        const std::size_t start = source_.to_next_value();
        if (fixed_size) {
          file_.within[k] = start - file_.first - v * file_.stride;
        } else {
          file_.begins[3 * v + k] = start;
        }
        file_.surface.positions[3 * v + k] = source_.coordinate(file_.types[k], v);
      }
    }
  }

  /// Places of nx, ny and nz, if all three are there in this order and floating-point; else past the end.
  std::array<std::size_t, 3> find_normal(const PlyElement& element) {
    std::array<std::size_t, 3> places{};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::optional<std::size_t> found = element.find({"nxnynz" + 2 * k, 2});
      const bool is_usable = found && !element.properties[*found].count_type &&
                             !is_integer(element.properties[*found].type) && (k == 0 || *found > places[k - 1]);
      places[k] = is_usable ? *found : element.properties.size();
      if (is_usable) file_.normal_types[k] = element.properties[*found].type;
    }
    if (std::max(places[1], places[2]) == element.properties.size()) places.fill(element.properties.size());
    return places;
  }

  void note_types() {
    file_.stores_float32 = true;
    bool integers = false;
    for (const PlyScalar type : file_.types) {
      file_.stores_float32 &= type == PlyScalar::float32;
      integers |= is_integer(type);
    }
    if (integers)
      file_.notes.push_back(
          "The positions are stored as integers, which cannot hold a repaired mesh; convert them first.");
  }

  void read_faces(const PlyElement& element) {
    std::optional<std::size_t> corners = element.find("vertex_indices");
    if (!corners) corners = element.find("vertex_index");
    if (element.count > 0 && (!corners || !element.properties[*corners].count_type)) {
      throw FileError("the faces have no list 'vertex_indices' or 'vertex_index'; a mesh needs one of them");
    }
    file_.surface.corners.reserve(3 * std::min(element.count, file_.bytes.size() / 3));
    std::vector<std::int32_t> face;
    for (std::size_t f = 0; f < element.count; ++f) {
      for (std::size_t p = 0; p < element.properties.size(); ++p) {
        const PlyProperty& property = element.properties[p];
        if (p != *corners) {
          skip_property(property);
          continue;
        }
        face.clear();
        const std::size_t length = list_length(property);
        for (std::size_t i = 0; i < length; ++i) {
          const std::size_t start = source_.to_next_value();
          const std::int64_t v = source_.whole_number(property.type);
          if (v < 0 || static_cast<std::uint64_t>(v) >= vertex_count_) {
            source_.seek(start);
            source_.fail(
                fmt::format("face {} uses vertex {}, but the file has {} vertices (faces and vertices count from 0)", f,
                            v, vertex_count_));
          }
          face.push_back(static_cast<std::int32_t>(v));
        }
        if (!faces_.add(face)) source_.fail("more face corners than 32-bit ids can count; split the mesh");
      }
    }
  }

  PlyFile& file_;
  const PlyHeader& header_;
  Source source_;
  FaceCollector faces_{file_.surface};
  std::size_t vertex_count_ = 0;
};

}  // namespace

std::unique_ptr<MeshFile> parse_ply(std::string bytes, const std::filesystem::path&) {
  auto file = std::make_unique<PlyFile>();
  file->bytes = std::move(bytes);
  const PlyHeader header = parse_ply_header(file->bytes);
  file->ascii = header.ascii;
  file->order = header.order;
  if (header.ascii) {
    BodyParser<AsciiSource>(*file, header).parse();
  } else {
    BodyParser<BinarySource>(*file, header).parse();
  }
  return file;
}

}  // namespace unsnarl
