#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "energy/hessian.h"
#include "geometry/types.h"
#include "mesh/adjacency.h"

namespace unsnarl {

/// Penalises triangles that are flipped against their rest shape or are about to be. With the share
/// c_t = A0_t . A_t / |A0_t|^2 (A: area vectors, A0: at rest, where c = 1)
///
///   E = sum_t w_t / 2 max(0, 1 - c_t / activation)^2,   w_t = the smallest altitude at rest,
///
/// and linear in c_t below c_t = -linear: needles at rest that have become wide would outweigh everything else.
/// Finite, so that flipped triangles can unflip; filter() keeps the others from flipping. (A barrier would let single
/// faces that are nearly flipped shorten the steps of all vertices.) Triangles without area at rest have no term.
/// Scales as length. An ElementEnergy (energy_sum.h).
class OrientationPenalty {
 public:
  struct Options {
    double activation = 0.2;  ///< The penalty sets in where c is below this, in (0, 1) (no unit)
    /// The penalty is linear where c is below minus this, so that needles that became wide do not outweigh everything
    /// else [E178] (no unit)
    double linear = 30;
  };
  OrientationPenalty() = default;
  OrientationPenalty(const Positions& rest, std::span<const Triangle> triangles, const Options& options);

  Index size() const { return static_cast<Index>(triangles_.size()); }
  const Triangle& vertices(Index t) const { return triangles_[t].corners; }
  double value(const Positions& x, Index t) const;
  /// The Hessian is its Gauss-Newton part, a multiple of the gradient of c_t squared. Where the energy is linear, it is
  /// that of the parabola with the same slope and the minimum at `activation`.
  double linearise(const Positions& x, Index t, double weight, Positions& gradient, HessianTerms& hessian) const;

  /// Whether triangle t has area at rest and is flipped at x.
  bool is_flipped(const Positions& x, Index t) const;
  /// One sweep over those triangles of `which` that are not flipped at x and would keep less than `share` of their c:
  /// changes the displacements p of their moving corners as little, to first order, as lets them keep it. Returns
  /// whether there were any.
  bool project(const Positions& x, std::span<const Index> which, double share, std::span<const std::uint8_t> moves,
               Positions& p) const;
  /// Multiplies the displacements p at the corners of those triangles of `which` (ascending) that are not flipped at x
  /// and would keep less than `share` of their c by `factor`, in [0, 1), until there are none. After some rounds the
  /// factor is 0. Returns whether there were any.
  bool filter(const Positions& x, std::span<const Index> which, double share, double factor, Positions& p) const;

 private:
  struct Kept {
    Triangle corners;
    Vec3 normal;  // A0 / |A0|^2
    double weight = 0;
  };
  /// c at x + p, and where the corners are there.
  static double share_of_moved(const Positions& x, const Positions& p, const Kept& kept, std::array<Vec3, 3>& corners);

  std::vector<Kept> triangles_;
  IndexLists triangles_of_vertex_;
  double activation_ = 1;
  double most_ = 1;  // of 1 - c / activation, up to which the energy is quadratic
};

}  // namespace unsnarl
