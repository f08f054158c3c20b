#pragma once

#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "contact/distances.h"

namespace unsnarl {

/// The barrier of Incremental Potential Contact (Li et al. 2020, eq. 6) in the ratio y of distance to activation
/// distance: B(y) = -(y - 1)^2 ln y for 0 < y < 1, zero from 1 on, infinite at 0 and below.
inline double barrier(double y) {
  if (y >= 1) return 0;
  if (!(y > 0)) return std::numeric_limits<double>::infinity();
  return -(y - 1) * (y - 1) * std::log(y);
}
inline double barrier_derivative(double y) {
  return y >= 1 ? 0 : -(y - 1) * (2 * std::log(y) + (y - 1) / y);
}
inline double barrier_second_derivative(double y) {
  const double q = (y - 1) / y;
  return y >= 1 ? 0 : -2 * std::log(y) - 4 * q + q * q;
}

/// Factor that switches edge-edge terms off smoothly where the edges become parallel and their distance has a kink
/// (IPC, eq. 24): m(c) = 2 c/eps - (c/eps)^2 for c = |u x v|^2 below eps, else 1.
inline double mollifier(double c, double threshold) {
  if (c >= threshold) return 1;
  const double r = c / threshold;
  return r * (2 - r);
}
inline double mollifier_derivative(double c, double threshold) {
  return c >= threshold ? 0 : 2 * (1 - c / threshold) / threshold;
}

/// A stencil in the barrier. The ratio is y = (distance - separation) / (activation - separation).
struct BarrierStencil {
  Stencil stencil;
  double separation = 0;  ///< length at which the barrier is infinite, >= 0
  double activation = 0;  ///< length at which it sets in, > separation
  /// Edge-edge: squared sine at which the mollifier sets in, times both squared edge lengths at rest. 0: no mollifier.
  double mollifier_threshold = 0;
};

/// What one active stencil contributes to the derivatives.
struct BarrierContact {
  Index stencil = 0;  ///< position in the list
  Closest closest;
  double energy = 0;     ///< force_scale left out
  double force = 0;      ///< derivative of the energy in the distance, <= 0
  double stiffness = 0;  ///< its second: the Hessian's Gauss-Newton part is stiffness (w n)(w n)^T
  bool mollified = false;
  Eigen::Matrix<double, 3, 2> twist;  ///< mollified: derivative through |u x v|^2 in the edge vectors u and v
};

/// E = force_scale * sum_s m_s (activation_s - separation_s) B(y_s): the force of a contact depends on y alone, however
/// small the activation distance.
class IpcBarrier {
 public:
  explicit IpcBarrier(double force_scale = 1) : force_scale_(force_scale) {}

  double value(const Positions& x, std::span<const BarrierStencil> stencils) const;
  /// The same; replaces `contacts` by the active stencils.
  double evaluate(const Positions& x, std::span<const BarrierStencil> stencils,
                  std::vector<BarrierContact>& contacts) const;
  /// Adds `scale` times the gradient to g.
  static void add_gradient(std::span<const BarrierStencil> stencils, std::span<const BarrierContact> contacts,
                           double scale, Positions& g);

 private:
  /// False: not active.
  bool evaluate(const Positions& x, const BarrierStencil& stencil, BarrierContact& contact) const;

  double force_scale_;
};

}  // namespace unsnarl
