#include "io/obj_appearance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <system_error>

#include "io/image_collector.h"
#include "io/linked_file.h"
#include "io/mesh_file.h"
#include "io/mtl.h"
#include "io/text_scanner.h"

namespace unsnarl {
namespace {

/// A larger MTL file is not read; real ones have kilobytes (unit: bytes)
constexpr std::uintmax_t most_mtl_bytes = 16'000'000;

float finite_or_zero(double x) {
  const auto rounded = static_cast<float>(x);
  return std::isfinite(rounded) ? rounded : 0;
}

class ObjAppearanceReader {
 public:
  ObjAppearanceReader(std::string_view bytes, const std::filesystem::path& folder, std::size_t room)
      : text_(bytes, {.hash_comments = true, .continuation = true}), folder_(folder), collector_(result_, room) {}

  Appearance read(const SurfaceView& surface) {
    while (text_.skip_space()) {
      const std::string_view keyword = text_.token();
      if (keyword == "vt") {
        coordinates();
      } else if (keyword == "f" || keyword == "fo") {
        face();
      } else if (keyword == "usemtl") {
        material_ = material_number(text_.rest_of_line());
      } else if (keyword == "mtllib") {
        const std::size_t start = text_.offset();
        libraries(std::string(text_.rest_of_line()));
        text_.seek(start);
        text_.next_line();  // that of the reader of the mesh, which may be a longer one
      } else {
        text_.next_line();
      }
    }
    if (result_.material_of_face.size() != surface.face_count() ||
        coordinates_of_corner_.size() != surface.corners.size())
      return {};
    place_images(surface);
    return std::move(result_);
  }

 private:
  void coordinates() {
    std::array<double, 2> uv{};
    for (double& x : uv)
      if (!text_.skip_blanks() || text_.number(x) != TextScanner::Number::ok) break;
    coordinates_.push_back(uv);
    text_.next_line();
  }

  void face() {
    const std::size_t first = coordinates_of_corner_.size();
    while (text_.skip_blanks()) {
      const std::string_view corner = text_.token();
      if (corner.empty()) break;  // a control character
      coordinates_of_corner_.push_back(coordinates_of(corner));
    }
    text_.next_line();
    if (coordinates_of_corner_.size() - first < 3)
      coordinates_of_corner_.resize(first);
    else
      result_.material_of_face.push_back(material_);
  }
  /// The index after the first slash ("v/vt/vn"), counted from 0; -1: none.
  std::int64_t coordinates_of(std::string_view corner) const {
    const std::size_t slash = corner.find('/');
    std::int64_t id = 0;
    if (slash == std::string_view::npos || !TextScanner(corner.substr(slash + 1), {}).integer(id, '/')) return -1;
    return id > 0 ? id - 1 : static_cast<std::int64_t>(coordinates_.size()) + id;
  }

  /// Several names may stand in a line, and one may hold blanks.
  void libraries(std::string names) {
    std::replace(names.begin(), names.end(), '\\', '/');
    if (std::error_code ignored; std::filesystem::exists(folder_ / named_path(names), ignored)) return library(names);
    TextScanner text(names, {});
    while (text.skip_blanks()) {
      const std::string_view name = text.token();
      if (name.empty()) break;  // a control character
      library(name);
    }
  }
  void library(std::string_view name) {
    try {
      const std::filesystem::path place = linked_file(folder_, named_path(std::string(name)));
      std::error_code failed;
      if (std::filesystem::file_size(place, failed) > most_mtl_bytes && !failed)
        throw FileError(fmt::format("more than {} MB", most_mtl_bytes / 1000000));
      read_mtl(read_file(place), materials_);
    } catch (const NumberedError& error) {  // of the file or of the system: a view goes without it
      result_.notes.push_back(fmt::format("Materials of {} are left out: {}.", name, error.what()));
    }
  }

  std::int32_t material_number(std::string_view name) {
    const auto known = numbers_.find(name);
    if (known != numbers_.end()) return known->second;
    const auto found = materials_.find(name);
    if (found == materials_.end()) return -1;
    const auto number = static_cast<std::int32_t>(result_.materials.size());
    numbers_.emplace(name, number);
    const MtlMaterial& mtl = found->second;
    Appearance::Material material{.colour = mtl.colour};
    if (!mtl.image.empty()) material.image = image(mtl.image);
    // Exporters write any colour beside an image, black too; the image alone is meant.
    if (material.image >= 0) material.colour = {1, 1, 1};
    if (mtl.clamp) material.wrap_u = material.wrap_v = Appearance::Wrap::clamp;
    result_.materials.push_back(material);
    placed_by_.push_back(mtl);
    return number;
  }

  /// Names are often those of the exporter's machine; then the image is looked for beside the mesh.
  std::int32_t image(std::string name) {
    std::replace(name.begin(), name.end(), '\\', '/');
    return collector_.add(name, [&] {
      std::filesystem::path path = named_path(name);
      std::error_code ignored;
      if (!is_inside_folder(path) || !std::filesystem::exists(folder_ / path, ignored)) {
        const std::filesystem::path beside = path.filename();
        if (std::filesystem::exists(folder_ / beside, ignored)) path = beside;
      }
      return collector_.read_beside(folder_, path);
    });
  }

  void place_images(const SurfaceView& surface) {
    if (result_.images.empty()) return;
    result_.uv_of_corner.assign(2 * surface.corners.size(), 0);
    std::size_t corner = 0;
    for (std::size_t f = 0; f < surface.face_count(); ++f) {
      const std::int32_t material = result_.material_of_face[f];
      for (const std::size_t end = corner + surface.face(f).size(); corner < end; ++corner) {
        const std::int64_t id = coordinates_of_corner_[corner];
        if (material < 0 || id < 0 || id >= static_cast<std::int64_t>(coordinates_.size())) continue;
        const MtlMaterial& mtl = placed_by_[static_cast<std::size_t>(material)];
        const std::array<double, 2>& uv = coordinates_[static_cast<std::size_t>(id)];
        // In OBJ v goes up from the lower left corner of the image.
        const double u = mtl.offset[0] + mtl.scale[0] * uv[0], v = 1 - (mtl.offset[1] + mtl.scale[1] * uv[1]);
        result_.uv_of_corner[2 * corner] = finite_or_zero(u);
        result_.uv_of_corner[2 * corner + 1] = finite_or_zero(v);
      }
    }
  }

  TextScanner text_;
  const std::filesystem::path& folder_;
  Appearance result_;
  ImageCollector collector_;
  std::map<std::string, MtlMaterial, std::less<>> materials_;
  std::map<std::string, std::int32_t, std::less<>> numbers_;  ///< of the materials in the result
  std::vector<MtlMaterial> placed_by_;                        ///< as many as materials of the result
  std::vector<std::array<double, 2>> coordinates_;
  std::vector<std::int64_t> coordinates_of_corner_;
  std::int32_t material_ = -1;
};

}  // namespace

Appearance obj_appearance(std::string_view bytes, const SurfaceView& surface, const std::filesystem::path& folder,
                          std::size_t room) {
  return ObjAppearanceReader(bytes, folder, room).read(surface);
}

}  // namespace unsnarl
