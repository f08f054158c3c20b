#include "contact/motion_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace unsnarl {
namespace {

/// Rounding changes a projection by less than this, with a wide reserve (unit: share of the projected lengths)
constexpr double projection_rounding = 1e-14;

}  // namespace

bool MotionBounds::allow(Index v, const Vec3& displacement) const {
  const Vec3 p = along.col(v);
  const double length2 = p.squaredNorm();
  const double t = length2 > 0 ? std::clamp(displacement.dot(p) / length2, 0.0, 1.0) : 0.0;
  return (displacement - t * p).norm() <= around[v];
}

double least_distance(const Stencil& s, const Positions& x, const MotionBounds& bounds, const Vec3& direction) {
  const int first = s.kind == StencilKind::edge_edge ? 2 : 1;
  const Vec3 origin = x.col(s.v[first]);
  double nearest = std::numeric_limits<double>::infinity(), farthest = -nearest;
  double around[2] = {0, 0}, length = 0;
  for (int i = 0; i < s.size(); ++i) {
    const Index v = s.v[i];
    const Vec3 from_origin = x.col(v) - origin, p = bounds.along.col(v);
    const double at = direction.dot(from_origin), motion = direction.dot(p);
    double& room = around[i < first ? 0 : 1];
    room = std::max(room, bounds.around[v]);
    if (i < first)
      nearest = std::min(nearest, at + std::min(0.0, motion));
    else
      farthest = std::max(farthest, at + std::max(0.0, motion));
    length = std::max(length, from_origin.cwiseAbs().sum() + p.cwiseAbs().sum());
  }
  return nearest - farthest - (around[0] + around[1]) - projection_rounding * length;
}

}  // namespace unsnarl
