#pragma once

#include <functional>
#include <vector>

#include "geometry/types.h"
#include "unsnarl/knot_isotopy.h"

namespace unsnarl {

/// The double points of a cylinder in R^4 with its rings at equal heights, sorted by strip.
std::vector<KnotDoublePoint> double_points(const std::vector<Positions>& rings);

struct UntangledCylinder {
  std::vector<KnotDoublePoint> left;  ///< the fewest double points that were reached
  std::vector<Positions> rings;       ///< with those, at equal heights; the first and the last as given
};

/// The cylinder in R^4 between two polygons of as many points: straight lines from point to point, untangled by
/// CylinderEnergy. stop(fraction): called with the part that is done, true: give up.
UntangledCylinder untangle_cylinder(const Positions& from, const Positions& to,
                                    const std::function<bool(double fraction)>& stop);

}  // namespace unsnarl
