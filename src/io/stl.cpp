// STL, ASCII and binary. A facet has three vertices of its own and one normal; numbers are 32-bit floats.
#include <fmt/format.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>

#include "io/byte_order.h"
#include "io/formats.h"
#include "io/mesh_file.h"
#include "io/surface_builder.h"
#include "io/text_scanner.h"
#include "io/token_edits.h"

namespace unsnarl {
namespace {

/// Unit normal of a facet; zero where it has no area.
Eigen::Vector3d facet_normal(const double* corners) {
  const Eigen::Map<const Eigen::Matrix3d> p(corners);
  const Eigen::Vector3d u = p.col(1) - p.col(0), v = p.col(2) - p.col(0);
  // Scaled first, so that products of tiny or huge coordinates neither vanish nor overflow.
  const double scale = std::max(u.lpNorm<Eigen::Infinity>(), v.lpNorm<Eigen::Infinity>());
  if (scale == 0) return Eigen::Vector3d::Zero();
  return (u / scale).cross(v / scale).stableNormalized();
}

class StlFile : public MeshFile {
 public:
  StlFile() { stores_float32 = true; }

  std::vector<double> as_written(std::span<const double> positions, bool) const override {
    return coordinates_as_written(surface.positions, positions, TextPrecision::stored_float);
  }

 protected:
  bool has_moved(std::size_t facet, const std::vector<double>& written) const {
    return !std::equal(written.begin() + 9 * facet, written.begin() + 9 * (facet + 1),
                       surface.positions.begin() + 9 * facet);
  }
  void make_faces() {
    surface.corners.resize(surface.positions.size() / 3);
    std::iota(surface.corners.begin(), surface.corners.end(), 0);
  }
};

class BinaryStlFile final : public StlFile {
 public:
  /// Size of the header of a binary STL file and the number of facets (fixed by the format, in bytes)
  static constexpr std::size_t header_size = 84;
  static constexpr std::size_t facet_size = 50;  ///< Size of a facet (fixed by the format, in bytes)
  /// Size of a facet's normal (fixed by the format, in bytes)
  static constexpr std::size_t normal_size = 12;

  /// Does this look like binary STL? A header that starts with "solid" says nothing: many binary files have one.
  static bool matches(std::string_view bytes) {
    if (bytes.size() < header_size) return false;
    const std::uint64_t expected = header_size + facet_size * std::uint64_t{facet_count(bytes)};
    if (bytes.size() == expected) return true;
    // Text has no zero bytes, wherever: patching moves what follows the first numbers.
    return !starts_with_solid(bytes) || bytes.find('\0') != std::string_view::npos;
  }
  static bool starts_with_solid(std::string_view bytes) {
    const std::size_t start = std::min(bytes.find_first_not_of(" \t\r\n"), bytes.size());
    std::string word(bytes.substr(start, 5));
    for (char& c : word) c = static_cast<char>(c | 0x20);
    return word == "solid";
  }

  void parse() {
    const std::size_t count = facet_count(bytes);
    if (count > (bytes.size() - header_size) / facet_size) {
      throw FileError(
          fmt::format("the header promises {} facets, but the file ends within facet {} (counting from 1) at byte "
                      "{}; it is cut short or not an STL file",
                      count, (bytes.size() - header_size) / facet_size + 1, bytes.size()));
    }
    if (count > std::numeric_limits<std::int32_t>::max() / 3) {
      throw FileError(fmt::format("{} facets are more than 32-bit ids can count; split the mesh", count));
    }
    const std::size_t extra = bytes.size() - header_size - count * facet_size;
    if (count == 0 && extra >= facet_size) {
      throw FileError(fmt::format(
          "the header promises no facets, but {} bytes follow it; the file is damaged or not an STL file", extra));
    }
    if (extra > 0) notes.push_back(fmt::format("{} bytes after the last facet are kept as they are.", extra));
    surface.positions.resize(9 * count);
    for (std::size_t i = 0; i < surface.positions.size(); ++i) {
      const auto value = load<float>(bytes.data() + begin(i), std::endian::little);
      if (!std::isfinite(value)) {
        throw FileError(
            fmt::format("byte {}: corner {} of facet {} (counting from 1) is not finite; correct or remove it",
                        begin(i), i / 3 % 3 + 1, i / 9 + 1));
      }
      surface.positions[i] = value;
    }
    make_faces();
  }

  std::vector<OutputFile> patched(std::span<const double> positions, bool float32_digits) const override {
    const std::vector<double> written = as_written(positions, float32_digits);
    std::string result = bytes;
    for (std::size_t f = 0; f < written.size() / 9; ++f) {
      if (!has_moved(f, written)) continue;
      char* normal = result.data() + header_size + f * facet_size;
      if (!is_zero(normal)) {
        const Eigen::Vector3d n = facet_normal(written.data() + 9 * f);
        for (int k = 0; k < 3; ++k) store(normal + 4 * k, static_cast<float>(n[k]), std::endian::little);
      }
      for (std::size_t i = 9 * f; i < 9 * (f + 1); ++i) {
        if (written[i] != surface.positions[i]) {
          store(result.data() + begin(i), static_cast<float>(written[i]), std::endian::little);
        }
      }
    }
    return {{{}, std::move(result)}};
  }

