#pragma once

#include <span>
#include <vector>

#include "applications/isotopy/rings.h"

namespace unsnarl {

/// Which places of the curves of the start become which of the end: one list a curve, and as many places on both.
struct Correspondence {
  std::vector<std::vector<IsotopyPlace>> on_start, on_end;
};

/// The polygon through these places of another one; its own points bit for bit.
Points2 points_at(const Points2& polygon, std::span<const IsotopyPlace> places);

/// Where a curve of the end begins to be matched with point 0 of the start's: a fraction of its length.
enum class Laying {
  places,      ///< the squares of the distances that are left once the middles are moved onto each other are least
  directions,  ///< the turn from one to the other differs least along the curves
};
double first_fraction(const Points2& start, const Points2& end, Laying laying);

/// Places at equal fractions of the lengths, from `first` (one a curve) on: all corners of both sides, of which those
/// that nearly fall together become one, then points on the longest pieces until there are `least`.
Correspondence correspondence(const Polygons& start, const Polygons& end, std::span<const double> first, int least);

/// Places on a polygon of which some points, ascending, make another one: its places, as parts of its edges, become
/// parts of the length between.
std::vector<IsotopyPlace> places_along(const Points2& polygon, std::span<const Index> corners,
                                       const std::vector<IsotopyPlace>& on_other);

/// All corners of each polygon and points on the longest pieces until there are `count` (one a polygon) of them.
std::vector<std::vector<IsotopyPlace>> even_places(const Polygons& polygons, std::span<const int> count);

}  // namespace unsnarl
