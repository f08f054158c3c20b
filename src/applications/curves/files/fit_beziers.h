#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "applications/curves/curve_net.h"

namespace unsnarl {

/// A cubic Bézier curve from the point of the one before it, or from the first, to the point `to`.
struct FittedBezier {
  std::size_t to = 0;
  std::array<Vec2, 2> controls;
};

/// Joins points by few cubic Bézier curves without kinks, which come within `tolerance` of all points (Schneider 1990,
/// "An algorithm for automatically fitting digitized curves"). Half-way between neighbouring points a curve is within 5
/// tolerances of their segment.
///
/// points: at least two, neighbours differ. arriving, leaving: the directions at the first and the last point, of any
/// length; zero: those of the segments there.
std::vector<FittedBezier> fit_beziers(std::span<const Vec2> points, const Vec2& arriving, const Vec2& leaving,
                                      double tolerance);

}  // namespace unsnarl
