#pragma once

#include <functional>

#include "optimize/newton.h"
#include "recover/objective.h"
#include "recover/recovery_problem.h"
#include "scene/patch.h"

namespace unsnarl {

/// Constants of recover(). h is the patch's edge length.
struct RecoverOptions {
  /// Wanted distance between primitives that share no vertex, an absolute length; 0: a thousand units in the last
  /// place of the largest coordinate. Callers give a few units in the last place of the format to be written.
  double min_gap = 0;

  ObjectiveOptions objective;
  StepOptions step;

  // Continuation: the barrier's activation distance starts at `activation` and shrinks.
  double activation = 0.1;  ///< in h, at most
  /// And at most this share of the largest displacement at the start, at any time: where little moved, little space is
  /// needed, and a wide barrier would push everything farther away. Fans of needles end 300 times closer.
  double activation_motion = 0.5;
  double activation_factor = 0.2;  ///< from stage to stage
  int stages = 3;                  ///< 0: only the steps at the first activation distance
  double activation_gaps = 3;      ///< the activation distance never falls below this many min_gap

  double open_target = 0.01;  ///< in h: gaps are first opened to this, at most, and never beyond the activation distance
  int open_rounds = 12;       ///< of opening gaps, at most; a start at gaps of 1e-17 took 1 to 6
  double snap_reach = 0.1;    ///< share of the mean edge at a vertex from which it may go straight to its rest position
  int contact_rings = 2;      ///< rings around what is not at rest that stay free after the first snap

  /// What ends farther from rest than this many times where it began (once gaps were open), by root of the sum of
  /// squares, goes back there: around collapsed rings bending leads away. Of 248 regions all others end below 1.35.
  double most_farther = 1.4;

  int first_steps = 12;  ///< Newton steps at the first activation distance, with everything free
  int max_steps = 120;   ///< Newton steps in all
  /// A stage ends when the energy fell by less than the share `decrease` in `window` steps.
  struct Stop {
    double decrease = 0;
    int window = 1;
  };
  Stop coarse = {1e-2, 4};  ///< before the last stage: it only has to come near
  /// In the last. On 61 meshes, windows of 6, 3, 2 steps: with 2 they end 0.9 % closer on average, and sooner: the last
  /// steps push away from contacts more than they bring back.
  Stop fine = {3e-3, 2};
  double stop_motion = 1e-3;      ///< or when the Newton step moves no vertex farther than this, in h ...
  double stop_activation = 0.05;  ///< ... or than this share of the activation distance
  /// Solver of the Newton steps; its tolerance is `limited_tolerance` after a step that was capped.
  PcgOptions solver = {3e-2, 60};
  double limited_tolerance = 0.1;
  bool scalar_jacobi = false;  ///< precondition by the diagonal only

  /// The recovery of Minarčík, Liu, Crane, Li: Untangling Surfaces via Shape and Mesh Repulsion, §3.5.1: up to 500
  /// Newton steps with artificial time steps (the paper names no size; 1 weighs as much as the pull), PCG with a
  /// diagonal Jacobi preconditioner at relative tolerance 1e-6, one activation distance, no active region; ends early
  /// only where no step lowers the energy any more.
  static RecoverOptions paper();
};

struct RecoverResult {
  int iterations = 0;         ///< Newton steps
  int solver_iterations = 0;  ///< PCG iterations in all
  double min_gap = 0;         ///< least distance of a contact stencil of the active faces (infinite: none is near)
  Index closed = 0;           ///< stencils whose gap could not be opened to what was wanted
  Index at_rest = 0;          ///< free vertices that are bit-exactly at rest
  bool moved = false;         ///< any vertex is elsewhere than at the start
  bool stopped = false;       ///< by the caller
};

/// Moves the free vertices of an embedded patch back toward rest, as near as contact allows, without ever leaving the
/// embedded set (paper §3.4, eq. 12; barrier and step filter after Incremental Potential Contact).
/// Measured on one core of a loaded machine: 20 to 60 ms for 100 to 200 free vertices, 0.3 s for 400 with a deep
/// tangle, 2 s for a component of 28k vertices.
///
/// Opens gaps, takes a few steps, snaps to rest what can reach it, steps on with the others, snaps again.
/// \pre patch.x has no intersecting pair with an active triangle, in any class. Pairs that are there are tolerated and
/// never become more.
/// Guarantees: no new pair; no face flips against its rest shape in a step, unless filter_step does not settle (not
/// seen so far), and those that were flipped are pulled back; stencils keep the distance `min_gap` once they have it
/// (neighbours that are closer at rest keep a share of their rest distance); free vertices that can reach their rest
/// positions are bit-exactly there; what is closer than round-off to something stays where it is while others step; the
/// same bytes at any number of threads. `stop` is asked once a step; what was reached by then is kept.
RecoverResult recover(Patch& patch, const RecoverOptions& options = {}, const std::function<bool()>& stop = {});

}  // namespace unsnarl
