#pragma once

#include "applications/curves/curve_net.h"

namespace unsnarl {

/// How far one drawing is from another, all along its segments. Lengths as in the drawing.
struct Closeness {
  double mean = 0, largest = 0;
  double lost = 0;  ///< share of its length that is farther than `tolerance` from the other
};

/// From the drawing of `from` to that of `to`, whose segments may differ in number. The distance to the nearest place
/// of `to` is taken at the ends and in the middle of pieces no longer than a thousandth of from.diagonal, or, of very
/// long curves, in places_of_long_curves pieces.
Closeness closeness_of(const CurveNet& from, const Points2& x, const CurveNet& to, const Points2& y, double tolerance);

}  // namespace unsnarl
