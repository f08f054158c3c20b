#pragma once

#include <functional>

#include "samples/mesh_builder.h"

namespace unsnarl {

using SpaceCurve = std::function<Vec3(double t)>;

/// A tube around a curve over t in [t_min, t_max].
struct Tube {
  SpaceCurve centre;
  double t_min = 0, t_max = 1;
  bool closed = false;                     ///< the curve's ends meet and so do the tube's
  std::function<double(double t)> radius;  ///< > 0
  int steps = 32;                          ///< along
  int sides = 12;                          ///< around
  FaceKind faces = FaceKind::triangles;
  bool capped = false;  ///< the ends of an open tube are closed, each by a fan around one vertex half a radius beyond
};

/// Rings in the planes normal to the curve, carried along it without twist; what a closed curve turns the last ring
/// against the first is spread over all rings. The front is outside. Open tubes end in two boundary rings.
Surface sample_tube(const Tube& tube);

}  // namespace unsnarl
