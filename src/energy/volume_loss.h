#pragma once

#include <span>
#include <vector>

#include "energy/hessian.h"
#include "geometry/types.h"

namespace unsnarl {

/// Penalises closed surfaces that lose much of their volume. Of each,
///
///   E = max(0, V_least - V)^2 / (2 A),   V: its volume, V_least: that it is to keep, A: its area at rest,
///
/// which is what a uniform motion along the normals that makes up for the loss would cost in the pull to rest
/// (quadratic_pull.h). Scales as length to the fourth power. An ElementEnergy (energy_sum.h).
class VolumeLoss {
 public:
  /// A closed oriented surface, of which only a piece moves.
  struct Surface {
    std::vector<Triangle> triangles;  ///< of the piece
    double volume = 0;                ///< of the whole while the piece is at rest; negative: normals point inward
    double area = 0;                  ///< of the whole at rest
  };

  VolumeLoss() = default;
  /// least: share of its volume at rest that each is to keep, in [0, 1].
  VolumeLoss(const Positions& rest, std::vector<Surface> surfaces, double least);

  Index size() const { return static_cast<Index>(surfaces_.size()); }
  std::span<const Index> vertices(Index s) const { return surfaces_[s].vertices; }
  double value(const Positions& x, Index s) const;
  /// The Hessian is its Gauss-Newton part, a multiple of the gradient of V squared.
  double linearise(const Positions& x, Index s, double weight, Positions& gradient, HessianTerms& hessian) const;

 private:
  struct Kept {
    std::vector<Triangle> triangles;
    std::vector<Index> vertices;  // of these, ascending
    Vec3 origin;                  // of the products, near the piece
    double elsewhere = 0;         // what the rest of the surface and `least` add to the loss
    double sign = 1;
    double area = 0;
  };
  static double loss_of(const Kept& kept, const Positions& x);

  std::vector<Kept> surfaces_;
};

}  // namespace unsnarl
