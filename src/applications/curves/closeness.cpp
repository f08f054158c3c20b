#include "applications/curves/closeness.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "applications/curves/segment_tree.h"

namespace unsnarl {
namespace {

/// Length of the pieces at whose ends and middle distances are measured, at least (unit: bounding-box diagonal)
constexpr double piece_rel = 1e-3;
/// Pieces are so long that there are no more than about this many: 0.3 s (unit: pieces)
constexpr double places_of_long_curves = 1e5;
/// Half the side of the first box in which the nearest place is looked for, at least (unit: bounding-box diagonal)
constexpr double least_reach_rel = 1e-6;

using SegmentPlace = std::array<double, 4>;

SegmentPlace place_of_segment(const Points2& x, const Edge& segment) {
  const std::array<double, 2> a{x(0, segment[0]), x(1, segment[0])}, b{x(0, segment[1]), x(1, segment[1])};
  const auto& [first, last] = std::minmax(a, b);
  return {first[0], first[1], last[0], last[1]};
}

}  // namespace

Closeness closeness_of(const CurveNet& from, const Points2& x, const CurveNet& to, const Points2& y, double tolerance) {
  std::set<SegmentPlace> common;  // segments of both drawings
  for (const Edge& segment : to.segments) common.insert(place_of_segment(y, segment));
  double length = 0;
  for (const auto& [a, b] : from.segments) length += (x.col(b) - x.col(a)).norm();
  const double longest = std::max(piece_rel * from.diagonal, length / places_of_long_curves);
  SegmentTree tree(to);
  tree.refit(y);
  // Boxes grow until the nearest place found is within the box. From place to place the distance changes by no more
  // than the way, which is where to begin.
  const auto distance_of = [&](const Vec2& p, double expected) {
    double nearest = std::numeric_limits<double>::infinity();
    for (double reach = std::max(expected, least_reach_rel * from.diagonal);; reach *= 2) {
      const Vec2 r = Vec2::Constant(reach);
      tree.near(p - r, p + r, [&](Index s) {
        const Vec2 a = y.col(to.segments[s][0]), b = y.col(to.segments[s][1]);
        nearest = std::min(nearest, distance_to_segment(p, a, b));
      });
      if (nearest <= reach) return nearest;
    }
  };
  Closeness result;
  for (const Edge& segment : from.segments) {
    if (common.contains(place_of_segment(x, segment))) continue;
    const Vec2 a = x.col(segment[0]), d = x.col(segment[1]) - a;
    const double pieces = std::max(1.0, std::ceil(d.norm() / longest));
    const double piece = d.norm() / pieces;
    double at_end = distance_of(a, 0);
    result.largest = std::max(result.largest, at_end);
    for (double k = 0; k < pieces; ++k) {
      const double middle = distance_of(a + (k + 0.5) / pieces * d, at_end + 0.5 * piece);
      at_end = distance_of(a + (k + 1) / pieces * d, middle + 0.5 * piece);
      result.largest = std::max({result.largest, middle, at_end});
      result.mean += middle * piece;
      if (middle > tolerance) result.lost += piece;
    }
  }
  if (length > 0) {
    result.mean /= length;
    result.lost /= length;
  }
  return result;
}

}  // namespace unsnarl
