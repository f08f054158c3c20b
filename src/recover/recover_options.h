#pragma once

#include <limits>

#include "optimize/block_jacobi_pcg.h"

// Constants of the recovery. h is the patch's edge length.

namespace unsnarl {

/// Rings of vertices around those that moved, which are free in a recovery [E169] (unit: rings)
constexpr int recovery_rings = 2;
/// A barrier reaches at least this far [E161] (unit: min_gap)
constexpr double barrier_gaps = 3;

/// Weights of the objective.
struct ObjectiveOptions {
  /// ARAP resists deformations that are shorter than this; the pull to rest corrects longer ones [E149] (unit: h)
  double arap_length = 2;
  /// The bending energy resists bends that are shorter than this [E150] (unit: h)
  double bending_length = 0.7;
  /// Contact force at B'(y) = -1. The barrier then balances a vertex that is one h from rest against its elastic
  /// neighbourhood at about half the activation distance [E151] (unit: mean vertex mass times h)
  double contact_force = 10;
  /// A face is penalised where its area along its rest normal is below this [E152] (unit: share of its rest area)
  double flip_activation = 0.2;
  double flip_weight = 0.3;  ///< Weight of the penalty of flipped faces [E153] (unit: contact forces)
  /// The volume of a closed component is penalised below this [E219] (unit: share of its volume at rest)
  double kept_volume = 0.85;
  double volume_weight = 100;  ///< Weight of the penalty of lost volume [E220] (no unit)
  /// Share of ARAP's Hessian with the rotations held; the rest is Gauss-Newton, in [0, 1] [E154] (no unit)
  double rotation_damping = 0.1;
  /// Artificial time step of the paper's variant: each step also pays |x - x_last|^2 / (2 time_step) per mass, in the
  /// Hessian alone; infinite: none (no unit)
  double time_step = std::numeric_limits<double>::infinity();
};

/// How far a step may go.
struct StepOptions {
  /// Longest motion of a vertex in a step, beyond the translation of its connected part where that is free [E155]
  /// (unit: h)
  double cap = 0.5;
  /// A step leaves a face at least this area along its rest normal [E156] (unit: share of its rest area)
  double kept_area = 0.2;
  /// A step leaves a vertex at least this share of its distance from an obstacle, so that it does not end in the steep
  /// part of the barrier [E157] (no unit)
  double kept_distance = 0.5;
  bool shorten_all = false;  ///< a collision shortens the step of every vertex, not only of those that collide
};

/// Constants of recover(). h is the patch's edge length.
struct RecoverOptions {
  /// Wanted distance between primitives that share no vertex, an absolute length; 0: a thousand units in the last
  /// place of the largest coordinate. Callers give a few units in the last place of the format to be written.
  double min_gap = 0;

  bool knows_sheets = false;  ///< what is of one sheet (see OneSheet) need not keep min_gap

  ObjectiveOptions objective;
  StepOptions step;

  // The barrier's activation distance is `activation` in the first stage and `last_activation` in the last one.
  double activation = 0.1;  ///< Activation distance of the first stage, at most [E158] (unit: h)
  /// Activation distance of the last stage, at most, and the distance to which gaps are first opened (unit: h)
  double last_activation = 0.004;
  /// Activation distances are at most this share of the largest displacement at the start: where little moved, a wide
  /// barrier would push everything farther away [E159] (no unit)
  double activation_motion = 0.5;
  bool has_last_stage = true;  ///< false: only the steps at the first activation distance
  /// Neither the activation distance nor the distance to which gaps are opened falls below this, or below min_gap plus
  /// what they would be without it, where that is less [E160] (unit: min_gap)
  double least_gaps = barrier_gaps;

  /// Rounds of opening gaps, at most, not counting those before the target is reached [E162] (unit: rounds)
  int open_rounds = 12;
  /// Longest motion of a vertex in one of these rounds: what is near it is listed, and with a longer one that is much
  /// where the gap is wide [E224] (unit: h)
  double open_cap = 0.05;
  bool snaps = true;           ///< vertices near their rest positions may go straight there
  double snap_distance = 0.1;  ///< A vertex this near to its rest position may go straight there (unit: h)

  // After the first stage, while the barrier is wide, rounds of steps around flipped faces turn these over by a heavier
  // penalty. The stages after the rounds do not flip them again.
  int unflip_rounds = 3;     ///< Rounds of turning flipped faces over, at most; 0: none [E164] (unit: rounds)
  double unflip_factor = 5;  ///< The penalty of flipped faces grows by this from round to round (no unit)
  /// `stop_decrease` is divided by this in these rounds: a few faces are a small part of the energy (no unit)
  double unflip_persistence = 5;

  /// A patch that ends farther from rest than this many times where it was once gaps were open goes back there; root of
  /// the sum of squared displacements [E165] (no unit)
  double most_farther = 1.4;

  /// Newton steps of all stages together, at most; steps against flipped faces are not counted (unit: steps)
  int max_steps = 120;
  // A stage ends where the energy hardly falls, or where all vertices are stationary: the last steps of a stage push
  // away from contacts more than they bring back.
  /// A stage ends when the energy fell in `stop_window` steps by less than this share of what it was at the stage's
  /// start, that of vertices which have become stationary left out [E246] (no unit)
  double stop_decrease = 1e-2;
  int stop_window = 2;  ///< Newton steps over which the decrease of the energy is measured [E167] (unit: steps)
  /// A vertex is stationary, and held for the rest of the stage, where `stationary_steps` Newton steps move it no
  /// farther than this [E168] (unit: activation distances)
  double stop_activation = 0.1;
  /// Short Newton steps in a row after which a vertex is stationary: in a single one it may have waited for others
  /// (unit: steps)
  int stationary_steps = 2;
  /// Solver of the Newton steps: relative tolerance of the preconditioned residual (no unit)
  PcgOptions solver = {0.1};
  bool direct_solver = false;  ///< Newton steps are solved as NewtonOptions::direct_solver says

  /// The recovery of Minarčík, Liu, Crane, Li: Untangling Surfaces via Shape and Mesh Repulsion, §3.5.1: up to 500
  /// Newton steps with artificial time steps (the paper names no size; 1 weighs as much as the pull), each solved
  /// directly in place of the paper's conjugate gradients to 1e-6 [E272], one activation distance, no active region,
  /// nothing against flipped faces or for volumes, no cap of a step but collisions; ends early only where no step
  /// lowers the energy any more or a Newton step moves no vertex by a hundredth of the activation distance [E271].
  static RecoverOptions paper();
};

}  // namespace unsnarl
