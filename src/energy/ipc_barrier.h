#pragma once

#include <limits>
#include <span>
#include <vector>

#include "contact/distances.h"
#include "energy/hessian.h"
#include "geometry/portable_math.h"

namespace unsnarl {

/// The barrier of Incremental Potential Contact (Li et al. 2020, eq. 6) in the ratio y of distance to activation
/// distance: B(y) = -(y - 1)^2 ln y for 0 < y < 1, zero from 1 on, infinite at 0 and below.
inline double barrier(double y) {
  if (y >= 1) return 0;
  if (!(y > 0)) return std::numeric_limits<double>::infinity();
  return -(y - 1) * (y - 1) * portable::log(y);
}
inline double barrier_derivative(double y) {
  return y >= 1 ? 0 : -(y - 1) * (2 * portable::log(y) + (y - 1) / y);
}
inline double barrier_second_derivative(double y) {
  const double q = (y - 1) / y;
  return y >= 1 ? 0 : -2 * portable::log(y) - 4 * q + q * q;
}

/// Factor that switches edge-edge terms off smoothly where the edges become parallel, since their distance is not
/// smooth there (IPC, eq. 24): m(c) = 2 c/eps - (c/eps)^2 for c = |u x v|^2 below eps, else 1.
inline double mollifier(double c, double threshold) {
  if (c >= threshold) return 1;
  const double r = c / threshold;
  return r * (2 - r);
}
inline double mollifier_derivative(double c, double threshold) {
  return c >= threshold ? 0 : 2 * (1 - c / threshold) / threshold;
}

/// Edges whose squared sine is below this count as nearly parallel (IPC) (no unit)
inline constexpr double mollifier_squared_sine = 1e-3;

/// The threshold for two edges that have these squared lengths at rest.
inline double mollifier_threshold(double squared_u, double squared_v) {
  return mollifier_squared_sine * squared_u * squared_v;
}

/// A stencil in the barrier. The ratio is y = (distance - separation) / (activation - separation).
struct BarrierStencil {
  Stencil stencil;
  double separation = 0;  ///< length at which the barrier is infinite, >= 0
  double activation = 0;  ///< length at which it sets in, > separation
  /// Edge-edge: mollifier_threshold() of its edges. 0: no mollifier.
  double mollifier_threshold = 0;
};

/// E = sum_s m_s (activation_s - separation_s) B(y_s) over a list of stencils, m_s the mollifier: with a weight that is
/// a force, the force of a contact depends on y alone, however small the activation distance. An ElementEnergy
/// (energy_sum.h).
struct IpcBarrier {
  std::vector<BarrierStencil> stencils;

  Index size() const { return static_cast<Index>(stencils.size()); }
  const std::array<Index, 4>& vertices(Index s) const { return stencils[s].stencil.v; }
  double value(const Positions& x, Index s) const;
  /// The Hessian is its Gauss-Newton part: the second derivative in the distance times the gradient of that squared.
  double linearise(const Positions& x, Index s, double weight, Positions& gradient, HessianTerms& hessian) const;
};

}  // namespace unsnarl
