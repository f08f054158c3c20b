#pragma once

#include "geometry/types.h"
#include "mesh/adjacency.h"

namespace unsnarl {

/// For each vertex the others to which a way along edges leads that is no longer than `length`, ascending.
IndexLists vertices_within(const Positions& x, const EdgeTable& edges, double length);

}  // namespace unsnarl
