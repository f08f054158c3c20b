#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "untangle/coarse/coarse_to_fine.h"
#include "untangle/strategy.h"

namespace unsnarl {

/// The default, in order: half the resolution for large deep tangles; strategies that move faces hardly more than they
/// overlap; placement of small components; coarse to fine for deep tangles; layers crossing by crossing; coarse to fine
/// in wider and wider surroundings, and last for whole components.
std::span<const Tier> default_tiers();

/// The default without the last resorts.
std::span<const Tier> tiers_before_last_resorts();

/// The default of coarse meshes: without the wider surroundings, and with one mesh that is coarser still, not several.
std::span<const Tier> coarse_mesh_tiers();

/// Strategies that move only what lies close to a conflict.
std::span<const Tier> local_tiers();

/// The first tier of local_tiers(): strategies that move faces hardly more than they overlap.
std::span<const Tier> shallow_tiers();

/// How coarse to fine goes by meshes whose edges are `factor` times as long at first, with the strategies above:
/// coarse_mesh_tiers() on a coarse mesh, local_tiers() and on large meshes shallow_tiers() on the way back.
CoarseOptions coarse_options(double factor, CoarseMeshes meshes);

/// Name of the strategy with this number in the order of default_tiers().
std::string_view strategy_name(int number);
/// The number of the one with this name; -1: there is none.
int strategy_number(std::string_view name);
/// The number of the last one.
int last_strategy();

}  // namespace unsnarl
