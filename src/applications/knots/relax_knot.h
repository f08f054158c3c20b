#pragma once

#include <functional>
#include <vector>

#include "geometry/types.h"

namespace unsnarl {

struct RelaxOptions {
  /// A knot is at rest where the gradient, as long as KnotMetric measures it, is below this (unit: square root of the
  /// energy)
  double gradient_rel = 3e-4;
  int most_steps = 1000;  ///< Steps after which a knot is left as it is [E196] [E197] (unit: steps)
};

struct RelaxedKnot {
  /// From the polygon that was given on; from each to the next the way is proven to be an isotopy, by triangles in R^4
  /// and by moving edges.
  std::vector<Positions> states;
  double energy = 0;
  bool at_rest = false;  ///< false: out of steps, stopped, or no step could be proven
};

/// Lets a knot repel itself (KnotEnergy) until it comes to rest, without ever passing through itself: L-BFGS with the
/// metric as its first Hessian. Its length stays. stop: true: give up.
RelaxedKnot relax_knot(Positions x, const RelaxOptions& options, const std::function<bool()>& stop);

/// Both proofs that the straight way from one polygon to another of as many points is an isotopy.
bool is_proven_way(const Positions& from, const Positions& to);

}  // namespace unsnarl
