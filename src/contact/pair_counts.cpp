#include <numeric>

#include "geometry/sort_unique.h"
#include "unsnarl/intersections.h"

namespace unsnarl {

std::size_t PairCounts::total() const {
  return std::accumulate(by_class.begin(), by_class.end(), std::size_t{0});
}

PairCounts count_by_class(const std::vector<IntersectingPair>& pairs) {
  PairCounts counts;
  for (const IntersectingPair& pair : pairs) ++counts[pair.kind];
  return counts;
}

std::vector<std::int32_t> intersecting_faces(const std::vector<IntersectingPair>& pairs) {
  std::vector<std::int32_t> faces;
  faces.reserve(2 * pairs.size());
  for (const IntersectingPair& pair : pairs) faces.insert(faces.end(), {pair.a, pair.b});
  sort_unique(faces);
  return faces;
}

}  // namespace unsnarl
