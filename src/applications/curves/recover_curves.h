#pragma once

#include <functional>

#include "applications/curves/curve_net.h"

namespace unsnarl {

struct CurveRecoverOptions {
  /// Length over which a displacement spreads along a curve / diagonal: shorter bends of it cost more than the pull to
  /// the target. 0.01 to 0.05 end equally far from the input; the shorter, the more local is what moves.
  double spread_rel = 0.02;
  /// Force of the barrier against the pull of a vertex that is a diagonal away. 0.02 and 0.2 end equally far from the
  /// input; the larger, the wider stay gaps under pressure, and 0.2 takes half as long again.
  double barrier = 0.05;
  int max_steps = 80;        ///< of Newton's method; random curves take 4 to 21 in the median
  double motion_rel = 2e-5;  ///< stops when no vertex moves farther in a step / diagonal
  /// Contacts closer than this part of the gap are opened step by step: the barrier sets in later for them, but not
  /// below a length / diagonal, so that no pull can close what is opening.
  double tight_part = 0.1, least_activation_rel = 1e-5;
  /// Points of one curve that are no farther apart along it than so many gaps may be as near as the target wants, but
  /// no nearer than this part of the gap: halves of these lengths are where the barrier sets in.
  double beside_gaps = 3, least_beside_part = 1e-3;
  /// Least weight of a vertex, and least length of an edge in the bending energy / diagonal: no row of the Hessian is
  /// zero or infinite.
  double least_weight_rel = 1e-9, least_edge_rel = 1e-6;
  double least_part = 1e-3;    ///< of a step that is halved until the energy falls
  int small_steps = 3;         ///< below motion_rel, one after the other, that end it
  double safe_part = 0.45;     ///< of the distance between a vertex and a segment that either may move: below a half
  double largest_step = 0.03;  ///< of a vertex / diagonal: bounds the pairs to be looked at
};

/// Moves the vertices from state.x, where nothing meets, toward state.target and never through each other: a Newton
/// method on
///   sum_v w_v |u_v|^2 / 2 + spread^4 int |u''|^2 / 2 + barrier terms of vertices and segments closer than `gap`,
/// u = x - target, with steps in which no vertex reaches any segment. Returns the number of steps.
int recover_curves(const CurveNet& net, CurveState& state, double gap, const CurveRecoverOptions& options,
                   const std::function<bool()>& stop);

}  // namespace unsnarl
