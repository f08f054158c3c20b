#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <string_view>

#include "untangle/conflict_regions.h"
#include "untangle/flow.h"
#include "untangle/local_solver.h"

namespace unsnarl {

// Of Strategy::rings.
constexpr int whole_component = std::numeric_limits<int>::max();
constexpr int by_depth = -1;  ///< a share of the region's depth (tangle_depth)

/// One way to resolve a region: a local strategy, which starts from where the surface is now, a flow, from rest, or a
/// coarser mesh, from where the surface is now.
struct Strategy {
  std::string_view name;
  int rings;                   ///< edges from the intersecting faces to the border of the free vertices
  const LocalStrategy* local;  ///< or null
  const FlowRung* flow;        ///< or null
  std::size_t hub_valence = no_hubs;
  int least_depth = 0;                                ///< edges: regions of less (tangle_depth) are let be ...
  int below_depth = std::numeric_limits<int>::max();  ///< ... and of so much or more

  bool is_on_coarser_mesh() const { return !local && !flow; }
};

/// The default configuration, gentle first. These move only what lies close to the conflict.
std::span<const Strategy> gentle_strategies();
/// What moves more around them.
std::span<const Strategy> wild_strategies();
/// Those of them that are climbed on a coarser mesh; they come first. There are coarser ones still for deep conflicts
/// only.
std::span<const Strategy> wild_strategies_of_coarser_mesh();
/// The rest of it, which moves all that hangs together.
std::span<const Strategy> whole_component_strategies();

/// For what is so deep that the coarser mesh goes before gentle strategies ...
std::span<const Strategy> coarser_first();
/// ... and the same on a mesh that is a coarser one itself.
std::span<const Strategy> coarser_first_again();

/// The two that brought regions closer that had gone far: with the deep flows after them, eight times slower, none did.
std::span<const Strategy> second_way_strategies();

/// Of the strategy with this name (RegionReport::strategy).
bool frees_whole_components(std::string_view strategy);

/// Name of a strategy by its number, from gentle to wild.
std::string_view strategy_name(int number);
int last_strategy();

}  // namespace unsnarl
