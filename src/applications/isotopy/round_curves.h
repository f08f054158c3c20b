#pragma once

#include <functional>
#include <vector>

#include "applications/curves/curve_net.h"

namespace unsnarl {

struct RoundOptions {
  /// A vertex moves by at most this share of its distance to the nearest segment, and of its segments' to the nearest
  /// vertex. Two moves and the bend of a triangulated quad, a quarter of two moves, stay below the distance: at most
  /// 1/3 (no unit)
  double move_of_distance = 0.3;
  /// A convex curve counts as round from this value of 4 pi area / length^2 on; a circle has 1 (no unit)
  double roundness = 0.9;
  /// Steps after which the caller is told that the curves do not become round [E194] (unit: steps)
  int most_steps = 200000;
  /// Curves that wait for others shrink by this factor in each step, so that they are in no one's way (no unit)
  double shrinking = 0.98;
  /// One flag a chain: others lie in it, so that it does not shrink while it waits.
  std::vector<std::uint8_t> holds_others;
};

/// Shortens the closed curves of a net, which are simple and disjoint, until each is convex and round. Returns their
/// states on the way, from x on; empty: stopped, or given up. `compact` is called at intervals to remove states between
/// the first and the last.
///
/// Each step is one of the curve shortening flow, which makes any simple curve round (M. A. Grayson 1987), in the
/// parametrisation of K. Deckelnick and G. Dziuk, "On the approximation of the curve shortening flow", 1995, that
/// spreads the points evenly: |x_u|^2 x_t = x_uu, implicit in time. Then every vertex's step is cut to what its
/// surroundings allow, so that nothing meets on the way from one state to the next.
std::vector<Points2> round_curves(const CurveNet& net, Points2 x, const RoundOptions& options,
                                  const std::function<bool()>& stop,
                                  const std::function<void(std::vector<Points2>&)>& compact);

/// 4 pi area / length^2 of a chain where it is convex and counter-clockwise (side = 1) or clockwise (-1), else 0.
double roundness_of(const CurveNet& net, const CurveNet::Chain& chain, const Points2& x);

}  // namespace unsnarl
