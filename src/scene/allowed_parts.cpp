#include "scene/allowed_parts.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

#include "geometry/sort_unique.h"

namespace unsnarl {
namespace {

/// The parts that a pair names, ascending.
std::vector<std::int32_t> named_numbers(const AllowedPairs& allowed) {
  std::vector<std::int32_t> named;
  for (const std::array<std::int32_t, 2>& pair : allowed.parts) named.insert(named.end(), pair.begin(), pair.end());
  sort_unique(named);
  return named;
}

void require_sense(const SurfaceView& surface, const AllowedPairs& allowed) {
  if (allowed.part_of_face.empty() && !allowed.parts.empty())
    throw std::invalid_argument("AllowedPairs::parts names parts, but part_of_face is empty; give one number a face");
  if (!allowed.part_of_face.empty() && allowed.part_of_face.size() != surface.face_count())
    throw std::invalid_argument("AllowedPairs::part_of_face has " + std::to_string(allowed.part_of_face.size()) +
                                " numbers for " + std::to_string(surface.face_count()) + " faces");
  for (const auto& pair : allowed.parts)
    for (const std::int32_t part : pair)
      if (part < 0)
        throw std::invalid_argument("AllowedPairs::parts names part " + std::to_string(part) +
                                    "; parts are counted from 0");
}

}  // namespace

std::vector<Index> AllowedParts::of_triangles(std::span<const Index> face_of_triangle) const {
  std::vector<Index> parts;
  if (!any()) return parts;
  parts.reserve(face_of_triangle.size());
  for (const Index f : face_of_triangle) parts.push_back(of_face[f]);
  return parts;
}

AllowedParts allowed_parts(const SurfaceView& surface, const AllowedPairs& allowed) {
  require_sense(surface, allowed);
  if (allowed.empty()) return {};
  // The table of parts holds only those that some pair names, and one for all other faces.
  const std::vector<std::int32_t> named = named_numbers(allowed);
  const auto other = static_cast<Index>(named.size());
  const auto number = [&](std::int32_t part) {
    const auto at = std::lower_bound(named.begin(), named.end(), part);
    return at == named.end() || *at != part ? other : static_cast<Index>(at - named.begin());
  };
  AllowedParts parts;
  std::vector<std::array<Index, 2>> pairs;
  for (const auto& [p, q] : allowed.parts) pairs.push_back({number(p), number(q)});
  parts.passing = PassingParts(other + 1, pairs);
  parts.of_face.reserve(allowed.part_of_face.size());
  for (const std::int32_t part : allowed.part_of_face) parts.of_face.push_back(number(part));
  return parts;
}

}  // namespace unsnarl
