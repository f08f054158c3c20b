#pragma once

#include <span>

#include "contact/ccd.h"
#include "energy/orientation_penalty.h"

namespace unsnarl {

/// The faces that a step must not turn over.
struct OrientedFaces {
  const OrientationPenalty& orientation;
  std::span<const Index> faces;  ///< of those the penalty was made with
  double share;                  ///< of its area along its rest normal, that each keeps at least
};

/// Shortens the displacements p, vertex by vertex, until no stencil collides (see filter_displacements) and none of the
/// faces turns over: what one of the two shortens may bring about the other. Where that does not settle, faces may
/// turn.
void filter_step(std::span<const SeparatedStencil> stencils, const OrientedFaces& upright, const Positions& x,
                 Positions& p, OnCollision on_collision, const CcdOptions& options = {});

}  // namespace unsnarl
