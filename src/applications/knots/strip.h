#pragma once

#include <span>
#include <vector>

#include "applications/knots/triangles4.h"

namespace unsnarl {

/// The piece of a cylinder in R^4 between two closed polygons at different heights: a strip of triangles, each of which
/// joins an edge of one polygon with a vertex of the other. Every level between cuts each triangle in one segment, and
/// the segments follow each other around a closed polygon.
struct StripTriangle {
  bool on_lower = false;  ///< the edge is one of the lower polygon
  Index edge = 0;         ///< number of the vertex that it starts from
  Index apex = 0;         ///< of the other polygon
};

/// Between polygons of n points each: a quad between every two edges, cut from point k of the lower polygon to point
/// k + 1 of the upper one.
std::vector<StripTriangle> straight_strip(Index n);
/// From a polygon up to a finer one: edge k of it is below pieces[k] edges of the finer one.
std::vector<StripTriangle> strip_to_finer(std::span<const Index> pieces);
/// The same upside down: the finer polygon is the lower one; its edges below edge 0 begin at point `first`.
std::vector<StripTriangle> strip_from_finer(std::span<const Index> pieces, Index first = 0);

/// Pair of triangles of a strip, a < b.
struct StripPair {
  Index a = 0, b = 0;
};

/// The pairs that meet beyond the corners and edges that they share, sorted; at most `most` of them. None: the polygon
/// of every level, both ends included, is simple, so that the strip is an isotopy. Decided by exact arithmetic.
/// Edges of length 0 count as meeting.
std::vector<StripPair> meeting_pairs(const Positions& lower, const Positions& upper,
                                     std::span<const StripTriangle> strip, std::size_t most);

/// Its corners, the lower polygon at height 0, the upper one at `height`.
Triangle4 corners_of(const StripTriangle& triangle, const Positions& lower, const Positions& upper, double height);

/// Whether the straight way from one polygon to another of as many points is an isotopy.
bool is_isotopy(const Positions& lower, const Positions& upper);

}  // namespace unsnarl
