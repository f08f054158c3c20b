#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "oracle/intersections_oracle.h"

namespace unsnarl::oracle {

/// The part of the definition that needs no arithmetic, shared by both oracles. `meet_outside_hull(shared)` says
/// whether the two triangles meet outside the hull of the vertices `shared`.
template <class MeetOutsideHull>
std::optional<PairClass> classify(OracleTriangle a, OracleTriangle b, bool zero_area_involved,
                                  MeetOutsideHull meet_outside_hull) {
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  std::vector<std::int32_t> shared;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(shared));
  shared.erase(std::unique(shared.begin(), shared.end()), shared.end());

  if (shared.size() == 3) return PairClass::duplicate;
  if (!meet_outside_hull(shared)) return std::nullopt;
  if (zero_area_involved) return PairClass::degenerate;
  switch (shared.size()) {
    case 0: return PairClass::disjoint;
    case 1: return PairClass::one_vertex;
    default: return PairClass::folded;
  }
}

}  // namespace unsnarl::oracle
