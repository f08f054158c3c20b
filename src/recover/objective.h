#pragma once

#include <span>
#include <vector>

#include "energy/arap_triangle.h"
#include "energy/bending.h"
#include "energy/energy_sum.h"
#include "energy/ipc_barrier.h"
#include "energy/orientation_penalty.h"
#include "energy/quadratic_pull.h"
#include "recover/moving_vertices.h"
#include "scene/patch.h"
#include "unsnarl/recording.h"

namespace unsnarl {

/// Weights of Objective. h is the patch's edge length.
struct ObjectiveOptions {
  double arap_length = 2;  ///< in h: deformations shorter than this are resisted by ARAP rather than pulled to rest
  /// In h. Of 0.5, 0.6, 0.7, 1, 2 on four posed bodies: 1 leaves 5 to 45 % more rms displacement, 0.5 as many flipped
  /// faces again in shallow regions, 2 stalls.
  double bending_length = 0.7;
  /// Contact force per mean vertex mass and h at B'(y) = -1: the barrier balances a vertex that is one h from its rest
  /// position against its elastic neighbourhood at about half the activation distance. 2 to 100 end within 1 % of each
  /// other.
  double contact_force = 10;
  // Against flipped faces. Those on twelve bodies and animals, and how far these move on average: 29 as it is; 353
  // without the penalty, and 22 % farther.
  /// Share of a face's area along its rest normal below which it is penalised. 0.4: 51 flipped, 0.2 % farther.
  double flip_activation = 0.2;
  /// Weight of that penalty, in contact forces. 1: two fifths fewer flipped, 0.9 % farther on 59 meshes and no farther
  /// on 14 fine ones; but as many flipped on 36 samples, and 4 % farther.
  double flip_weight = 0.3;
  /// Share of ARAP's Hessian with the rotations held; the rest is Gauss-Newton. Steps on six patches: 1: 27 to 65,
  /// 0.3: 20 to 59, 0.1: 17 to 60, 0: 15 to 61 with more PCG iterations on rough sheets.
  double rotation_damping = 0.1;
  /// Artificial time step of the paper's variant, per mass: each step also pays |x - x_last|^2 / (2 time_step), in the
  /// Hessian alone. Infinite: none.
  double time_step = std::numeric_limits<double>::infinity();
};

/// What the recovery minimises (paper eq. 12): pull to the rest positions + (arap_length h)^2 ARAP
/// + (bending_length h)^4 bending + penalty of flipped faces + barrier of contacts, over the vertices that move.
class Objective {
 public:
  /// h: the patch's edge length. The patch must outlive this.
  Objective(const Patch& patch, const EdgeTable& edges, const ObjectiveOptions& options, double h);

  /// From now on sums run over the elements with a moving vertex.
  void restrict_to(MovingVertices moving);
  const MovingVertices& moving() const { return moving_; }
  /// Triangles with a moving vertex.
  std::span<const Index> triangles() const { return sum_.part<ArapTriangle>().elements; }
  const OrientationPenalty& orientation() const { return sum_.part<OrientationPenalty>().energy; }

  /// The contacts that may be active where the objective is evaluated next.
  std::vector<BarrierStencil>& contacts() { return sum_.part<IpcBarrier>().energy.stencils; }

  double value(const Positions& x);
  /// The value; replaces the gradient (all vertices, of use for those that move) and the Hessian (over the unknowns).
  double linearise(const Positions& x, Positions& gradient, Hessian& hessian);
  /// The value by terms, where it was last linearised.
  IterationRecord terms() const;

 private:
  EnergySum<QuadraticPull, ArapTriangle, Bending, OrientationPenalty, IpcBarrier> sum_;
  MovingVertices moving_;
};

}  // namespace unsnarl
