#pragma once

#include <functional>
#include <vector>

#include "geometry/types.h"

namespace unsnarl {

struct RelaxOptions {
  /// It has come to rest where the gradient, as long as KnotMetric measures it, is below this part of the energy's
  /// square root. Trefoils from a braid of two strands, of three, and of a planar diagram then have the same energy to
  /// five digits.
  double gradient_rel = 3e-4;
  /// Steps after which it is left as it is. Ochiai's second unknot, of 45 crossings, needs 121.
  int most_steps = 1000;
};

struct RelaxedKnot {
  /// From the polygon that was given on; from each to the next the way is proven to be an isotopy, by triangles in R^4
  /// and by moving edges.
  std::vector<Positions> states;
  double energy = 0;
  bool at_rest = false;  ///< false: out of steps, stopped, or no step could be proven
};

/// Lets a knot repel itself (KnotEnergy) until it comes to rest, without ever passing through itself: L-BFGS with the
/// metric as its first Hessian. Its length stays. Alone, the metric took ten times the steps. stop: true: give up.
RelaxedKnot relax_knot(Positions x, const RelaxOptions& options, const std::function<bool()>& stop);

/// Both proofs that the straight way from one polygon to another of as many points is an isotopy.
bool is_proven_way(const Positions& from, const Positions& to);

}  // namespace unsnarl
