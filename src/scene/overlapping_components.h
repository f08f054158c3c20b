#pragma once

#include <span>
#include <vector>

#include "scene/meeting_components.h"
#include "scene/prepared_surface.h"
#include "unsnarl/report.h"

namespace unsnarl {

/// The components with a volume of which more than large_overlap_share lies inside others that they meet, in the
/// order of their numbers. A component whose normals point inward bounds a hollow; it is compared with other hollows
/// alone. Shares are estimated: of each component by the same number of lines through it, along which the lengths
/// inside are measured. What lies twice inside a component that intersects itself counts as outside. `meeting`: as of
/// meeting_components(); the cost follows their number and the number of their triangles.
std::vector<OverlappingComponent> overlapping_components(const PreparedSurface& prepared, const Components& components,
                                                         std::span<const ComponentPair> meeting);

}  // namespace unsnarl
