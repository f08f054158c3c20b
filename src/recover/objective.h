#pragma once

#include <span>
#include <vector>

#include "energy/arap_triangle.h"
#include "energy/bending.h"
#include "energy/energy_sum.h"
#include "energy/ipc_barrier.h"
#include "energy/orientation_penalty.h"
#include "energy/quadratic_pull.h"
#include "energy/volume_loss.h"
#include "recover/moving_vertices.h"
#include "recover/recover_options.h"
#include "scene/patch.h"
#include "unsnarl/recording.h"

namespace unsnarl {

/// The objective of the recovery (paper eq. 12): pull to the rest positions + (arap_length h)^2 ARAP
/// + (bending_length h)^4 bending + penalty of flipped faces + penalty of lost volume + barrier of contacts, over the
/// vertices that move.
class Objective {
 public:
  /// h: the patch's edge length. The patch must outlive this.
  Objective(const Patch& patch, const EdgeTable& edges, const ObjectiveOptions& options, double h);

  /// Restricts the sums to elements with a moving vertex, until the next call.
  void restrict_to(MovingVertices moving);
  const MovingVertices& moving() const { return moving_; }
  /// Triangles with a moving vertex.
  std::span<const Index> triangles() const { return sum_.part<ArapTriangle>().elements; }
  const OrientationPenalty& orientation() const { return sum_.part<OrientationPenalty>().energy; }

  /// The contacts of the objective; it must hold all that may be active at the positions evaluated next.
  std::vector<BarrierStencil>& contacts() { return sum_.part<IpcBarrier>().energy.stencils; }

  /// Multiplies the weight of the penalty of flipped faces, against that of the options.
  void scale_flip_penalty(double factor) { sum_.part<OrientationPenalty>().weight = factor * flip_weight_; }

  double value(const Positions& x);
  /// The value; replaces the gradient (all vertices, of use for those that move) and the Hessian (over the unknowns).
  double linearise(const Positions& x, Positions& gradient, Hessian& hessian);
  /// The value by terms, where it was last linearised.
  IterationRecord terms() const;

 private:
  EnergySum<QuadraticPull, ArapTriangle, Bending, OrientationPenalty, VolumeLoss, IpcBarrier> sum_;
  MovingVertices moving_;
  double flip_weight_ = 0;  // of the options
};

}  // namespace unsnarl
