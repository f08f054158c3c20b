#include "untangle/agenda.h"

#include <algorithm>

namespace unsnarl {

std::vector<Level> levels_of(std::span<const Tier> tiers, std::span<const std::string> left_out) {
  std::vector<Level> levels;
  bool is_waiting_over = false;
  const auto end_waiting = [&] {
    if (!levels.empty()) levels.back().ends_waiting = true;
    is_waiting_over = true;
  };
  for (const Tier& tier : tiers) {
    const std::size_t first = levels.size();
    for (const Strategy& strategy : tier.strategies) {
      if (std::find(left_out.begin(), left_out.end(), strategy.name) != left_out.end()) continue;
      if (tier.is_last_resort) end_waiting();
      levels.push_back({&strategy, false, is_waiting_over});
    }
    if (levels.size() > first) levels.back().ends_tier = true;
  }
  end_waiting();
  return levels;
}

Index Agenda::level_of(const ConflictRegion& region) const {
  Index level = 0;
  for (const Index v : region.core) level = std::max(level, level_[v]);
  return level;
}

Agenda::Due Agenda::advance(std::span<const ConflictRegion> regions) {
  Due due{level_count_, std::vector<std::uint8_t>(level_.size(), 0)};
  for (const ConflictRegion& region : regions) due.level = std::min(due.level, level_of(region));
  for (const ConflictRegion& region : regions) {
    if (level_of(region) != due.level) continue;
    for (const Index v : region.core) {
      level_[v] = std::min(due.level + 1, level_count_);
      due.vertices[v] = 1;
    }
  }
  return due;
}

void Agenda::restart(std::span<const Index> vertices) {
  for (const Index v : vertices) level_[v] = 0;
}

}  // namespace unsnarl
