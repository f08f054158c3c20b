#pragma once

#include <array>
#include <span>
#include <vector>

#include "mesh/components.h"
#include "unsnarl/intersections.h"

namespace unsnarl {

/// Numbers of two components, the smaller first.
using ComponentPair = std::array<Index, 2>;

/// Pairs of components with a pair of triangles in this list, sorted, each once.
std::vector<ComponentPair> meeting_components(const Components& components, std::span<const IntersectingPair> pairs);

}  // namespace unsnarl
