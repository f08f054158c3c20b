#pragma once

#include <span>
#include <string_view>

#include "untangle/strategy.h"

namespace unsnarl {

/// The default: coarse to fine for deep tangles, local strategies, placement of small components, smoothing over wider
/// and wider surroundings, repulsion of whole components.
std::span<const Tier> default_tiers();

/// Those that move only what lies close to the conflict.
std::span<const Tier> local_tiers();

/// All but those that move whole components: what is left on a coarse mesh, the fine one resolves.
std::span<const Tier> coarse_mesh_tiers();

/// Name of the strategy with this number in the order of default_tiers().
std::string_view strategy_name(int number);
/// The number of the last one.
int last_strategy();

}  // namespace unsnarl
