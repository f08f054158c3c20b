#pragma once

#include <functional>

#include "applications/curves/curve_net.h"

namespace unsnarl {

struct CurveRecoverOptions {
  /// Length over which a displacement spreads along a curve: shorter bends of it cost more than the pull to the target
  /// [E186] (unit: bounding-box diagonal)
  double spread_rel = 0.02;
  double barrier = 0.05;  ///< Force of the barrier [E187] (unit: pull of a vertex that is a diagonal away)
  int max_steps = 80;     ///< Newton steps, at most [E188] (unit: steps)
  /// A Newton step is small where no vertex moves farther than this (unit: bounding-box diagonal)
  double motion_rel = 2e-5;
  /// Closer contacts are opened step by step: the barrier sets in later for them (unit: gap)
  double tight_part = 0.1;
  /// Their barrier sets in at no less than this, so that no pull can close what is opening (unit: bounding-box
  /// diagonal)
  double least_activation_rel = 1e-5;
  /// Where vertices have little room between crossings, no less than this is kept (unit: gap)
  double least_room = 0.1;
  /// Points of one curve that are no farther apart along it may be as near as the target wants (unit: gaps)
  double beside_gaps = 3;
  /// Half of this is where the barrier of such points sets in at least (unit: gap)
  double least_beside_part = 1e-3;
  /// Least weight of a vertex, so that no row of the Hessian is zero (unit: bounding-box diagonal)
  double least_weight_rel = 1e-9;
  /// Least length of an edge in the bending energy, so that no row of the Hessian is infinite (unit: bounding-box
  /// diagonal)
  double least_edge_rel = 1e-6;
  /// A step is halved until the energy falls, down to this share of it (no unit)
  double least_part = 1e-3;
  int small_steps = 3;  ///< Small steps in a row that end the recovery (unit: steps)
  /// Share of the distance between a vertex and a segment that either may move, below a half (no unit)
  double safe_part = 0.45;
  /// Longest motion of a vertex in a step, which bounds the pairs to be looked at (unit: bounding-box diagonal)
  double largest_step = 0.03;
};

/// Moves the vertices from state.x, where nothing meets, toward state.target and never through each other: a Newton
/// method on
///   sum_v w_v |u_v|^2 / 2 + spread^4 int |u''|^2 / 2 + barrier terms of vertices and segments closer than `gap`,
/// u = x - target, with steps in which no vertex reaches any segment. Returns the number of steps.
int recover_curves(const CurveNet& net, CurveState& state, double gap, const CurveRecoverOptions& options,
                   const std::function<bool()>& stop);

}  // namespace unsnarl
