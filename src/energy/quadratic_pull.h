#pragma once

#include <array>
#include <span>
#include <vector>

#include "energy/hessian.h"
#include "geometry/types.h"

namespace unsnarl {

/// Mass of vertices whose triangles have no area (unit: mean mass)
inline constexpr double mass_floor_rel = 1e-3;

/// A third of the area of the triangles at each vertex: the mass of a vertex in energies over the surface.
/// Vertices whose triangles have no area get `floor_rel` times the mean mass, so that something pulls them too.
std::vector<double> vertex_areas(const Positions& x, std::span<const Triangle> triangles,
                                 double floor_rel = mass_floor_rel);

/// E = 1/2 sum_v m_v |x_v - rest_v|^2 over the vertices [0, mass.size()) (the quadratic penalty of paper §3.4).
/// With m an area it scales as length to the fourth power. An ElementEnergy (energy_sum.h).
struct QuadraticPull {
  std::vector<double> mass;
  Positions rest;
  /// Added to its Hessian, per mass and weight: the inverse of an artificial time step (paper §3.5.1). 0: none.
  double damping = 0;

  Index size() const { return static_cast<Index>(mass.size()); }
  std::array<Index, 1> vertices(Index v) const { return {v}; }
  double value(const Positions& x, Index v) const { return 0.5 * mass[v] * (x.col(v) - rest.col(v)).squaredNorm(); }
  double linearise(const Positions& x, Index v, double weight, Positions& gradient, HessianTerms& hessian) const {
    gradient.col(v) += weight * mass[v] * (x.col(v) - rest.col(v));
    hessian.diagonals.push_back({v, weight * mass[v] * (1 + damping)});
    return weight * value(x, v);
  }
};

}  // namespace unsnarl
