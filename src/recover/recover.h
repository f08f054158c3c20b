#pragma once

#include <functional>

#include "contact/ccd.h"
#include "optimize/block_jacobi_pcg.h"
#include "scene/patch.h"

namespace unsnarl {

/// Constants of recover(). h is the patch's edge length.
struct RecoverOptions {
  /// Wanted distance between primitives that share no vertex, an absolute length; 0: a thousand units in the last
  /// place of the largest coordinate. Callers give a few units in the last place of the format to be written.
  double min_gap = 0;

  // Energy: pull + (arap_length h)^2 ARAP + (bending_length h)^4 bending + barrier + orientation.
  double pull = 1;         ///< weight of the quadratic pull
  double arap_length = 2;  ///< in h: waves shorter than this are kept by ARAP rather than pulled home
  /// In h. Of 0.5, 0.6, 0.7, 1, 2 on four posed bodies: 1 leaves 5 to 45 % more rms displacement, 0.5 as many turned
  /// faces again in shallow regions, 2 stalls.
  double bending_length = 0.7;
  /// Contact force per mean vertex mass and h at B'(y) = -1: the barrier balances a vertex that is one h from home
  /// against its elastic neighbourhood at about half the activation distance. 2 to 100 end within 1 % of each other.
  double contact_force = 10;
  // Against faces that turn over. Those turned by more than 90 degrees on twelve bodies and animals, and how far these
  // move on average: 29 as it is; 353 without the pull, and 22 % farther.
  /// Share of a face's area along its rest normal below which it is pulled back. 0.4: 51 turned, 0.2 % farther.
  double turn_activation = 0.2;
  /// Of that pull, of the contact force. 1: two fifths fewer turned, 0.9 % farther on 59 meshes and no farther on 14
  /// fine ones; but as many turned on 36 samples, and 4 % farther.
  double turn_weight = 0.3;
  double turn_share = 0.2;  ///< of its area along its rest normal, that a face keeps in a step. 0.05: 71; 0.4: 65

  // Continuation: the barrier's activation distance starts at `activation` and shrinks.
  double activation = 0.1;  ///< in h, at most
  /// And at most this share of the largest displacement at the start, at any time: where little moved, little room is
  /// needed, and a wide barrier would push everything farther away. Fans of needles end 300 times closer.
  double activation_motion = 0.5;
  double activation_factor = 0.2;  ///< from stage to stage
  int stages = 3;
  double activation_gaps = 3;  ///< the activation distance never falls below this many min_gap

  // Gaps and home.
  double open_target = 0.01;  ///< in h: gaps are first opened to this, at most
  double open_motion = 0.5;   ///< and at most to this share of the largest displacement at the start
  int open_rounds = 12;
  double snap_reach = 0.1;  ///< share of the mean edge at a vertex from which it may be sent straight home
  int contact_rings = 2;    ///< rings around what is not home or in contact that stay free after the first snap

  /// What ends farther from home than this many times where it began (once gaps were open), by root of the sum of
  /// squares, goes back there: around collapsed rings bending leads away. Of 248 regions all others end below 1.35.
  double most_farther = 1.4;

  // Steps.
  int first_steps = 12;  ///< steps at the first activation distance, with everything free
  int max_steps = 120;   ///< Newton steps in all
  /// A stage ends when the energy fell by less than the share `decrease` in `window` steps ...
  struct Stop {
    double decrease = 0;
    int window = 1;
  };
  Stop coarse = {1e-2, 4};  ///< before the last stage: it only has to come near
  /// In the last. On 61 meshes, windows of 6, 3, 2 steps: with 2 they end 0.9 % closer on average, and sooner: the last
  /// steps push away from contacts more than they bring home.
  Stop fine = {3e-3, 2};
  double stop_motion = 1e-3;      ///< or when the Newton step moves no vertex farther than this, in h ...
  double stop_activation = 0.05;  ///< ... or than this share of the activation distance
  /// Longest motion of a vertex in a step, in h. 1: fine meshes end 5 % closer, others 0.2 % farther with a fifth more
  /// turned faces; 2: fine meshes end 5 % farther. A fifth of what the Newton step wants, where that is more: surfaces
  /// far from home end 16 % farther.
  double step_cap = 0.5;
  bool shorten_all = false;  ///< a collision shortens the step of every vertex, not only of those that collide
  // A list of close stencils holds around each vertex's step, as far as that is long, this at least, in h; where the
  // step exceeds margin_reuse, in h, or does for most, for the step alone: more room took longer to gather than it
  // lasted.
  double margin_min = 0.02;
  double margin_reuse = 0.1;
  double armijo = 1e-4;
  PcgOptions solver = {3e-2, 60};
  double far_tolerance = 0.1;  ///< where the step before was longer than far_caps step caps: little of it is gone
  double far_caps = 2;
  /// Share of ARAP's Hessian with the rotations held; the rest is Gauss-Newton. Steps on six patches: 1: 27 to 65,
  /// 0.3: 20 to 59, 0.1: 17 to 60, 0: 15 to 61 with more PCG iterations on rough sheets.
  double rotation_damping = 0.1;
  bool scalar_jacobi = false;  ///< precondition by the diagonal only
  /// Artificial time step of the paper's variant, per mass: each step also pays |x - x_last|^2 / (2 time_step). 0:
  /// none.
  double time_step = 0;
  CcdOptions ccd;

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
  Index home = 0;             ///< free vertices that are bit-exactly at rest
  bool moved = false;         ///< any vertex is elsewhere than at the start
  bool stopped = false;       ///< by the caller
};

/// Moves the free vertices of an embedded patch back toward rest, as near as contact allows, without ever leaving the
/// embedded set (paper §3.4, eq. 12; barrier and step filter after Incremental Potential Contact).
/// Measured on one core of a loaded machine: 20 to 60 ms for 100 to 200 free vertices, 0.3 s for 400 with a deep
/// tangle, 2 s for a component of 28k vertices.
///
/// Open gaps, a few steps, send home what can go home, steps on what cannot, send home again.
/// \pre patch.x has no intersecting pair with an active triangle, in any class. Pairs that are there are kept out of
/// the way and never become more.
/// Guarantees: no new pair; no face turns over against its rest shape in a step, but where filter_step does not settle
/// (not seen so far), and those that were are pulled back; stencils keep the distance `min_gap` once they have it
/// (neighbours that are closer at rest keep a share of their rest distance); free vertices that can go home are
/// bit-exactly at rest; what is closer than round-off to something stays where it is while others step; the same bytes
/// at any number of threads. `stop` is asked once a step; what was reached by then is kept.
RecoverResult recover(Patch& patch, const RecoverOptions& options = {}, const std::function<bool()>& stop = {});

}  // namespace unsnarl
