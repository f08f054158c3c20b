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

/// Sweeps of a projection onto constraints, one after the other, at most: of steps and of gaps that are opened, where
/// 30 end as 8 on 45 deep and posed meshes; and of FlipGuard, where with 8 one of 31 meshes ends 1.3 times as far.
constexpr int projection_sweeps = 10;

/// Shortens the displacements p, vertex by vertex, until no stencil collides (see filter_displacements) and none of the
/// faces flips: either may follow from shortening for the other.
void filter_step(std::span<const SeparatedStencil> stencils, const OrientedFaces& oriented, const Positions& x,
                 Positions& p, OnCollision on_collision, const CcdOptions& options = {});

}  // namespace unsnarl
