#pragma once

#include <functional>
#include <span>

#include "scene/patch.h"
#include "unsnarl/intersections.h"

namespace unsnarl {

/// Components are put at the cheapest free place instead of being repelled. Every component of the patch that is free
/// as a whole goes back to patch.rest, unless it intersects itself there, and from there, the largest first, to the
/// nearest place where it intersects nothing outside itself but those still to be placed: by a translation (26
/// directions and the normals of its contacts) or by shrinking toward its middle or one of its own vertices, cheapest
/// by the root mean square of the displacement. One without a free place within its own diagonal stays where it was,
/// one of more than 4000 faces at rest. Returns the number of components that were placed.
int place(Patch& patch, std::span<const IntersectingPair> tolerated, const std::function<bool()>& stop);

}  // namespace unsnarl
