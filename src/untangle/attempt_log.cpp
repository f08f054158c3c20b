#include "untangle/attempt_log.h"

#include <algorithm>

#include "untangle/strategies.h"

namespace unsnarl {

void AttemptLog::note_tried(std::span<const Index> vertices, std::string_view name) {
  const auto number = static_cast<std::int8_t>(strategy_number(name));
  for (const Index v : vertices) strategy[v] = std::max(strategy[v], number);
}

void AttemptLog::note_too_far(std::span<const Index> vertices) {
  for (const Index v : vertices) is_too_far[v] = 1;
}

void AttemptLog::note_cut_short(std::span<const IntersectingPair> pairs, std::span<const Triangle> triangles) {
  for (const IntersectingPair& pair : pairs)
    for (const Index t : {pair.a, pair.b})
      for (const Index v : triangles[t]) is_cut_short[v] = 1;
}

}  // namespace unsnarl
