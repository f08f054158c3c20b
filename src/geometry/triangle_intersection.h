#pragma once

#include <array>

#include "geometry/types.h"

namespace unsnarl {

/// Exact tests between closed points, segments and triangles; touching counts. Triangles may be degenerate only where
/// the function says so.
using TrianglePoints = std::array<Vec3, 3>;

inline TrianglePoints points_of(const Positions& x, const Triangle& t) {
  return {x.col(t[0]), x.col(t[1]), x.col(t[2])};
}

/// Segment pq against a triangle that is not degenerate.
bool segment_meets_triangle(const Vec3& p, const Vec3& q, const TrianglePoints& t);

/// Lower bound of the distance of two triangles: how far one of them lies beyond the plane of the other, or, within
/// that plane, beyond an edge; 0 where neither does beyond doubt from rounding. The bound itself is rounded, by less
/// than 1e-14 of itself.
double separation(const TrianglePoints& a, const TrianglePoints& b);

/// Answer of a test that cannot decide for degenerate triangles.
enum class Meeting { no, yes, ask_degenerate };

/// Two triangles without a common vertex.
Meeting triangles_meet(const TrianglePoints& a, const TrianglePoints& b);

/// Two triangles with a[0] and b[0] their one common vertex: do they meet anywhere else?
Meeting triangles_meet_beyond_vertex(const TrianglePoints& a, const TrianglePoints& b);

/// Two triangles with (a[0], a[1]) and (b[0], b[1]) their common edge: do they overlap flat?
Meeting triangles_fold_flat(const TrianglePoints& a, const TrianglePoints& b);

/// The general case, for pairs with at least one degenerate triangle, which is the segment or the point that it is:
/// do they meet outside the hull of the corners they share? `shared_a[k]` is the corner of b that corner k of a is, or
/// -1.
bool degenerate_triangles_meet(const TrianglePoints& a, const TrianglePoints& b, const std::array<int, 3>& shared_a);

}  // namespace unsnarl
