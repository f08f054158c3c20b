#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "geometry/types.h"
#include "untangle/conflict_regions.h"
#include "untangle/strategy.h"

namespace unsnarl {

/// A step of the escalation.
struct Level {
  const Strategy* strategy = nullptr;
  bool ends_tier = false;     ///< after it, the best candidates of the tier may be kept
  bool ends_waiting = false;  ///< after it, candidates that wait for nearer ones are kept
};

/// The strategies of the tiers, in order, without those left out by name. Candidates wait until the first last resort.
std::vector<Level> levels_of(std::span<const Tier> tiers, std::span<const std::string> left_out);

/// Which level is to be tried next, for each part of a surface. It starts with level 0 everywhere.
class Agenda {
 public:
  Agenda(Index vertex_count, Index level_count)
      : level_count_(level_count), level_(static_cast<std::size_t>(vertex_count), 0) {}

  /// level_count: all have been tried.
  Index level_of(const ConflictRegion& region) const;

  /// What is tried next: the lowest level of any region, and the vertices of the cores of the regions on it.
  struct Due {
    Index level = 0;
    std::vector<std::uint8_t> vertices;  ///< flags
  };
  /// Regions that are due go on with the next level, unless they restart.
  Due advance(std::span<const ConflictRegion> regions);

  /// Conflicts at these vertices are to be tried from the first level on.
  void restart(std::span<const Index> vertices);

 private:
  Index level_count_;
  std::vector<Index> level_;  // per vertex
};

}  // namespace unsnarl
