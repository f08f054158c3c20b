#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "unsnarl/intersections.h"

/// A second opinion on self-intersections, for tests. It takes the definition literally and shares no code with the
/// product: two faces intersect where a corner of the convex set in which they meet lies outside the hull of the
/// vertices they share. Every pair is looked at; a zero-area face is the segment or point that it is.
namespace unsnarl::oracle {

using OracleTriangle = std::array<std::int32_t, 3>;

/// By integer arithmetic. `coordinates`: 3 n integers of magnitude <= 4096, so that nothing overflows 128 bits.
std::vector<IntersectingPair> intersections_by_brute_force(std::span<const std::int64_t> coordinates,
                                                           std::span<const OracleTriangle> triangles);

/// By CGAL's exact constructions. `positions`: 3 n finite doubles. Some ten thousand pairs with overlapping boxes a
/// second.
std::vector<IntersectingPair> intersections_by_cgal(std::span<const double> positions,
                                                    std::span<const OracleTriangle> triangles);

}  // namespace unsnarl::oracle
