#pragma once

#include <cstdint>
#include <span>

#include "recover/contact_rules.h"
#include "recover/embedding_guard.h"
#include "recover/step_filter.h"

namespace unsnarl {

/// Moves vertices straight to their rest positions if nothing is in the way; those that arrive are bit-exactly there.
///
/// A vertex v tries if moves[v] and 0 < |x - rest| <= reach. It stays in place if a stencil would come closer than its
/// separation on the way, or if a face would flip. Then the exact guard rolls back new pairs. Returns the number of
/// vertices that arrived.
Index snap_to_rest(Positions& x, const Positions& rest, double reach, ContactRules& rules,
                   const OrientedFaces& oriented, EmbeddingGuard& guard, std::span<const std::uint8_t> moves,
                   int rounds = 3);

}  // namespace unsnarl
