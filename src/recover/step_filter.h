#pragma once

#include <span>

#include "contact/ccd.h"
#include "energy/orientation_penalty.h"

namespace unsnarl {

/// The faces that a step must not flip.
struct OrientedFaces {
  const OrientationPenalty& orientation;
  std::span<const Index> faces;  ///< ids of faces that the penalty was made with
  double share;                  ///< each keeps at least this share of its area along its rest normal

  bool project(const Positions& x, std::span<const std::uint8_t> moves, Positions& p) const {
    return orientation.project(x, faces, share, moves, p);
  }
};

/// Shortens the displacements p, vertex by vertex, until no stencil collides (see filter_displacements) and no face
/// flips. Both are repeated in turn, since shortening for one may cause the other.
void filter_step(std::span<const SeparatedStencil> stencils, const OrientedFaces& oriented, const Positions& x,
                 Positions& p, OnCollision on_collision, const CcdOptions& options = {});

}  // namespace unsnarl
