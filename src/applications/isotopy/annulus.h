#pragma once

#include <algorithm>
#include <functional>
#include <vector>

#include "applications/isotopy/rings.h"

namespace unsnarl {

/// Annuli between two sets of polygons, polygon by polygon: rings at heights from 0 to 1, the first and the last as
/// given.
struct Annuli {
  std::vector<Polygons> rings;
  std::vector<double> heights;
  /// Crossings of the rings, or, if there are none, tangled_strips once they are counted.
  std::size_t tangles = 0;
};

/// How points move from one polygon to the other.
enum class Blend {
  straight,  ///< every point on a straight line
  bending,   ///< edges change their directions and lengths evenly, so that what is rolled up unrolls; middles go
             ///< straight
};
/// Crossings of the rings are counted until there are more than `most`.
Annuli naive_annuli(const Polygons& start, const Polygons& end, Blend blend, std::size_t most);

/// The strips from ring to ring that are not embedded, decided exactly, until there are more than `most`; 0: an
/// isotopy.
std::size_t tangled_strips(const Annuli& annuli, std::size_t most);

/// Untangles annuli in space while every ring keeps its height (paper §3.3 and §4.5): rings between the first and the
/// last move in the plane, so that Gaussian self-contact energy + Minkowski penalty of the rings' segments + change of
/// the edges becomes least. Ends when nothing intersects or nothing is gained; the best that was found is returned.
Annuli untangled(const Annuli& annuli, const std::function<bool()>& stop);

/// The length of all polygons together.
double length_of(const Polygons& ring);

/// How far curves in between depart from those at both ends: the least ratio of length, and of area, to what is evenly
/// between those of the first ring and of the last.
struct ShapeKept {
  double length = 1, area = 1;
  double least() const { return std::min(length, area); }
};
ShapeKept shape_kept(const std::vector<Polygons>& rings, const std::vector<double>& heights);

}  // namespace unsnarl
