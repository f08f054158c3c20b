#pragma once

#include "geometry/types.h"

namespace unsnarl {

/// Whether a closed polygon whose points move straight and evenly from one place to another is proven to be simple at
/// every time, both ends included. The points of both polygons, four at least, may be off by `tolerance` (a length)
/// each. For two edges without a common point, a plane is looked for that separates them at the beginning and at the
/// end of an interval of time, and thus throughout; if there is none, the interval is halved. False: not proven, since
/// edges meet or come within rounding of each other.
///
/// Independent of strips and their triangles in R^4: it is another isotopy between the same polygons, and another
/// proof.
bool stays_simple(const Positions& from, const Positions& to, double tolerance = 0);

}  // namespace unsnarl
