#pragma once

#include <functional>
#include <vector>

#include "applications/isotopy/rings.h"

namespace unsnarl {

/// Points of closed polygons, those of all polygons in one list. Some are corners; the others lie on the edges between
/// corners.
struct Corners {
  Points2 x;
  std::vector<std::uint8_t> is_corner;  ///< one a point
  std::vector<std::uint8_t> is_kept;    ///< one a point: a corner that must stay
  std::vector<Index> before, after;     ///< one a point: of a corner the corners beside it
  std::vector<Index> polygon;           ///< one a point
  std::vector<Index> count;             ///< corners, one a polygon
};

/// A corner moves straight to a place on the segment between the two beside it, which stay. No other corner lies in the
/// triangle of the three, so the polygons stay simple and disjoint.
struct CornerRemoval {
  Index before = 0, corner = 0, after = 0;
};

/// Removes corners, one after the other, until polygons are triangles or nothing can be removed: first those that
/// shorten least compared with what is free around them. A polygon that has no other in it always becomes a
/// triangle, since every simple polygon has two ears (G. H. Meisters 1975), unless corners are kept. Precondition: the
/// polygons are simple and disjoint. Ends early where stop() says true, as the others here do.
std::vector<CornerRemoval> remove_corners(Corners corners, const std::function<bool()>& stop);

/// The same for one polygon as if it were alone, and inward only: what is cut off are the triangles of a triangulation;
/// the last one is what is left.
std::vector<CornerRemoval> remove_ears(Corners corners, Index polygon, double side, const std::function<bool()>& stop);

/// Which removals can be done at once: those of one number can, one after the other as the numbers say. Triangles of
/// one number have nothing in common but ends.
std::vector<int> rounds_of(const Points2& x, const std::vector<CornerRemoval>& removals,
                           const std::function<bool()>& stop);

}  // namespace unsnarl
