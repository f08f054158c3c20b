#pragma once

#include "applications/curves/crossings.h"

namespace unsnarl {

/// A curve passes waypoints; each is a vertex or one of its crossings.
struct Waypoint {
  Index vertex = -1;       ///< -1: a crossing
  Index crossing = -1;     ///< its number; a crossing is passed twice, by one curve or by two
  int strand = 0;          ///< of a crossing: 0 for the segment that comes first along the curves, 1 for the other
  bool backwards = false;  ///< is passed against the direction of the input

  bool is_crossing() const { return crossing >= 0; }
};
using Way = std::vector<Waypoint>;

/// A place where two segments cross: unit vectors along both.
struct CrossingPlace {
  Vec2 at = Vec2::Zero();
  std::array<Vec2, 2> along = {Vec2::Zero(), Vec2::Zero()};
};

/// Curves with vertices close beside their crossings.
struct CrossedCurves {
  CurveNet net;                          ///< with the vertices inserted; they come last
  Points2 x;                             ///< where the vertices are
  std::vector<Way> ways;                 ///< one a chain
  std::vector<CrossingPlace> crossings;  ///< those that are passed
};

/// Gives the segments vertices on both sides of each of their proper crossings: at the distance `beside`, or half-way
/// between two crossings, or a crossing and a vertex, that are close to each other. So curves can be joined in another
/// way at a crossing and stay what they are elsewhere. Crossings of segments with two fixed ends get none, and are not
/// passed. The same fractions of the segments at rest are the places of the new vertices at rest.
CrossedCurves with_crossing_points(const CurveNet& net, const Points2& x, const std::vector<SegmentPair>& pairs,
                                   double beside);

}  // namespace unsnarl
