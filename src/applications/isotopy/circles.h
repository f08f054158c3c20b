#pragma once

#include <span>
#include <vector>

#include "applications/isotopy/rings.h"

namespace unsnarl {

/// Triangles on their way to be circles.
struct CirclesWay {
  /// Places on the triangles that the points of the rings come from.
  std::vector<std::vector<IsotopyPlace>> places;
  /// The first are the triangles, the last regular polygons. From ring to ring every point moves straight.
  std::vector<Polygons> rings;
};

/// Every triangle becomes a circle of `count` points in it; what lies in it is drawn to less than half the radius.
/// `parent`: the innermost other triangle in which each lies, or -1; `sides`: 1 for a counter-clockwise one, -1.
CirclesWay make_circles(Polygons triangles, std::span<const Index> parent, std::span<const double> sides, int count);

struct Incircle {
  Vec2 middle;
  double radius = 0;
};
Incircle incircle_of(const Vec2& a, const Vec2& b, const Vec2& c);

}  // namespace unsnarl
