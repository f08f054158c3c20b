#pragma once

#include <limits>
#include <span>

#include "geometry/scale.h"
#include "geometry/types.h"

namespace unsnarl {

/// Axis-aligned box, closed. Default: empty (overlaps nothing).
struct Box {
  Vec3 lo = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 hi = Vec3::Constant(-std::numeric_limits<double>::infinity());

  void extend(const Vec3& p) {
    lo = lo.cwiseMin(p);
    hi = hi.cwiseMax(p);
  }
  void extend(const Box& other) {
    lo = lo.cwiseMin(other.lo);
    hi = hi.cwiseMax(other.hi);
  }
  bool overlaps(const Box& other) const {
    return lo[0] <= other.hi[0] && other.lo[0] <= hi[0] && lo[1] <= other.hi[1] && other.lo[1] <= hi[1] &&
           lo[2] <= other.hi[2] && other.lo[2] <= hi[2];
  }
  Box inflated(double by) const { return {lo - Vec3::Constant(by), hi + Vec3::Constant(by)}; }
  Vec3 center() const { return 0.5 * (lo + hi); }
  double diagonal() const { return (hi - lo).norm(); }
};

/// Diagonal of the bounding box of these points, x y z of each, at this scale; 0 of none.
inline double diagonal_of_box(std::span<const double> points, const Scale& scale) {
  Box box;
  for (std::size_t i = 0; i + 2 < points.size(); i += 3) box.extend(Vec3(points[i], points[i + 1], points[i + 2]));
  if (points.empty()) return 0;
  for (double* bound : {box.lo.data(), box.hi.data()})
    for (int k = 0; k < 3; ++k) bound[k] = scale.in(bound[k]);
  return box.diagonal();
}

inline Box box_of(const Positions& x, const Triangle& t) {
  Box box;
  for (Index v : t) box.extend(Vec3(x.col(v)));
  return box;
}

}  // namespace unsnarl
