#pragma once

#include <functional>
#include <limits>

#include "rigid/bodies.h"

namespace unsnarl {

struct PlaceBodiesOptions {
  /// Largest displacement that a vertex may have, a length.
  double most_motion = std::numeric_limits<double>::infinity();
  std::function<bool()> stop = {};
};

/// Moves every body that intersects an obstacle or another body to a place nearby where it intersects none. Bodies that
/// intersect nothing stay; the others follow one by one, the largest first, each clear of the ones before it. A place
/// is reached by a translation (26 directions and the normals of the body's contacts) or by a rotation about its centre
/// (three axes, and those that move a contact along its normal), whichever has the least root mean square displacement.
/// A body without a free place within its own diagonal goes back to rest, with is_placed false.
/// Returns whether most_motion kept a body from a place.
bool place_bodies(Bodies& bodies, const PlaceBodiesOptions& options);

}  // namespace unsnarl
