#pragma once

#include <cstdint>
#include <span>

#include "repair/contact_rules.h"
#include "repair/embedding_guard.h"
#include "repair/step_filter.h"

namespace unsnarl {

/// Sends vertices straight to their rest positions where nothing is in the way; those that arrive are bit-exactly
/// there.
///
/// A vertex v tries where moves[v] and 0 < |x - rest| <= reach[v]. One whose stencil would come closer than its
/// separation on the way, or whose face would turn over, stays where it is. Then the exact guard has its say. Returns
/// how many arrived.
Index snap_home(Positions& x, const Positions& rest, std::span<const double> reach, ContactRules& rules,
                const UprightFaces& upright, EmbeddingGuard& guard, std::span<const std::uint8_t> moves,
                int rounds = 3);

}  // namespace unsnarl
