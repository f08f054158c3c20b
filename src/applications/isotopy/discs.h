#pragma once

#include <span>
#include <vector>

#include "applications/isotopy/rings.h"

namespace unsnarl {

/// A regular polygon; point k is at the angle phase + k / n turns, to the side of the curve that it stands for.
struct Disc {
  Vec2 middle;
  double radius = 0, phase = 0;

  Points2 polygon(Index n, double side) const;
};

/// Within a convex polygon: as far from its mean point as the nearest of its edges; the points lie ahead as its do.
Disc disc_within(const Points2& p, double side);

/// The states of discs on their way from one place to another; `parent` (one a disc, -1: none) says in which other they
/// lie, on both sides. From one state to the next everything moves straight, and nothing meets: discs that share a
/// parent shrink, pass each other on straight lines or around each other, and grow, with all that is in them; first
/// those that lie in none.
/// Precondition: what lies in a disc is within half its radius. size: scale of the plane, for ways around.
std::vector<std::vector<Disc>> disc_ways(std::vector<Disc> discs, const std::vector<Disc>& to,
                                         std::span<const Index> parent, double size);

}  // namespace unsnarl
