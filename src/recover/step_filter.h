#pragma once

#include <span>

#include "contact/ccd.h"
#include "energy/orientation_penalty.h"

namespace unsnarl {

/// The faces that a step must not flip.
struct OrientedFaces {
  const OrientationPenalty& orientation;
  std::span<const Index> faces;  ///< of those the penalty was made with
  double share;                  ///< of its area along its rest normal, that each keeps at least

  bool project(const Positions& x, std::span<const std::uint8_t> moves, Positions& p) const {
    return orientation.project(x, faces, share, moves, p);
  }
};

/// Sweeps of OrientationPenalty::project over a step, at most. 30 end as 8 (45 deep and posed meshes).
constexpr int projection_sweeps = 8;

/// Shortens the displacements p, vertex by vertex, until no stencil collides (see filter_displacements) and none of the
/// faces flips: either may follow from shortening for the other.
void filter_step(std::span<const SeparatedStencil> stencils, const OrientedFaces& oriented, const Positions& x,
                 Positions& p, OnCollision on_collision, const CcdOptions& options = {});

}  // namespace unsnarl
