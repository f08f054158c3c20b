#pragma once

#include <functional>

#include "applications/curves/crossing_points.h"

namespace unsnarl {

/// Curves that run through a drawing in another order.
struct ReroutedCurves {
  CurveNet net;                      ///< the same vertices in other chains
  std::vector<std::uint8_t> turned;  ///< one a vertex: passed backwards, or by another curve
};

/// Joins the strands at crossings in another way, so that they do not cross there and the drawing stays. The vertices
/// stay where they are; the curves pass them in another order:
///   - where a curve crosses itself, it passes the loop between the two visits backwards, and stays one curve.
///   Crossings
///     whose strands go on the straightest come first.
///   - two curves that cross twice exchange the parts between, the shortest parts first. Two open curves that cross
///     once exchange the parts behind the crossing. Parts with pinned vertices are not exchanged.
///   - of a closed curve and an open one that cross three times or another odd number, the open one takes a part in
///     which one of their other crossings lies, and crosses itself there.
/// Crossings that none of this resolves stay, as the only one of an open curve and a closed one; so do those that are
/// left when stop() says true. It is asked at every crossing.
ReroutedCurves reroute_crossings(const CrossedCurves& curves, const std::function<bool()>& stop);

}  // namespace unsnarl
