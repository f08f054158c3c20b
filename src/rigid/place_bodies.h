#pragma once

#include <functional>
#include <limits>

#include "rigid/bodies.h"

namespace unsnarl {

struct PlaceBodiesOptions {
  /// How far any vertex may go, a length.
  double most_motion = std::numeric_limits<double>::infinity();
  std::function<bool()> stop = {};
};

/// Puts every body that intersects an obstacle or another body at a place nearby where it intersects none: those that
/// intersect nothing stay, the others follow one by one, the largest first, each among the ones before it. A place is
/// reached by a translation (26 directions and the normals of its contacts) or by a rotation about its centre (three
/// axes, and those that bring a contact along its normal), whichever moves the vertices least by the root mean square
/// of their displacement. One without a free place within its own diagonal goes back to rest, and is_placed says so.
/// Returns whether most_motion kept one from a place.
bool place_bodies(Bodies& bodies, const PlaceBodiesOptions& options);

}  // namespace unsnarl
