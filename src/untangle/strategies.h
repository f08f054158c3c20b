#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "untangle/strategy.h"

namespace unsnarl {

/// The default: local strategies, placement of small components, coarse to fine for deep tangles, then repulsion in
/// the region, smoothing around the conflict, repulsion of whole components (of large ones on a coarse mesh, then on
/// themselves), smoothing of wide surroundings, recession.
std::span<const Tier> default_tiers();

/// Those that move only what lies close to the conflict.
std::span<const Tier> local_tiers();

/// The default without coarse to fine itself, and without recession: before that, the fine mesh has other strategies.
std::span<const Tier> coarse_mesh_tiers();

/// The tiers without the strategies of these names.
std::vector<Tier> without(std::span<const Tier> tiers, std::span<const std::string> names);

/// Name of the strategy with this number in the order of default_tiers().
std::string_view strategy_name(int number);
/// The number of the one with this name; -1: there is none.
int strategy_number(std::string_view name);
/// The number of the last one.
int last_strategy();

}  // namespace unsnarl
