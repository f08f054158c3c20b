#pragma once

#include <functional>
#include <span>
#include <vector>

#include "applications/isotopy/rings.h"

namespace unsnarl {

/// States of closed polygons on their way to be circles (regular polygons with as many points): the first are those
/// given, with points at `places`. From one state to the next every point moves straight, and nothing meets on the way.
///
/// Corners are removed one by one (corner_removal.h) until triangles are left, which become circles. Where polygons
/// that lie in another one are in the way of that, they have become triangles; they shrink and move to where a triangle
/// of a triangulation of the other polygon will be left. This always ends. `parent`: the innermost other polygon in
/// which each lies, or -1; `sides`: 1 for a counter-clockwise polygon, -1. `stop`: true ends it; the result is then
/// empty. Precondition: the polygons are simple and disjoint; all their corners are among the places.
std::vector<Polygons> round_polygons(const Polygons& exact, const std::vector<std::vector<IsotopyPlace>>& places,
                                     std::span<const Index> parent, std::span<const double> sides,
                                     const std::function<bool()>& stop);

}  // namespace unsnarl
