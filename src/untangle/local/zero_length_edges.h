#pragma once

#include <span>

#include "mesh/adjacency.h"
#include "scene/patch.h"

namespace unsnarl {

/// Opens edges of length zero of x: free vertices that lie at one position and are joined there by edges move to a
/// small copy of their neighbourhood. Each moves by the mean of its neighbours' displacements, where a neighbour at
/// another position counts with `share` (without unit) of the way to it. This is a harmonic map: a disc between convex
/// neighbours opens without overlap. Nothing else moves. The order of the edges does not matter.
void open_zero_length_edges(const Patch& patch, std::span<const Edge> edges, double share, Positions& x);

}  // namespace unsnarl
