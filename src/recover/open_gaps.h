#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "recover/contact_rules.h"
#include "recover/embedding_guard.h"
#include "recover/step_filter.h"

namespace unsnarl {

struct OpenGapsOptions {
  /// Distance to which every gap is opened, a length: at most the stencil's reach, and min_gap less for neighbours.
  double target = 0;
  int max_rounds = 0;          ///< rounds, at most
  double step_cap = 0;         ///< length: largest motion of a vertex in one round
  std::function<bool()> stop;  ///< asked before each round; true ends it
};

/// Opens all stencils that are closer than the target, round by round. The first round opens them to two step caps, as
/// far apart as two vertices can go, and each of the next ones to as much more until the target is reached: so each
/// lists only what it can open. Each round:
/// 1. Displacements are projected onto one linearised constraint after the other: each gap reaches its target along the
///    line between its closest points (if round-off hides that line, along the normal, on the side that the exact
///    orientation predicate gives), and each face keeps its share of area. Unlike the mean of all pushes at a vertex,
///    this also opens gaps that are hemmed in from several sides.
/// 2. filter_step shortens the displacements, vertex by vertex.
/// 3. If a gap is of the order of round-off, the exact guard takes back what intersects.
void open_gaps(Positions& x, ContactRules& rules, const OrientedFaces& oriented, EmbeddingGuard& guard,
               std::span<const std::uint8_t> moves, const OpenGapsOptions& options);

}  // namespace unsnarl
