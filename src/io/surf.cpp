// FreeSurfer surfaces, which often have no extension ("lh.pial"): triangles, and the older quadrangles. Big-endian.
// Described by the readers of FreeSurfer (utils/mrisurf_io.cpp) and nibabel (freesurfer/io.py).
#include "io/surf.h"

#include <fmt/format.h>

#include "io/byte_order.h"
#include "io/formats.h"
#include "io/point_file.h"

namespace unsnarl {
namespace {

enum Magic : std::uint32_t { triangles_magic = 0xFFFFFE, quads_of_integers = 0xFFFFFF, quads_of_floats = 0xFFFFFD };

/// Three bytes.
std::uint32_t short_word(std::string_view bytes, std::size_t at) {
  const auto byte = [&](std::size_t i) { return std::uint32_t{static_cast<unsigned char>(bytes[at + i])}; };
  return byte(0) << 16 | byte(1) << 8 | byte(2);
}

class SurfParser {
 public:
  explicit SurfParser(PointFile& file) : file_(file), bytes_(file.bytes) {}

  void parse() {
    if (bytes_.empty()) throw FileError("the file is empty; a FreeSurfer surface starts with FF FF FE");
    if (!is_freesurfer_surface(bytes_)) {
      throw FileError(
          "byte 0: a FreeSurfer surface starts with the bytes FF FF FE (triangles), FF FF FF or FF FF FD "
          "(quadrangles); check the format");
    }
    if (short_word(bytes_, 0) == triangles_magic) {
      parse_triangles();
    } else {
      parse_quads(short_word(bytes_, 0) == quads_of_integers);
    }
    file_.finish();
  }

 private:
  /// A comment ends with two line ends; a few writers give it one, and then the counts follow at once.
  void parse_triangles() {
    const std::size_t end = bytes_.find("\n\n", magic_size);
    const std::size_t first = bytes_.find('\n', magic_size);
    if (first == std::string_view::npos)
      throw FileError("byte 3: the comment of the file does not end; it is cut short or not a FreeSurfer surface");
    const std::size_t counts = end == first ? end + 2 : first + 1;
    need(counts, 2, 4, "numbers of vertices and faces");
    const auto vertices = load<std::uint32_t>(bytes_.data() + counts, std::endian::big);
    const auto faces = load<std::uint32_t>(bytes_.data() + counts + 4, std::endian::big);
    const std::size_t points = counts + 8;
    need(points, vertices, 12, "vertices");
    const std::size_t corners = points + std::size_t{12} * vertices;
    need(corners, faces, 12, "faces");
    add_points(points, vertices, NumberType::float32, 1);
    for (std::size_t f = 0; f < faces; ++f) {
      std::array<std::int64_t, 3> face{};
      for (std::size_t k = 0; k < 3; ++k)
        face[k] = load<std::int32_t>(bytes_.data() + corners + 12 * f + 4 * k, std::endian::big);
      add_face(face, f, corners + 12 * f);
    }
  }

  void parse_quads(bool integers) {
    need(magic_size, 2, 3, "numbers of vertices and faces");
    const std::size_t vertices = short_word(bytes_, magic_size), quads = short_word(bytes_, magic_size + 3);
    const std::size_t points = magic_size + 6, size = integers ? 2 : 4;
    need(points, vertices, 3 * size, "vertices");
    const std::size_t corners = points + 3 * size * vertices;
    need(corners, quads, 12, "faces");
    add_points(points, vertices, integers ? NumberType::int16 : NumberType::float32, integers ? 100 : 1);
    if (integers)
      file_.notes.emplace_back(
          "The positions are stored as whole hundredths, which cannot hold a repaired mesh; convert the file to "
          "triangles first (mris_convert).");
    for (std::size_t f = 0; f < quads; ++f) {
      std::array<std::int64_t, 4> face{};
      for (std::size_t k = 0; k < 4; ++k) face[k] = short_word(bytes_, corners + 12 * f + 3 * k);
      add_face(face, f, corners + 12 * f);
    }
  }

  void need(std::size_t begin, std::size_t count, std::size_t size, const char* what) const {
    if (begin <= bytes_.size() && count <= (bytes_.size() - begin) / size) return;
    throw FileError(fmt::format("byte {}: {} {} of {} bytes should follow, but the file has {} bytes; it is cut short",
                                begin, count, what, size, bytes_.size()));
  }

  void add_points(std::size_t begin, std::size_t count, NumberType type, double divisor) {
    PointBlock block;
    block.array = {.type = type, .count = 3 * count, .where = "vertices", .order = std::endian::big, .start = begin};
    block.count = count;
    block.coordinate_step = size_of(type);
    block.vertex_step = 3 * size_of(type);
    block.divisor = divisor;
    file_.add_binary_points(std::move(block), PointFile::Missing::marked_by_nan);
  }

  void add_face(std::span<const std::int64_t> face, std::size_t id, std::size_t begin) {
    const std::string wrong = file_.add_face(face);
    if (!wrong.empty()) throw FileError(fmt::format("byte {}: face {} (counting from 0) {}", begin, id, wrong));
  }

  /// Size of the number that the file begins with (fixed by the format, in bytes)
  static constexpr std::size_t magic_size = 3;
  PointFile& file_;
  std::string_view bytes_;
};

}  // namespace

bool is_freesurfer_surface(std::string_view bytes) {
  return bytes.size() >= 3 && short_word(bytes, 0) >= quads_of_floats;
}

std::unique_ptr<MeshFile> parse_surf(std::string bytes, const std::filesystem::path&) {
  auto file = std::make_unique<PointFile>();
  file->bytes = std::move(bytes);
  SurfParser(*file).parse();
  return file;
}

}  // namespace unsnarl
