#pragma once

#include <vector>

#include "scene/diagnose.h"
#include "scene/prepared_surface.h"
#include "unsnarl/report.h"

namespace unsnarl {

/// The components that are no longer what they were: see ChangedComponent; most changed first. `x`: the result. `gap`:
/// that surfaces were to keep, and `diagonal`, of the input: lengths at the scale of the positions. The cost follows
/// the triangles of those that moved and of what they overlapped.
std::vector<ChangedComponent> changed_components(const PreparedSurface& prepared, const Diagnosis& diagnosis,
                                                 const Positions& x, double gap, double diagonal);

}  // namespace unsnarl
