#pragma once

#include <span>
#include <vector>

#include "contact/passing.h"
#include "geometry/types.h"
#include "unsnarl/intersections.h"
#include "unsnarl/surface.h"

namespace unsnarl {

/// AllowedPairs as the solvers see them: parts are numbered anew, and every face is of one.
struct AllowedParts {
  std::vector<Index> of_face;  ///< empty: nothing may pass
  PassingParts passing;

  bool any() const { return !of_face.empty(); }
  /// The part of each triangle, given its face; empty: nothing may pass.
  std::vector<Index> of_triangles(std::span<const Index> face_of_triangle) const;
};

/// Throws std::invalid_argument where they make no sense for this surface.
AllowedParts allowed_parts(const SurfaceView& surface, const AllowedPairs& allowed);

}  // namespace unsnarl
