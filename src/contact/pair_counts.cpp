#include <numeric>

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

}  // namespace unsnarl
