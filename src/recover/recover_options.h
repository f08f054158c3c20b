#pragma once

#include <limits>

#include "optimize/block_jacobi_pcg.h"

// Constants of the recovery. h is the patch's edge length.

namespace unsnarl {

/// Rings around what has moved, or is flipped, that are free in a recovery. Four around regions that strategies moved
/// farther than local ones: nine deep meshes end as close in the same time. Obstacles are taken in as many h around.
constexpr int recovery_rings = 2;
/// Barriers reach this many min_gap at least. Without unit; at 1.5 contacts end between one and two gaps apart.
constexpr double barrier_gaps = 3;

/// Share of a face's area along its rest normal that it should keep. Without unit. Flipped on twelve bodies and
/// animals, of 29: with 0.4 in the penalty 51, 0.2 % farther; with 0.05 and 0.4 in a step 71 and 65.
constexpr double least_area = 0.2;

/// Weights of the objective.
struct ObjectiveOptions {
  /// In h: deformations shorter than this are resisted by ARAP rather than pulled to rest. On thirteen deep meshes 1.4
  /// ends 5 % closer on average and 8 % farther at most, 1 2 % closer and 24 % farther.
  double arap_length = 2;
  /// In h. Of 0.5, 0.6, 0.7, 1, 2 on four posed bodies: 1 leaves 5 to 45 % more rms displacement, 0.5 as many flipped
  /// faces again in shallow regions, 2 stalls.
  double bending_length = 0.7;
  /// Contact force per mean vertex mass and h at B'(y) = -1: the barrier balances a vertex that is one h from its rest
  /// position against its elastic neighbourhood at about half the activation distance. 2 to 100 end within 1 % of each
  /// other.
  double contact_force = 10;
  // Against flipped faces. Those on twelve bodies and animals, and how far these move on average: 29 as it is; 353
  // without the penalty, and 22 % farther.
  double flip_activation = least_area;  ///< share of a face's area along its rest normal below which it is penalised
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

/// How far a step may go.
struct StepOptions {
  /// Longest motion of a vertex in a step, in h, beyond the translation of its part where that is free. 1: fine meshes
  /// end 5 % closer, others 0.2 % farther with a fifth more flipped faces; 2: fine meshes end 5 % farther. A fifth of
  /// what the Newton step wants, where that is more: surfaces far from their rest shape end 16 % farther.
  double cap = 0.5;
  double kept_area = least_area;  ///< share of its area along its rest normal that a face keeps in a step
  /// Share of its distance from an obstacle that a vertex keeps in a step. Eight posed and deep meshes end 3 % farther
  /// with 0.3 and 9 % with 0.7, eighteen 1 % with 0.1: steps that end in the barrier's steep part are halved as a
  /// whole.
  double kept_distance = 0.5;
  bool shorten_all = false;  ///< a collision shortens the step of every vertex, not only of those that collide
};

/// Constants of recover(). h is the patch's edge length.
struct RecoverOptions {
  /// Wanted distance between primitives that share no vertex, an absolute length; 0: a thousand units in the last
  /// place of the largest coordinate. Callers give a few units in the last place of the format to be written.
  double min_gap = 0;

  ObjectiveOptions objective;
  StepOptions step;

  // Continuation: the barrier's activation distance is `activation`, then `last_activation`. A stage between them costs
  // a tenth more steps on eight posed and deep meshes, and brings nothing.
  /// In h, at most. On these meshes 0.2 ends 2 % farther, 0.04 9 %, 0.02 13 %. After its stage, a vertex that is no
  /// farther than this from its rest position may go straight there.
  double activation = 0.1;
  /// In h, at most. Gaps are first opened to this.
  double last_activation = 0.004;
  /// Both are at most this share of the largest displacement at the start: where little moved, little space is needed,
  /// and a wide barrier would push everything farther away. Fans of needles end 300 times closer; with 1 a wig ends
  /// 1.1 to 1.4 times as far.
  double activation_motion = 0.5;
  bool has_last_stage = true;  ///< false: only the steps at the first activation distance
  /// Neither the activation distance nor the distance to which gaps are opened falls below this many min_gap, or
  /// min_gap and what they would be without it, where that is less: with three alone, a gap of 0.3 h took 17 times as
  /// long, and half as much motion again.
  double least_gaps = barrier_gaps;

  int open_rounds = 12;  ///< of opening gaps, at most; a start at gaps of 1e-17 took 1 to 6
  bool snaps = true;     ///< vertices near their rest positions may go straight there
  // Faces that are flipped while the barrier is wide: rounds of steps around them with a heavier penalty; the stages
  // after them turn none over again. Flipped on 41 deep and warped meshes: 1372, as near as with 2222 where the rounds
  // come last and creases are shut. Before the last stage alone: 1330, but edges stay stretched, and on 21 of them 130
  // faces, not 72, keep less than a tenth of their area. There 692 and 503 are flipped, not 541, after two and five.
  int unflip_rounds = 3;     ///< 0: none
  double unflip_factor = 5;  ///< of the penalty, from round to round; their steps end at this part of `stop_decrease`

  /// A patch that ends farther from rest than this many times where it began (once gaps were open), by root of the sum
  /// of squares, goes back there: around collapsed rings bending leads away. Of 248 regions all others end below 1.35.
  double most_farther = 1.4;

  int max_steps = 120;  ///< Newton steps in all, but for those against flipped faces
  // A stage ends when the energy fell by less than the share `stop_decrease` in `stop_window` steps, or when all is
  // stationary: the last steps push away from contacts more than they bring back. Against 3e-3, thirteen deep and
  // warped meshes end as close (0.99) in 0.84 of the time, and 19 posed ones 4 % closer; 4e-2: 4 % farther. On 61
  // meshes, windows of 6, 3, 2 steps: with 2 they end 0.9 % closer on average, and sooner; with 1, at 1e-2, 5 %
  // farther. Without this, until all is stationary, eight meshes end 5 % farther after 2.7 times the steps.
  double stop_decrease = 2e-2;
  int stop_window = 2;
  /// A vertex is stationary, and is held for the rest of the stage, where `stop_window` Newton steps move it no
  /// farther than this share of the activation distance: after one, it may have waited for others. 0.05: as close in a
  /// quarter more steps; without holding, 2 % farther.
  double stop_activation = 0.1;
  /// Solver of the Newton steps. With a tolerance of 3e-2, 31 deep and warped meshes end 5 % closer in a tenth more
  /// time, but a helicoid and a lemniscate 84 and 19 % farther.
  PcgOptions solver = {0.1};
  bool scalar_jacobi = false;  ///< precondition by the diagonal only

  /// The recovery of Minarčík, Liu, Crane, Li: Untangling Surfaces via Shape and Mesh Repulsion, §3.5.1: up to 500
  /// Newton steps with artificial time steps (the paper names no size; 1 weighs as much as the pull), PCG with a
  /// diagonal Jacobi preconditioner at relative tolerance 1e-6, one activation distance, no active region, nothing
  /// against flipped faces, no cap of a step but collisions; ends early only where no step lowers the energy any more.
  static RecoverOptions paper();
};

}  // namespace unsnarl
