#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "geometry/types.h"

namespace unsnarl {

/// Pulls back triangles that have turned over against their rest shape or are about to. With the share
/// c_t = A0_t . A_t / |A0_t|^2 (A: area vectors, A0: at rest, where c = 1)
///
///   E = sum_t w_t / 2 max(0, 1 - c_t / activation)^2,   w_t = scale * the smallest altitude at rest,
///
/// and linear in c_t below c_t = -linear: needles at rest that have become wide would outweigh everything else.
/// Finite, so that what is turned over already can find its way back; filter() keeps the others from turning. (A
/// barrier in its place let single faces on the brink shorten everyone's steps.) Triangles without area at rest have no
/// term.
class OrientationPenalty {
 public:
  struct Options {
    double scale = 1;         ///< energy per length
    double activation = 0.2;  ///< c at which the penalty sets in; without unit, in (0, 1)
    /// Without unit. 1 leaves 24 % more faces turned on 59 meshes, 30 and 300 the same.
    double linear = 30;
  };
  OrientationPenalty() = default;
  OrientationPenalty(const Positions& rest, std::span<const Triangle> triangles, const Options& options);

  double value(const Positions& x, Index t) const;
  /// The term of triangle t at x. Its Hessian's Gauss-Newton part is stiffness * gradient gradient^T, the gradient
  /// that of c_t. (Where it is linear, that of the parabola that has its slope there and its minimum at `activation`.)
  struct Term {
    double value = 0;
    double force = 0;      ///< derivative of the energy in c_t
    double stiffness = 0;  ///< its second, or the parabola's
    Eigen::Matrix3d gradient;
  };
  /// Returns false, and leaves the term alone, where triangle t has no energy at x.
  bool evaluate(const Positions& x, Index t, Term& term) const;

  /// Scales the displacements p of the corners of those triangles `which` are not turned over at x and would keep less
  /// than `share` of their c by `factor`, in [0, 1), until none does; the last ones stay where they are. Returns
  /// whether there were any.
  bool filter(const Positions& x, std::span<const Index> which, double share, double factor, Positions& p) const;

 private:
  struct Kept {
    Triangle corners;
    Vec3 normal;  // A0 / |A0|^2
    double weight = 0;
  };
  std::vector<Kept> triangles_;
  double activation_ = 1;
  double most_ = 1;  // of 1 - c / activation, up to which the energy is quadratic
};

}  // namespace unsnarl
