#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "recover/contact_rules.h"
#include "recover/embedding_guard.h"
#include "recover/step_filter.h"

namespace unsnarl {

struct OpenGapsOptions {
  double target = 0;           ///< length to which every gap is opened (less where a stencil's reach is less)
  int max_rounds = 12;         ///< a start at 1e-17 took 1 to 6 rounds in the prototypes
  double step_cap = 0;         ///< length: largest motion of a vertex in one round
  std::function<bool()> stop;  ///< asked before each round; true ends it
};

struct OpenGapsResult {
  int rounds = 0;
  Index still_closed = 0;  ///< stencils that remain closer than half their target
};

/// Pushes apart, position by position, all stencils that are closer than the target: along the line between the
/// closest points, or, where round-off hides it, along the normal on the side that the exact orientation predicate
/// says. Every round goes through the vertex-wise filter_step and, where a gap is of the order of round-off, the exact
/// guard.
OpenGapsResult open_gaps(Positions& x, ContactRules& rules, const OrientedFaces& oriented, EmbeddingGuard& guard,
                         std::span<const std::uint8_t> moves, const OpenGapsOptions& options);

}  // namespace unsnarl
