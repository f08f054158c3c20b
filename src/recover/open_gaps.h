#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "recover/contact_rules.h"
#include "recover/embedding_guard.h"
#include "recover/step_filter.h"

namespace unsnarl {

struct OpenGapsOptions {
  /// Length to which every gap is opened, less where a stencil's reach is less, and min_gap less between neighbours.
  double target = 0;
  int max_rounds = 0;          ///< at most
  double step_cap = 0;         ///< length: largest motion of a vertex in one round
  std::function<bool()> stop;  ///< asked before each round; true ends it
};

/// Opens all stencils that are closer than the target, round by round. A round's displacements are projected onto what
/// is asked for, to first order and one after the other: each gap is as wide as its target, along the line between the
/// closest points (where round-off hides it, along the normal on the side that the exact orientation predicate says),
/// and each face keeps its share of area. Then they go through the vertex-wise filter_step and, where a gap is of the
/// order of round-off, the exact guard. (With the mean of the pushes of all stencils at a vertex instead, what is
/// hemmed in from several sides stayed closed at 1e-9 or 1e-14 of the diagonal.)
void open_gaps(Positions& x, ContactRules& rules, const OrientedFaces& oriented, EmbeddingGuard& guard,
               std::span<const std::uint8_t> moves, const OpenGapsOptions& options);

}  // namespace unsnarl
