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
///   - where a curve crosses itself, it passes the loop between the two visits backwards, and stays one curve. Of all
///     such crossings the one comes first whose strands go on the straightest.
///   - two curves that cross twice exchange the parts between, the shortest parts first. Two open curves that cross
///     once exchange the parts behind the crossing. Parts with pinned vertices are not exchanged.
/// Crossings that neither resolves stay, those of an open curve that ends within a closed one for instance; so do those
/// that are left when stop() says true. It is asked at every crossing.
ReroutedCurves reroute_crossings(const CrossedCurves& curves, const std::function<bool()>& stop);

}  // namespace unsnarl
