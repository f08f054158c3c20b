#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "geometry/types.h"
#include "unsnarl/intersections.h"

namespace unsnarl {

/// A log of what was tried with each welded vertex of a surface, to say afterwards why pairs are left. Written by one
/// thread at a time.
struct AttemptLog {
  explicit AttemptLog(const Positions& rest)
      : strategy(rest.cols(), -1), is_cut_short(rest.cols(), 0), is_too_far(rest.cols(), 0), solved(rest) {}

  /// number (see strategies.h) of the furthest one that its conflict was tried on; -1: none
  std::vector<std::int8_t> strategy;
  std::vector<std::uint8_t>
      is_cut_short;                      ///< a limit came before all strategies were tried on a conflict that it is in
  std::vector<std::uint8_t> is_too_far;  ///< had its conflict been resolved, something would lie farther than allowed
  Positions solved;                      ///< what the solvers came to last, before anything was rounded or taken back

  /// The strategy of this name was tried on a conflict of these vertices.
  void note_tried(std::span<const Index> vertices, std::string_view name);
  void note_too_far(std::span<const Index> vertices);
  void note_cut_short(std::span<const IntersectingPair> pairs, std::span<const Triangle> triangles);
};

}  // namespace unsnarl
