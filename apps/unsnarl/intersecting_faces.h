#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "unsnarl/intersections.h"

namespace unsnarl::app {

/// Ids of the faces in any pair, ascending.
inline std::vector<std::int32_t> faces_in(const std::vector<IntersectingPair>& pairs) {
  std::vector<std::int32_t> faces;
  faces.reserve(2 * pairs.size());
  for (const IntersectingPair& pair : pairs) {
    faces.push_back(pair.a);
    faces.push_back(pair.b);
  }
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  return faces;
}

}  // namespace unsnarl::app
