#include "unsnarl/scene_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <utility>

#include "geometry/box.h"

namespace unsnarl {
namespace {

/// Extents this many times apart are taken for metres beside millimetres; a surface in millimetres may be three times
/// smaller than the other one (no unit)
constexpr double suspicious_extent_ratio = 300;

double extent_of(std::span<const double> positions) {
  Box box;
  for (std::size_t i = 0; i + 2 < positions.size(); i += 3)
    box.extend(Vec3(positions[i], positions[i + 1], positions[i + 2]));
  return positions.empty() ? 0 : box.diagonal();
}

/// A warning is given where an extent has fewer steps of 32-bit floats: they are too coarse to move anything by less
/// than its distance from others (unit: steps of float32)
constexpr double fewest_steps = 3000;

/// 32-bit numbers are far apart far from the origin. Empty: nothing to say.
std::string note_on_rounding(std::span<const double> positions, double extent) {
  double largest = 0;
  for (const double x : positions) largest = std::max(largest, std::abs(x));
  const auto number = static_cast<float>(largest);
  const double step = static_cast<double>(std::nextafter(number, std::numeric_limits<float>::infinity())) - number;
  if (!(extent > 0) || step * fewest_steps < extent) return {};
  return fmt::format(
      "at {:.3g} the 32-bit numbers of the file are {:.2g} apart, with an extent of {:.3g}: move it to the "
      "origin before, or its repair may take long and fail",
      largest, step, extent);
}

void append_faces(const Surface& part, std::int32_t first_vertex, bool with_offsets, Surface& whole) {
  const auto first_corner = static_cast<std::int32_t>(whole.corners.size());
  for (const std::int32_t v : part.corners) whole.corners.push_back(first_vertex + v);
  if (!with_offsets) return;
  for (std::size_t f = 1; f <= part.view().face_count(); ++f)
    whole.offsets.push_back(first_corner + (part.offsets.empty() ? static_cast<std::int32_t>(3 * f) : part.offsets[f]));
}

/// Adds the labels of a file, of the same kind to those that are there.
void append_labels(const std::vector<FaceLabels>& part, const SceneFile& file, std::size_t face_count,
                   std::vector<FaceLabels>& whole) {
  for (const FaceLabels& labels : part) {
    auto same_kind =
        std::find_if(whole.begin(), whole.end(), [&](const FaceLabels& other) { return other.kind == labels.kind; });
    if (same_kind == whole.end())
      same_kind = whole.insert(whole.end(), {labels.kind, {}, std::vector<std::int32_t>(face_count, -1)});
    std::vector<std::int32_t> id;  // of each name of the part
    for (const std::string& name : labels.names) {
      const auto known = std::find(same_kind->names.begin(), same_kind->names.end(), name);
      id.push_back(static_cast<std::int32_t>(known - same_kind->names.begin()));
      if (known == same_kind->names.end()) same_kind->names.push_back(name);
    }
    for (std::size_t f = 0; f < file.faces; ++f)
      if (labels.of_face[f] >= 0) same_kind->of_face[file.first_face + f] = id[labels.of_face[f]];
  }
}

}  // namespace

SceneDocument::SceneDocument(std::vector<Document> documents, std::vector<std::string> names)
    : documents_(std::move(documents)) {
  if (documents_.empty() || documents_.size() != names.size())
    throw std::invalid_argument(fmt::format("a scene of {} documents with {} names", documents_.size(), names.size()));
  std::size_t vertices = 0, faces = 0, corners = 0;
  for (std::size_t i = 0; i < documents_.size(); ++i) {
    const SurfaceView part = documents_[i].surface();
    files_.push_back(
        {std::move(names[i]), vertices, part.vertex_count(), faces, part.face_count(), documents_[i].up()});
    vertices += part.vertex_count();
    faces += part.face_count();
    corners += part.corners.size();
  }
  if (std::max({vertices, faces, corners}) > std::numeric_limits<std::int32_t>::max())
    throw FileError("these files together have more than 2^31 - 1 vertices or corners of faces; give fewer at once");
  if (documents_.size() == 1)
    notes_ = documents_[0].notes();
  else
    join();
  if (float32_file())
    if (std::string note = note_on_rounding(surface().positions, extent_of(surface().positions)); !note.empty())
      notes_.push_back(std::move(note));
}

void SceneDocument::join() {
  const bool with_offsets =
      std::any_of(documents_.begin(), documents_.end(), [](const Document& d) { return !d.surface().offsets.empty(); });
  if (with_offsets) surface_.offsets.push_back(0);
  std::size_t smallest = 0, largest = 0;
  std::vector<double> extents;
  for (std::size_t i = 0; i < documents_.size(); ++i) {
    const Surface& part = documents_[i].surface();
    append_faces(part, static_cast<std::int32_t>(files_[i].first_vertex), with_offsets, surface_);
    surface_.positions.insert(surface_.positions.end(), part.positions.begin(), part.positions.end());
    for (const std::string& note : documents_[i].notes()) notes_.push_back(files_[i].name + ": " + note);
    extents.push_back(extent_of(part.positions));
    // A file without extent, or empty, says nothing about units.
    if (!(extents[smallest] > 0) || (extents[i] > 0 && extents[i] < extents[smallest])) smallest = i;
    if (extents[i] > extents[largest]) largest = i;
  }
  if (extents[smallest] > 0 && extents[largest] >= suspicious_extent_ratio * extents[smallest])
    notes_.push_back(fmt::format("{} is {:.0f} times as large as {}; are both in the same units?", files_[largest].name,
                                 extents[largest] / extents[smallest], files_[smallest].name));
  const std::size_t face_count = surface_.view().face_count();
  labels_.push_back({"file", {}, file_of_faces(files_)});
  for (std::size_t i = 0; i < documents_.size(); ++i) {
    labels_[0].names.push_back(files_[i].name);
    append_labels(documents_[i].face_labels(), files_[i], face_count, labels_);
  }
}

Appearance SceneDocument::appearance(std::size_t image_bytes) const {
  if (documents_.size() == 1) return documents_[0].appearance(image_bytes);
  Appearance whole;
  std::vector<Appearance> parts;
  std::size_t images = 0;
  for (const Document& document : documents_) {
    parts.push_back(document.appearance(image_bytes));
    for (const Appearance::Image& image : parts.back().images) image_bytes -= image.bytes.size();
    images += parts.back().images.size();
  }
  for (std::size_t i = 0; i < parts.size(); ++i) {
    Appearance& part = parts[i];
    const auto first_material = static_cast<std::int32_t>(whole.materials.size());
    const auto first_image = static_cast<std::int32_t>(whole.images.size());
    for (Appearance::Material& material : part.materials) {
      if (material.image >= 0) material.image += first_image;
      whole.materials.push_back(material);
    }
    part.material_of_face.resize(files_[i].faces, -1);
    for (const std::int32_t m : part.material_of_face)
      whole.material_of_face.push_back(m < 0 ? -1 : first_material + m);
    part.uv_of_corner.resize(images == 0 ? 0 : 2 * documents_[i].surface().corners.size());
    whole.uv_of_corner.insert(whole.uv_of_corner.end(), part.uv_of_corner.begin(), part.uv_of_corner.end());
    std::move(part.images.begin(), part.images.end(), std::back_inserter(whole.images));
    for (const std::string& note : part.notes) whole.notes.push_back(files_[i].name + ": " + note);
  }
  return whole;
}

std::optional<std::size_t> SceneDocument::float32_file() const {
  for (std::size_t i = 0; i < documents_.size(); ++i)
    if (documents_[i].stores_float32()) return i;
  return {};
}

bool SceneDocument::recompute_normals() {
  bool any = false;
  for (Document& document : documents_) any |= document.recompute_normals();
  return any;
}

std::span<const double> SceneDocument::positions_of(std::size_t file, std::span<const double> positions) const {
  if (positions.size() != surface().positions.size())
    throw std::invalid_argument(
        fmt::format("{} coordinates given for a scene with {}", positions.size(), surface().positions.size()));
  return positions.subspan(3 * files_[file].first_vertex, 3 * files_[file].vertices);
}

std::vector<OutputFile> SceneDocument::patched(std::size_t file, std::span<const double> positions, bool float32_digits,
                                               const std::filesystem::path& main_name, const std::string& infix) const {
  return documents_[file].patched(positions_of(file, positions), float32_digits, main_name, infix);
}

std::vector<double> SceneDocument::as_written(std::span<const double> positions, bool float32_digits) const {
  if (documents_.size() == 1) return documents_[0].as_written(positions, float32_digits);
  std::vector<double> result;
  result.reserve(positions.size());
  for (std::size_t i = 0; i < documents_.size(); ++i) {
    const std::vector<double> part = documents_[i].as_written(positions_of(i, positions), float32_digits);
    result.insert(result.end(), part.begin(), part.end());
  }
  return result;
}

}  // namespace unsnarl
