#pragma once

#include <array>
#include <span>

#include "geometry/types.h"

namespace unsnarl {

/// The length of the curves along which triangles cross, an alternative to the penetration depth. It is here to show
/// why it is not used (Minarčík, Liu, Crane, Li: Untangling Surfaces via Shape and Mesh Repulsion, §3.2): it measures
/// the size of a contact, not the distance to a state without it.
///
/// Sums over the pairs that share no vertex and cross along a segment with two ends inside edge and face; returns
/// weight * the sum and adds weight * its gradient. Not continuous: a curve that reaches the end of a sheet vanishes.
double intersection_length(const Positions& x, std::span<const Triangle> triangles,
                           std::span<const std::array<Index, 2>> pairs, Positions& gradient, double weight = 1);

}  // namespace unsnarl
