#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "contact/passing.h"
#include "geometry/types.h"

namespace unsnarl {

/// Whether the projections of the triangles onto some line are at least this far apart, so that the triangles are too.
/// The lines tried: through both centres, the normals, and in either plane across each edge. Long needles side by side
/// are separated by one of these although their boxes overlap.
bool are_apart(const Positions& x, const Triangle& s, const Triangle& t, double distance);

/// The two triangles that are nearest to each other among those that share no vertex.
struct SmallestGap {
  double distance = 0;  ///< infinite where all share vertices
  Index first = -1, second = -1;
};

/// group: one entry a triangle; only triangles of different groups count. Empty: all. Those that pass through each
/// other do not count. Precondition: no two of the triangles that count intersect.
SmallestGap smallest_gap(std::span<const Triangle> triangles, const Positions& x, std::span<const Index> group = {},
                         Passing passing = {});

/// The pairs of triangles (the smaller number first, sorted) that share no vertex and are less than `distance` apart.
/// Pairs that intersect may or may not be among them.
std::vector<std::array<Index, 2>> pairs_closer_than(std::span<const Triangle> triangles, const Positions& x,
                                                    double distance);

}  // namespace unsnarl
