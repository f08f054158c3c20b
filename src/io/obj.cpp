// Wavefront OBJ. Polygons with v, v/vt, v//vn or v/vt/vn corners; everything that is not a vertex position is passed
// on.
#include <fmt/format.h>

#include <array>
#include <limits>

#include "io/coordinate_text_file.h"
#include "io/formats.h"
#include "io/obj_appearance.h"
#include "io/surface_builder.h"
#include "io/text_scanner.h"

namespace unsnarl {
namespace {

class ObjFile final : public CoordinateTextFile {
 public:
  Appearance appearance(std::size_t room) const override { return obj_appearance(bytes, surface, folder, room); }

  std::filesystem::path folder;  ///< that files which this one names are relative to
};

class ObjParser {
 public:
  explicit ObjParser(CoordinateTextFile& file)
      : file_(file), text_(without_end_marks(file.bytes), {.hash_comments = true, .continuation = true}) {}

  void parse() {
    if (file_.bytes.empty()) throw FileError("the file is empty; an OBJ file needs 'v' and 'f' lines");
    while (text_.skip_space()) {
      const std::size_t start = text_.offset();
      const std::string_view keyword = text_.token();
      if (keyword == "v") {
        vertex();
      } else if (keyword == "vn") {
        normal();
      } else if (keyword == "f" || keyword == "fo") {
        face(start);
      } else if (keyword == "o") {
        objects_.start(text_.rest_of_line(), faces_.count());
      } else if (keyword == "g") {
        groups_.start(text_.rest_of_line(), faces_.count());
      } else if (keyword == "usemtl") {
        materials_.start(text_.rest_of_line(), faces_.count());
      } else {
        if (!is_text(keyword)) text_.fail("this is not text, so it is not an OBJ file; check the format", start);
        text_.next_line();
      }
    }
    finish();
  }

 private:
  static bool is_text(std::string_view keyword) {
    for (const char c : keyword) {
      if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') return false;
    }
    return !keyword.empty();
  }

  std::size_t vertex_count() const { return file_.surface.positions.size() / 3; }

  void vertex() {
    const std::size_t number = vertex_count() + 1;
    for (int k = 0; k < 3; ++k) {
      text_.skip_blanks();
      file_.begins.push_back(text_.offset());
      file_.surface.positions.push_back(text_.coordinate<double>(number));
    }
    text_.next_line();
  }

  /// One that is no three numbers is passed on as it is.
  void normal() {
    std::array<double, 3> value{};
    std::array<std::size_t, 3> begins{};
    bool is_good = true;
    for (int k = 0; k < 3; ++k) {
      is_good &= text_.skip_blanks();
      begins[k] = text_.offset();
      is_good = is_good && text_.number(value[k]) == TextScanner::Number::ok;
    }
    if (!is_good) value = {};
    file_.normals.insert(file_.normals.end(), value.begin(), value.end());
    file_.normal_begins.insert(file_.normal_begins.end(), begins.begin(), begins.end());
    text_.next_line();
  }
  /// The normal that a corner names after its vertex ("/vt/vn" or "//vn"); -1: none that is known by now.
  std::int32_t normal_of(std::string_view rest) const {
    const std::size_t second = rest.find('/', 1);
    std::int64_t id = 0;
    if (second == std::string_view::npos || !TextScanner(rest.substr(second + 1), {}).integer(id)) return -1;
    const auto known = static_cast<std::int64_t>(file_.normals.size() / 3);
    id = id > 0 ? id - 1 : known + id;
    return id >= 0 && id < std::numeric_limits<std::int32_t>::max() ? static_cast<std::int32_t>(id) : -1;
  }

  void face(std::size_t start) {
    face_.clear();
    face_normals_.clear();
    ++faces_in_file_;
    while (text_.skip_blanks()) {
      const std::size_t corner_start = text_.offset();
      std::int64_t v = 0;
      if (!text_.integer(v, '/')) {
        text_.fail(fmt::format("corner {} of face {} is not a vertex number; write f 1 2 3 or f 1/1/1 2/2/2 3/3/3",
                               in_quotes(text_.peek()), faces_in_file_));
      }
      face_normals_.push_back(normal_of(text_.token()));
      const auto known = static_cast<std::int64_t>(vertex_count());
      const std::int64_t id = v > 0 ? v - 1 : known + v;
      if (v == 0 || id < 0 || id >= std::numeric_limits<std::int32_t>::max()) {
        text_.fail(v == 0 ? fmt::format("face {} uses vertex 0, but OBJ counts from 1", faces_in_file_)
                          : fmt::format("face {} uses vertex {}, but the file has {} vertices at this line",
                                        faces_in_file_, v, known),
                   corner_start);
      }
      if (id > largest_id_) {
        largest_id_ = id;
        largest_face_ = faces_in_file_;
        largest_start_ = start;
      }
      face_.push_back(static_cast<std::int32_t>(id));
    }
    text_.next_line();
    if (!faces_.add(face_)) text_.fail("more face corners than 32-bit ids can count; split the mesh", start);
    if (face_.size() >= 3)
      file_.normal_of_corner.insert(file_.normal_of_corner.end(), face_normals_.begin(), face_normals_.end());
  }

  void finish() {
    // Faces may come before their vertices, so only now is it known which ids exist.
    const std::size_t n = vertex_count();
    if (n == 0) throw FileError("the file has no vertices ('v x y z' lines); check that it is an OBJ file");
    if (largest_id_ >= static_cast<std::int64_t>(n)) {
      text_.fail(fmt::format("face {} uses vertex {}, but the file has {} vertices", largest_face_, largest_id_ + 1, n),
                 largest_start_);
    }
    const auto normals = static_cast<std::int32_t>(file_.normals.size() / 3);
    for (std::int32_t& n : file_.normal_of_corner)
      if (n >= normals) n = -1;
    faces_.note_ignored(file_.notes);
    objects_.finish(faces_.count(), file_.labels);
    groups_.finish(faces_.count(), file_.labels);
    materials_.finish(faces_.count(), file_.labels);
  }

  CoordinateTextFile& file_;
  TextScanner text_;
  FaceCollector faces_{file_.surface};
  LabelCollector objects_{"object"}, groups_{"group"}, materials_{"material"};
  std::vector<std::int32_t> face_, face_normals_;
  std::size_t faces_in_file_ = 0;
  std::int64_t largest_id_ = -1;
  std::size_t largest_face_ = 0, largest_start_ = 0;
};

}  // namespace

std::unique_ptr<MeshFile> parse_obj(std::string bytes, const std::filesystem::path& folder) {
  auto file = std::make_unique<ObjFile>();
  file->bytes = std::move(bytes);
  file->folder = folder;
  ObjParser(*file).parse();
  return file;
}

}  // namespace unsnarl
