#include "applications/knots/untangle_cylinder.h"

#include "applications/knots/strip.h"

namespace unsnarl {
namespace {

std::vector<KnotDoublePoint> double_points(const std::vector<Positions>& rings) {
  std::vector<KnotDoublePoint> points;
  const double strips = static_cast<double>(rings.size() - 1);
  const std::vector<StripTriangle> strip = straight_strip(static_cast<Index>(rings.front().cols()));
  for (std::size_t k = 0; k + 1 < rings.size(); ++k)
    for (const StripPair& pair : meeting_pairs(rings[k], rings[k + 1], strip, SIZE_MAX)) {
      const StripTriangle &s = strip[pair.a], &t = strip[pair.b];
      const Triangle4 a = corners_of(s, rings[k], rings[k + 1], 1), b = corners_of(t, rings[k], rings[k + 1], 1);
      // Corners run around the cylinder the one way where the edge is below, else the other.
      const int sign = crossing_sign(a, b) * (s.on_lower == t.on_lower ? 1 : -1);
      const Vec4 p = sign != 0 ? crossing_point(a, b) : Vec4((a[0] + b[0]) / 2);
      points.push_back({(static_cast<double>(k) + p[3]) / strips, {p[0], p[1], p[2]}, sign});
    }
  return points;
}

}  // namespace

UntangledCylinder untangle_cylinder(const Positions& from, const Positions& to,
                                    const std::function<bool(double fraction)>& stop) {
  UntangledCylinder made;
  made.rings = {from, to};
  made.straight = made.left = double_points(made.rings);
  stop(1);
  return made;
}

}  // namespace unsnarl
