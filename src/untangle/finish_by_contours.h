#pragma once

#include <functional>
#include <span>
#include <vector>

#include "contact/intersection_finder.h"
#include "scene/patch.h"
#include "untangle/local_solver.h"

namespace unsnarl {

/// Pairs at x that are to be resolved: neither `tolerated` (sorted) nor of faces on the same three vertices.
std::vector<IntersectingPair> pairs_to_resolve(IntersectionFinder& finder, const Positions& x,
                                               std::span<const IntersectingPair> tolerated);

/// How a strategy that comes near is finished.
struct Finish {
  double jitter = 0;      ///< as in LocalOptions
  double area_floor = 0;  ///< of its area at patch.rest: a face thinner than this is no solution
};

/// The local contour method from x on. True: nothing is left to resolve, and x is the result; else x stays. patch.x is
/// used up. Adds to `iterations`.
bool finish_by_contours(Patch& patch, Positions& x, IntersectionFinder& finder, const LocalSettings& settings,
                        std::span<const IntersectingPair> tolerated, const Finish& finish,
                        const std::function<bool()>& stop, int& iterations);

}  // namespace unsnarl
