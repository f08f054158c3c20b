#include "surface_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include "glb_file.h"
#include "unsnarl/parts.h"
#include "usage_error.h"

namespace unsnarl::app {
namespace {

using Colour = std::array<std::uint8_t, 3>;
constexpr Colour untouched_colour = {200, 200, 200};
constexpr Colour before_colour = {255, 165, 40};
constexpr Colour after_colour = {215, 25, 28};

void append_positions(std::string& text, std::span<const double> positions, std::string_view prefix) {
  for (std::size_t i = 0; i + 2 < positions.size(); i += 3)
    fmt::format_to(std::back_inserter(text), "{}{} {} {}\n", prefix, positions[i], positions[i + 1], positions[i + 2]);
}

void append_faces(std::string& text, const SurfaceView& surface) {
  for (std::size_t f = 0; f < surface.face_count(); ++f) {
    const auto corners = surface.face(f);
    fmt::format_to(std::back_inserter(text), "{}", corners.size());
    for (std::int32_t v : corners) fmt::format_to(std::back_inserter(text), " {}", v);
    text += '\n';
  }
}

template <class T>
void append_little_endian(std::string& bytes, T value) {
  std::array<char, sizeof(T)> raw;
  std::memcpy(raw.data(), &value, sizeof(T));
  if constexpr (std::endian::native == std::endian::big) std::reverse(raw.begin(), raw.end());
  bytes.append(raw.data(), raw.size());
}

std::vector<std::int32_t> pairs_of_faces(const std::vector<IntersectingPair>& pairs, std::size_t face_count) {
  std::vector<std::int32_t> count(face_count, 0);
  for (const IntersectingPair& pair : pairs) {
    ++count[pair.a];
    if (pair.b != pair.a) ++count[pair.b];
  }
  return count;
}

}  // namespace

std::string surface_file(const SurfaceView& surface, Format format, const std::string& comment,
                         const std::vector<std::string>& groups) {
  std::string text;
  const std::vector<std::int32_t> components =
      groups.empty() ? std::vector<std::int32_t>{} : component_of_faces(surface);
  const auto name_of = [&](std::int32_t component) -> const std::string& {
    return groups[std::min(static_cast<std::size_t>(component), groups.size() - 1)];
  };
  switch (format) {
    case Format::glb: {
      std::vector<std::int32_t> part_of(components);
      std::vector<std::string> names = groups;
      if (groups.empty()) names = {"surface"}, part_of.assign(surface.face_count(), 0);
      for (std::int32_t& part : part_of) part = std::min(part, static_cast<std::int32_t>(names.size()) - 1);
      return glb_file(surface, part_of, names, comment);
    }
    case Format::obj:
      text = "# " + comment + "\n";
      append_positions(text, surface.positions, "v ");
      for (std::size_t f = 0; f < surface.face_count(); ++f) {
        if (!groups.empty() && (f == 0 || components[f] != components[f - 1]))
          text += fmt::format("o {0}\ng {0}\n", name_of(components[f]));
        text += 'f';
        for (std::int32_t v : surface.face(f)) fmt::format_to(std::back_inserter(text), " {}", v + 1);
        text += '\n';
      }
      return text;
    case Format::off:
      text = fmt::format("OFF\n# {}\n{} {} 0\n", comment, surface.vertex_count(), surface.face_count());
      append_positions(text, surface.positions, "");
      append_faces(text, surface);
      return text;
    case Format::ply:
      text = fmt::format(
          "ply\nformat ascii 1.0\ncomment {}\nelement vertex {}\nproperty double x\nproperty double y\n"
          "property double z\nelement face {}\nproperty list int int vertex_indices\nend_header\n",
          comment, surface.vertex_count(), surface.face_count());
      append_positions(text, surface.positions, "");
      append_faces(text, surface);
      return text;
    default:
      throw UsageError(fmt::format("unsnarl cannot make a new {} file; use obj, off, ply or glb", to_string(format)));
  }
}

std::string highlight_file(const SurfaceView& surface, std::span<const double> positions,
                           const std::vector<IntersectingPair>& before, const std::vector<IntersectingPair>& after) {
  const std::vector<std::int32_t> count_before = pairs_of_faces(before, surface.face_count());
  const std::vector<std::int32_t> count_after = pairs_of_faces(after, surface.face_count());
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment intersecting faces: red now, orange before\n"
      "element vertex {}\nproperty double x\nproperty double y\nproperty double z\nproperty double displacement\n"
      "element face {}\nproperty list int int vertex_indices\nproperty uchar red\nproperty uchar green\n"
      "property uchar blue\nproperty int pairs_before\nproperty int pairs_after\nend_header\n",
      surface.vertex_count(), surface.face_count());
  for (std::size_t i = 0; i + 2 < positions.size(); i += 3) {
    for (std::size_t k = i; k < i + 3; ++k) append_little_endian(bytes, positions[k]);
    double squared = 0;  // std::hypot differs between C libraries
    for (std::size_t k = i; k < i + 3; ++k)
      squared += (positions[k] - surface.positions[k]) * (positions[k] - surface.positions[k]);
    append_little_endian(bytes, std::sqrt(squared));
  }
  for (std::size_t f = 0; f < surface.face_count(); ++f) {
    const auto corners = surface.face(f);
    append_little_endian(bytes, static_cast<std::int32_t>(corners.size()));
    for (std::int32_t v : corners) append_little_endian(bytes, v);
    const Colour& colour = count_after[f] > 0 ? after_colour : count_before[f] > 0 ? before_colour : untouched_colour;
    for (const std::uint8_t channel : colour) bytes += static_cast<char>(channel);
    append_little_endian(bytes, count_before[f]);
    append_little_endian(bytes, count_after[f]);
  }
  return bytes;
}

}  // namespace unsnarl::app