 private:
  static std::uint32_t facet_count(std::string_view bytes) {
    return load<std::uint32_t>(bytes.data() + 80, std::endian::little);
  }
  static std::size_t begin(std::size_t coordinate) {
    return header_size + coordinate / 9 * facet_size + normal_size + coordinate % 9 * 4;
  }
  static bool is_zero(const char* normal) {
    for (int k = 0; k < 3; ++k) {
      if (load<float>(normal + 4 * k, std::endian::little) != 0) return false;
    }
    return true;
  }
};

class AsciiStlFile final : public StlFile {
 public:
  void parse() {
    TextScanner text(without_end_marks(bytes), {});
    LabelCollector solids("object");
    std::string word = keyword(text);
    if (word != "solid") text.fail("neither text that starts with 'solid' nor binary STL; check the format", 0);
    while (word == "solid") {
      const std::string_view name = text.rest_of_line();
      if (!name.empty()) solids.start(name, normals.size() / 3);
      const std::size_t before = normals.size();
      for (word = keyword(text); word == "facet"; word = keyword(text)) facet(text);
      solids.stop(normals.size() / 3);
      if (word.empty() && normals.size() > before) {
        notes.emplace_back("The file ends without 'endsolid'; all its facets are complete.");
        break;
      }
      if (word != "endsolid") unexpected(text, word, "facet or endsolid");
      text.rest_of_line();
      word = keyword(text);
    }
    if (!word.empty()) unexpected(text, word, "solid");
    solids.finish(normals.size() / 3, labels);
    make_faces();
  }

  std::vector<OutputFile> patched(std::span<const double> positions, bool float32_digits) const override {
    const std::vector<double> written = as_written(positions, float32_digits);
    TokenEdits edits;
    for (std::size_t f = 0; f < written.size() / 9; ++f) {
      if (!has_moved(f, written)) continue;
      if (!is_zero(f)) {
        const Eigen::Vector3d n = facet_normal(written.data() + 9 * f);
        for (int k = 0; k < 3; ++k) {
          edits.replace_number(bytes, normals[3 * f + k], n[k], TextPrecision::stored_float);
        }
      }
      for (std::size_t i = 9 * f; i < 9 * (f + 1); ++i) {
        if (written[i] != surface.positions[i]) {
          edits.replace_number(bytes, begins[i], written[i], TextPrecision::stored_float);
        }
      }
    }
    return {{{}, edits.apply(bytes)}};
  }

 private:
  static std::string keyword(TextScanner& text) {
    text.skip_space();
    std::string word(text.token().substr(0, 32));
    for (char& c : word) {
      if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return word;
  }
  [[noreturn]] static void unexpected(const TextScanner& text, const std::string& word, const char* wanted) {
    if (word.empty()) text.fail(fmt::format("the file ends where '{}' should be; it is cut short", wanted));
    text.fail(fmt::format("{} where '{}' should be", in_quotes(word), wanted));
  }
  static void expect(TextScanner& text, const char* wanted) {
    const std::string word = keyword(text);
    if (word != wanted) unexpected(text, word, wanted);
  }

  void facet(TextScanner& text) {
    expect(text, "normal");
    for (int k = 0; k < 3; ++k) {
      // Facets without area often have 'nan' here; it is never read, only replaced.
      if (!text.skip_blanks()) text.fail("a facet normal needs three numbers");
      normals.push_back(text.offset());
      text.token();
    }
    expect(text, "outer");
    expect(text, "loop");
    for (int corner = 0; corner < 3; ++corner) {
      expect(text, "vertex");
      for (int k = 0; k < 3; ++k) {
        text.skip_blanks();
        begins.push_back(text.offset());
        surface.positions.push_back(text.coordinate<float>(surface.positions.size() / 3 + 1));
      }
    }
    expect(text, "endloop");
    expect(text, "endfacet");
    if (surface.positions.size() > std::numeric_limits<std::int32_t>::max()) {
      text.fail("more facets than 32-bit ids can count; split the mesh");
    }
  }

  bool is_zero(std::size_t facet) const {
    for (int k = 0; k < 3; ++k) {
      const std::string_view token = number_token(bytes, normals[3 * facet + k]);
      double value = 1;
      TextScanner(token, {}).number(value);
      if (value != 0) return false;
    }
    return true;
  }

  std::vector<std::size_t> begins;   ///< where the token of each coordinate starts, 9 a facet
  std::vector<std::size_t> normals;  ///< the same for the normals, 3 a facet
};

}  // namespace

std::unique_ptr<MeshFile> parse_stl(std::string bytes, const std::filesystem::path&) {
  if (bytes.empty()) throw FileError("the file is empty; an STL file has a header at least");
  if (BinaryStlFile::matches(bytes)) {
    auto file = std::make_unique<BinaryStlFile>();
    file->bytes = std::move(bytes);
    file->parse();
    return file;
  }
  auto file = std::make_unique<AsciiStlFile>();
  file->bytes = std::move(bytes);
  file->parse();
  return file;
}

}  // namespace unsnarl
