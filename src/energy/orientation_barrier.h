#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "geometry/types.h"

namespace unsnarl {

/// Keeps triangles from turning over. With c_t = A0_t . A_t / |A0_t|^2 (A: area vectors, A0: at rest, where c = 1)
///
///   E = sum_t w_t B(c_t / activation),   B the barrier of ipc_barrier.h,
///
/// for those with c_t > 0 when this was made; w_t = scale * the smallest altitude at rest. Those that were turned over
/// already are pulled back by w_t / 2 (1 - c_t / activation)^2. Triangles without area at rest have no term.
class OrientationBarrier {
 public:
  struct Options {
    double scale = 1;         ///< energy per length
    double activation = 0.2;  ///< c at which the barrier sets in; without unit, in (0, 1)
  };
  OrientationBarrier() = default;
  OrientationBarrier(const Positions& rest, const Positions& start, std::span<const Triangle> triangles,
                     const Options& options);

  /// Triangles that are no longer turned over at x must not turn again.
  void update(const Positions& x);

  double value(const Positions& x, Index t) const;
  /// The term of triangle t at x. Its Hessian's Gauss-Newton part is stiffness * gradient gradient^T, the gradient
  /// that of c_t.
  struct Term {
    double value = 0;
    double force = 0;      ///< derivative of the energy in c_t
    double stiffness = 0;  ///< its second
    Eigen::Matrix3d gradient;
  };
  /// Returns false, and leaves the term alone, where triangle t has no energy at x.
  bool evaluate(const Positions& x, Index t, Term& term) const;

 private:
  double share(const Positions& x, Index t) const;

  struct Kept {
    Triangle corners;
    Vec3 normal;  // A0 / |A0|^2
    double weight = 0;
    bool turned = false;
  };
  std::vector<Kept> triangles_;
  double activation_ = 1;
};

}  // namespace unsnarl
