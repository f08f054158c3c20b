#pragma once

#include <functional>

#include "applications/curves/crossings.h"

namespace unsnarl {

struct SwitchOptions {
  /// A pass makes moves that cost up to so many times the cheapest. On 20 random curves of each kind, 2 took twice the
  /// time on noisy curves and moved splines 3 % farther, 16 moved splines 5 % farther.
  double cost_range = 4;
  /// Costs are lengths of curve times the distance moved. Moves that change the drawing cost more than those that only
  /// exchange points on it: where points are drawn straight, and where a run has too few points for its new way. With
  /// pull_cost 1 splines ended eight times as far from the drawing; drawing_cost 1 and 32 were worse by a half.
  double pull_cost = 4, drawing_cost = 8;
  /// Vertices of all moves together that a pass looks at, about, and the fewest that one move may change: 780 crossings
  /// of 1,696 points took 4.1 s of CPU without these, 0.6 s with 2e5, 0.5 s with 5e4.
  double affordable_vertices = 5e4;
  Index least_reach = 64;
  /// Crossings a segment beyond which nothing of the drawing can be kept, and loops are turned in any order: random
  /// curves of the smooth kinds stay below 1, points joined at random have 100.
  double dense = 3;
  /// Points of a curve at which another numbering is judged; all of them gave the same results.
  Index renumber_samples = 400;
  /// How far a curve is drawn in where it lies on another one / diagonal, a quarter of the default gap; no farther than
  /// this part of the shorter segment beside a point.
  double inset_rel = 1e-3, inset_part = 0.25;
  /// Tries of moving touching segments apart by a part of their length, tenfold each time.
  int jitters = 5;
  double jitter = 1e-7;            ///< the first part
  double least_jitter_rel = 1e-6;  ///< shorter segments count as this long / diagonal
  /// Curves that are closer than this / diagonal are moved apart by so many times as much.
  double least_gap_rel = 1e-8, gap_jitter = 10;
  /// Motion of one mean vertex / diagonal below which costs are not told apart.
  double least_motion_rel = 1e-3;
};

/// Takes crossings away one by one where the curves are joined otherwise at them: the drawing stays, and the points of
/// the curves change places on it. docs/curves.md explains the moves. `stop` is asked between passes.
/// Returns the crossings left: none for a single closed curve whose points may move, unless stopped.
std::vector<SegmentPair> switch_crossings(const CurveNet& net, CurveState& state, const SwitchOptions& options,
                                          const std::function<bool(std::size_t crossings)>& stop);

}  // namespace unsnarl
