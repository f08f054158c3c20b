#pragma once

#include "geometry/types.h"

namespace unsnarl {

/// Whether a closed polygon whose points move straight and evenly from one place to another is proven to be simple at
/// every time, both ends included. The points of both polygons, four at least, may be off by `tolerance` (a length)
/// each. For two edges without a common point, a plane is found that keeps them apart for a while, as it does where it
/// does so at the beginning and at the end of the while; otherwise the while is halved. False: it is not proven, as the
/// edges meet, or come as near as rounding can tell.
///
/// Owes nothing to strips and their triangles in R^4: it is another isotopy between the same polygons, and another way
/// to prove it.
bool stays_simple(const Positions& from, const Positions& to, double tolerance = 0);

}  // namespace unsnarl
