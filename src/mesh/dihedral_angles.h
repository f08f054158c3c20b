#pragma once

#include <optional>
#include <span>
#include <vector>

#include "geometry/types.h"

namespace unsnarl {

/// Two triangles at an edge: the edge's ends, then the third corner of each.
struct Hinge {
  Index a = 0, b = 0, c = 0, d = 0;
  Index first = 0, second = 0;  ///< the triangles, ascending
};

/// Every two triangles at every edge (at an edge of k faces k (k - 1) / 2), but those on the same three vertices;
/// sorted by edge.
std::vector<Hinge> hinges_of(std::span<const Triangle> triangles);

/// Angle between the two faces in radians, in [0, pi]: 0 where they are folded onto each other, pi where they are flat.
/// Rounded; `error` is an upper bound of what that costs, infinite where a face has no area.
struct HingeAngle {
  double radians = 0, error = 0;
};
HingeAngle hinge_angle(const Positions& x, const Hinge& hinge);

/// The same by exact arithmetic, rounded once at the end; none where a face has no area.
std::optional<double> exact_hinge_angle(const Positions& x, const Hinge& hinge);

/// The smallest angle, certified: no hinge of faces with area has a smaller one. `hinge` -1: there is none.
struct SmallestAngle {
  double radians = 0;
  std::ptrdiff_t hinge = -1;
};
SmallestAngle smallest_angle(const Positions& x, std::span<const Hinge> hinges);

}  // namespace unsnarl
