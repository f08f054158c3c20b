#pragma once

#include <functional>
#include <span>
#include <vector>

#include "applications/knots/strip.h"
#include "unsnarl/link.h"

namespace unsnarl {

/// A knot's points as columns.
Positions points_of(const std::vector<double>& points);

/// Points on the edges of a polygon: edge k begins with its point k and gets pieces[k] of them, evenly.
Positions with_pieces(const Positions& polygon, std::span<const Index> pieces);

/// The power of two that brings the largest coordinate of all into [1/2, 1]: all digits stay. 1 where some coordinate
/// would become too small for that.
double exact_unit(std::span<const Positions> all);

/// A closed polygon with points added on its edges, always on the longest piece, until it has `n`.
struct DensePolygon {
  Positions points;           ///< the polygon's own among them, bit for bit
  std::vector<Index> pieces;  ///< of each edge
};
DensePolygon densified(const Positions& polygon, Index n);

/// Thins out the states of a polygon that moves straight from one to the next: greedy long steps, each of them proven
/// (is_proven_way), from the first state to the last. Where even a step to the next state is not proven, states halfway
/// are inserted. Empty: stopped, or that did not help.
std::vector<Positions> thinned_path(std::vector<Positions> states, const std::function<bool()>& stop);

}  // namespace unsnarl
