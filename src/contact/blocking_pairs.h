#pragma once

#include <algorithm>
#include <span>
#include <tuple>
#include <vector>

#include "unsnarl/intersections.h"

namespace unsnarl {

/// The two triangles of `pair` are in a pair of `tolerated` (sorted), of whatever class.
inline bool is_among(const IntersectingPair& pair, std::span<const IntersectingPair> tolerated) {
  const auto it = std::lower_bound(tolerated.begin(), tolerated.end(), pair, [](const auto& p, const auto& q) {
    return std::tie(p.a, p.b) < std::tie(q.a, q.b);
  });
  return it != tolerated.end() && it->a == pair.a && it->b == pair.b;
}

/// The pairs that are not among `tolerated` (sorted), in their order.
inline std::vector<IntersectingPair> blocking_pairs(std::vector<IntersectingPair> pairs,
                                                    std::span<const IntersectingPair> tolerated) {
  std::erase_if(pairs, [&](const IntersectingPair& pair) { return is_among(pair, tolerated); });
  return pairs;
}

}  // namespace unsnarl
