#pragma once

#include <functional>
#include <vector>

#include "geometry/types.h"
#include "unsnarl/knot_isotopy.h"

namespace unsnarl {

struct UntangledCylinder {
  std::vector<KnotDoublePoint> straight;  ///< of the cylinder of straight lines between the two polygons
  std::vector<KnotDoublePoint> left;      ///< of the last one
  std::vector<Positions> rings;           ///< of the last one, at equal heights; the first and the last as given
};

/// The cylinder in R^4 between two polygons of as many points: straight lines from point to point, untangled.
/// stop(fraction): called with the part that is done, true: give up.
UntangledCylinder untangle_cylinder(const Positions& from, const Positions& to,
                                    const std::function<bool(double fraction)>& stop);

}  // namespace unsnarl
