#pragma once

#include <span>
#include <vector>

#include "geometry/types.h"

namespace unsnarl {

/// A third of the area of the triangles at each vertex: the mass of a vertex in energies over the surface.
/// Vertices whose triangles have no area get `floor_rel` times the mean mass, so that something pulls them too.
std::vector<double> vertex_areas(const Positions& x, std::span<const Triangle> triangles, double floor_rel = 1e-3);

/// E = 1/2 sum_v m_v |x_v - rest_v|^2 over the vertices [0, mass.size()) (the quadratic penalty of paper §3.4).
/// With m an area it scales as length to the fourth power.
struct QuadraticPull {
  std::vector<double> mass;
  Positions rest;

  double value(const Positions& x) const;
  /// Adds `scale` times the gradient to g.
  double value_and_gradient(const Positions& x, double scale, Positions& g) const;
};

}  // namespace unsnarl
