#pragma once

#include <span>

#include "untangle/strategy.h"

namespace unsnarl {

/// Untangles each component of a patch that intersects itself by these tiers as if it were alone, then what the
/// components meet of each other: one that is hemmed in by another may so cross it on the way. Takes where the vertices
/// are for the input. Changes patch.x only where no pair is left; leaves a patch alone that is one component, or of
/// which none intersects itself. Returns the number of iterations.
int untangle_alone_first(Patch& patch, const Task& task, std::span<const Tier> tiers);

}  // namespace unsnarl
