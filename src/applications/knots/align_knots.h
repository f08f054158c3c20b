#pragma once

#include <vector>

#include "geometry/types.h"

namespace unsnarl {

/// A similarity p -> scale rotation (p - from) + to, and which points it takes to which: point k of one polygon to
/// point first + k of the other, or to first - k.
struct Alignment {
  Eigen::Matrix3d rotation;
  double scale = 1;
  Vec3 from, to;
  Index first = 0;
  bool backwards = false;
  double distance = 0;  ///< root of the mean square that is left / that of the points from their centre

  Positions applied(const Positions& x) const;
};

/// The points of a polygon in another order: first, first + 1, ... or first, first - 1, ...
Positions reordered(const Positions& x, Index first, bool backwards);

/// Alignments of y to x, which has as many points, that are better than those with a neighbouring first point; nearest
/// first, at most `most`. `backwards`: y is passed in the other direction. Closed form (W. Kabsch, 1976) for every
/// first point.
std::vector<Alignment> alignments(const Positions& x, const Positions& y, bool backwards, std::size_t most);

/// The first point of y for which the squares of the distances from point k of x to point first + k of y have the
/// smallest sum.
Index nearest_order(const Positions& x, const Positions& y);

}  // namespace unsnarl
