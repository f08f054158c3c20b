#pragma once

#include <functional>

#include "applications/curves/crossings.h"

namespace unsnarl {

struct SwitchOptions {
  double cost_range = 4;  ///< A pass makes moves that cost up to this many times the cheapest [E189] (no unit)
  /// A move costs this many times more where points are drawn straight. Costs are lengths of curve times the distance
  /// moved [E190] (no unit)
  double pull_cost = 4;
  /// A move costs this many times more where a run has too few points for its new way, so that the drawing changes (no
  /// unit)
  double drawing_cost = 8;
  /// A pass looks at about this many vertices of all moves together [E191] (unit: vertices)
  double affordable_vertices = 5e4;
  Index least_reach = 64;  ///< A move may change this many vertices at least (unit: vertices)
  /// With more crossings, nothing of the drawing can be kept, and loops are turned in any order (unit: crossings a
  /// segment)
  double dense = 3;
  /// Another numbering of a curve is judged at this many of its points [E192] [E193] (unit: points)
  Index renumber_samples = 400;
  int jitters = 5;  ///< Tries of moving apart what nearly touches (unit: tries)
  /// Curves that are closer than this are moved apart (unit: bounding-box diagonal)
  double least_gap_rel = 1e-8;
  /// Such curves are moved apart by this many times as much (unit: least_gap_rel)
  double gap_jitter = 10;
  /// Costs are not told apart where the mean motion of a vertex is below this (unit: bounding-box diagonal)
  double least_motion_rel = 1e-3;
};

/// Removes crossings one by one: at a crossing the strands are joined in another way, so that the drawing stays and the
/// points of the curves change places on it. docs/curves.md explains the moves. `stop` is asked between passes.
/// Returns the crossings that are left: none for a single closed curve whose points may move, unless stopped.
std::vector<SegmentPair> switch_crossings(const CurveNet& net, CurveState& state, const SwitchOptions& options,
                                          const std::function<bool(std::size_t crossings)>& stop);

}  // namespace unsnarl
