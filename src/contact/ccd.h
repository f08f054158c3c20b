#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "contact/distances.h"

namespace unsnarl {

struct CcdOptions {
  /// Share of the free distance that is kept at the time returned: the step ends no closer than separation + slack *
  /// (distance at the start - separation). Without unit; 0.1 as in additive CCD's paper.
  double slack = 0.1;
  /// Conservative advances before the time reached so far is returned; the answer is safe whenever it stops. Other
  /// values were not tried with both bounds.
  int max_advances = 128;
  /// Share of the time reached that an advance must bring for the next one to be tried. Without unit. On a deep torus
  /// the filter of the steps takes four times as long with 0, and no different with 1e-3 or 5e-2.
  double least_advance = 1e-2;
  std::function<bool()> stop;  ///< asked by filter_displacements, which true ends by WorkStopped; may be empty
};

/// Conservative time of impact of two primitives whose vertices move from x to x + p at constant velocity.
///
/// Conservative advancement by the better of two lower bounds of the distance on the way: what their speed leaves of it
/// (additive CCD; Li, Kaufman, Jiang: Codimensional Incremental Potential Contact, §5.2), and how far apart they stay
/// along the direction in which they are closest now (Mirtich: Impulse-based Dynamic Simulation of Rigid Body Systems,
/// 1996). The second does not hold up what slides along something; the first does not need that direction, which is
/// blurred at round-off gaps. Guarantees: the result t is in (0, 1]; for all times in [0, t] the distance stays above
/// `separation`, up to the round-off of a distance (a few units in the last place of the coordinates), so `separation`
/// must be well above it.
/// \pre the distance at x is above separation >= 0.
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

/// The largest step t in (0, 1] that none of the stencils objects to (1 where there is none).
double largest_step(std::span<const SeparatedStencil> stencils, const Positions& x, const Positions& p,
                    const CcdOptions& options = {});

/// What happens to the vertices of a stencil whose primitives would collide.
enum class OnCollision {
  shorten,  ///< they go as far as the stencil allows
  stay,     ///< they do not move at all: everyone else arrives exactly
};

/// Vertex-wise filter: every stencil that collides shortens the displacement p of its own vertices only, repeated until
/// none collides. On return x + p is as safe as at the time of impact of every stencil.
/// Returns the number of sweeps over the stencils.
int filter_displacements(std::span<const SeparatedStencil> stencils, const Positions& x, Positions& p,
                         OnCollision on_collision, const CcdOptions& options = {});

}  // namespace unsnarl
