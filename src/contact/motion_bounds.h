#pragma once

#include <vector>

#include "contact/distances.h"

namespace unsnarl {

/// Where vertices may be while a list of stencils is used: vertex v within around[v] of the segment from x.col(v) to
/// x.col(v) + along.col(v), where x are the positions the list was gathered at.
struct MotionBounds {
  Positions along;
  std::vector<double> around;

  /// All stay where they are, at first.
  void reset(Index vertex_count) {
    along.setZero(3, vertex_count);
    around.assign(static_cast<std::size_t>(vertex_count), 0);
  }
  /// Whether vertex v may be `displacement` away from where it was.
  bool allow(Index v, const Vec3& displacement) const;
};

/// Lower bound of the distance of a stencil while its vertices stay within their bounds: how far apart they remain
/// along `direction`, a unit vector (or zero) from the second primitive to the first. Negative where they may pass each
/// other.
double least_distance(const Stencil& stencil, const Positions& x, const MotionBounds& bounds, const Vec3& direction);

}  // namespace unsnarl
