#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "contact/distances.h"

namespace unsnarl {

struct CcdOptions {
  /// The time returned keeps this share of the free distance: the step ends no closer than separation + slack *
  /// (distance at the start - separation); 0.1 as in the paper on additive CCD (no unit)
  double slack = 0.1;
  /// Conservative advances after which the time reached so far is returned; it is safe wherever they end (unit:
  /// advances)
  int max_advances = 128;
  /// An advance is followed by another one if it adds at least this share of the time reached [E175] (no unit)
  double least_advance = 1e-2;
  std::function<bool()> stop;  ///< asked by filter_displacements; true: WorkStopped is thrown. May be empty
};

/// Conservative time of impact of two primitives whose vertices move from x to x + p at constant velocity.
///
/// Conservative advancement by the better of two lower bounds of the distance on the way: the distance minus speed
/// times time (additive CCD; Li, Kaufman, Jiang: Codimensional Incremental Potential Contact, §5.2), and the distance
/// along the direction in which they are closest now (Mirtich: Impulse-based Dynamic Simulation of Rigid Body Systems,
/// 1996). The second advances well where primitives slide along each other; the first works at round-off gaps, where
/// that direction is unreliable. Guarantees: the result t is in (0, 1]; for all times in [0, t] the distance stays
/// above `separation`, up to the round-off of a distance (a few units in the last place of the coordinates), so
/// `separation` must be well above it. \pre the distance at x is above separation >= 0.
double time_of_impact(StencilKind kind, const std::array<Vec3, 4>& x, const std::array<Vec3, 4>& p, double separation,
                      const CcdOptions& options = {});

/// A stencil and the distance below which its primitives must never come.
struct SeparatedStencil {
  Stencil stencil;
  double separation = 0;  ///< absolute length, >= 0
};

/// Time of impact of one stencil of the mesh; `p` has a column for every vertex, as x has.
double time_of_impact(const SeparatedStencil& stencil, const Positions& x, const Positions& p,
                      const CcdOptions& options = {});

/// The largest step t in (0, 1] that is safe for all stencils; 1 if there are none.
double largest_step(std::span<const SeparatedStencil> stencils, const Positions& x, const Positions& p,
                    const CcdOptions& options = {});

/// What happens to the vertices of a stencil whose primitives would collide.
enum class OnCollision {
  shorten,  ///< they go as far as the stencil allows
  stay,     ///< they do not move at all; all other vertices arrive exactly
};

/// Vertex-wise filter: every stencil that collides shortens the displacement p of its own vertices only, repeated until
/// none collides. On return x + p is as safe as at the time of impact of every stencil.
/// Returns the number of sweeps over the stencils.
int filter_displacements(std::span<const SeparatedStencil> stencils, const Positions& x, Positions& p,
                         OnCollision on_collision, const CcdOptions& options = {});

}  // namespace unsnarl
