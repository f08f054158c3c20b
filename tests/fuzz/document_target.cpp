#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

#include "fuzz/promise.h"
#include "fuzz/targets.h"
#include "unsnarl/document.h"

namespace unsnarl::fuzz {
namespace {

/// Where the external buffers of a glTF are looked for: nowhere.
constexpr const char* no_folder = "/dev/null";

std::optional<Document> parsed(std::string bytes, Format format) {
  try {
    return Document::parse(std::move(bytes), format, no_folder);
  } catch (const FileError& refusal) {
    promise(refusal.what()[0] != '\0', "a refusal has a reason");
    return std::nullopt;
  }
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

void check_surface(const Document& document) {
  const SurfaceView surface = document.surface();
  promise(surface.positions.size() % 3 == 0, "three coordinates a vertex");
  for (const double x : surface.positions) promise(std::isfinite(x), "positions are finite");
  promise(!surface.offsets.empty() || surface.corners.size() % 3 == 0, "three corners a triangle");
  if (!surface.offsets.empty()) {
    promise(surface.offsets.front() == 0, "offsets start at 0");
    promise(static_cast<std::size_t>(surface.offsets.back()) == surface.corners.size(), "offsets end at the corners");
    promise(std::is_sorted(surface.offsets.begin(), surface.offsets.end()), "offsets ascend");
  }
  for (std::size_t f = 0; f < surface.face_count(); ++f) {
    promise(surface.face(f).size() >= 3, "faces have three corners at least");
    for (const std::int32_t v : surface.face(f))
      promise(v >= 0 && static_cast<std::size_t>(v) < surface.vertex_count(), "corners are in range");
  }
  for (const FaceLabels& labels : document.face_labels()) {
    promise(labels.of_face.size() == surface.face_count(), "one label a face");
    for (const std::int32_t name : labels.of_face)
      promise(name >= -1 && name < static_cast<std::int32_t>(labels.names.size()), "labels are in range");
  }
}

void check_appearance(const Document& document) {
  const SurfaceView surface = document.surface();
  const Appearance look = document.appearance();
  promise(look.material_of_face.empty() || look.material_of_face.size() == surface.face_count(), "a material a face");
  for (const std::int32_t m : look.material_of_face)
    promise(m >= -1 && m < static_cast<std::int32_t>(look.materials.size()), "materials are in range");
  for (const Appearance::Material& m : look.materials)
    promise(m.image >= -1 && m.image < static_cast<std::int32_t>(look.images.size()), "images are in range");
  promise(look.uv_of_corner.size() == (look.images.empty() ? 0 : 2 * surface.corners.size()), "two numbers a corner");
  for (const float x : look.uv_of_corner) promise(std::isfinite(x), "texture coordinates are finite");
}

/// Every other coordinate or so moved, by more than a rounding error, the same way each time.
std::vector<double> moved(const std::vector<double>& positions) {
  std::vector<double> result = positions;
  std::uint64_t state = positions.size();
  for (double& x : result) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    const auto step = static_cast<double>(state >> 33 & 7) - 3;
    const double to = x + step / 16 * (std::abs(x) + 1);
    if (step > 0 && std::isfinite(to)) x = to;
  }
  return result;
}

void check_patching(const Document& document, const std::string& bytes) {
  const Surface& surface = document.surface();
  for (const bool float32_digits : {false, true}) {
    promise(document.patched(surface.positions, float32_digits).front().bytes == bytes,
            "without motion the file comes back byte for byte");
    promise(same_bits(document.as_written(surface.positions, float32_digits), surface.positions),
            "without motion the positions come back bit for bit");
    const std::vector<double> positions = moved(surface.positions);
    std::string patched;
    std::vector<double> written;
    try {
      patched = document.patched(positions, float32_digits).front().bytes;
      written = document.as_written(positions, float32_digits);
    } catch (const FileError&) {  // the file cannot hold the change
      continue;
    } catch (const WriteError&) {  // beyond float32
      continue;
    }
    const std::optional<Document> again = parsed(patched, document.format());
    promise(again.has_value(), "a patched file can be read");
    promise(again->surface().corners == surface.corners && again->surface().offsets == surface.offsets,
            "a patched file has the same faces");
    promise(same_bits(again->surface().positions, written), "a patched file reads back as as_written() says");
    promise(again->patched(written, float32_digits).front().bytes == patched, "patching again changes nothing");
  }
}

void check(Bytes bytes, Format format) {
  const std::string file(bytes.begin(), bytes.end());
  const std::optional<Document> document = parsed(file, format);
  if (!document) return;
  check_surface(*document);
  check_appearance(*document);
  check_patching(*document, file);
}

}  // namespace

void obj(Bytes bytes) {
  check(bytes, Format::obj);
}
void off(Bytes bytes) {
  check(bytes, Format::off);
}
void ply(Bytes bytes) {
  check(bytes, Format::ply);
}
void stl(Bytes bytes) {
  check(bytes, Format::stl);
}
void gltf(Bytes bytes) {
  constexpr std::string_view magic = "glTF";
  const bool is_glb = bytes.size() >= magic.size() && std::equal(magic.begin(), magic.end(), bytes.begin());
  check(bytes, is_glb ? Format::glb : Format::gltf);
}
void surf(Bytes bytes) {
  check(bytes, Format::surf);
}
void gii(Bytes bytes) {
  check(bytes, Format::gii);
}
void vtk(Bytes bytes) {
  check(bytes, Format::vtk);
}
void vtp(Bytes bytes) {
  check(bytes, Format::vtp);
}
void msh(Bytes bytes) {
  check(bytes, Format::msh);
}
void inp(Bytes bytes) {
  check(bytes, Format::inp);
}
void threemf(Bytes bytes) {
  check(bytes, Format::threemf);
}

}  // namespace unsnarl::fuzz
