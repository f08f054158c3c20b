#include "untangle/strategies.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "untangle/coarse_to_fine.h"
#include "untangle/flow.h"
#include "untangle/local_solver.h"
#include "untangle/placement.h"
#include "untangle/recede.h"

namespace unsnarl {
namespace {

/// Neighbours beyond which the first strategies hold a vertex. The needles of a CAD export met at two of 1900.
constexpr std::size_t hub_valence = 100;

/// Edges: tangles at least so deep go from coarse to fine. (27k faces of a warped torus, 4 deep: nearer, in half the
/// time. 6.6k faces, 2 deep: 0.53 % instead of 0.41.)
constexpr int deep = 4;
/// Edges freed around a tangle for each edge of its depth, at first. Of 0.7, 1 and 1.5 the closest on three bodies;
/// with 3 seventeen deep meshes end as close in a tenth more time. What it leaves is tried with twice as many: 2275
/// pairs of 432,000 faces go by 114,000 of them, not by the flow of all (117 CPU s in all, not 190, and half the
/// memory).
constexpr double rings_per_depth = 1.5;
/// The first coarse mesh of a deep tangle has edges longer by this factor for each edge of its depth: there it is three
/// edges deep. Without unit. 27 meshes: 0.25 to 0.4 end equally close, 0.5 5 % farther.
constexpr double factor_per_depth = 0.35;
constexpr double least_factor = 2;  ///< and by this at least
/// Faces of the coarse mesh on which the parts of a larger patch repel each other. Of 28 hard meshes one fewer is
/// resolved without it, and the 25 that are in both cases end 6 % farther. Other numbers were not tried.
constexpr double faces_that_flow = 3000;
/// Faces of a component that moves as a whole without a coarse mesh, at most: a flow of 432,000 took 500 s, and moved
/// them by 19 % of the diagonal; a recession of 366,000 took 59 s and 3 GB, for nothing.
constexpr Index most_faces_at_once = 30000;

Strategy local(std::string name, int rings, LocalSettings settings, std::size_t hubs = no_hubs) {
  const auto solve = [settings](Patch& patch, const Task& task) {
    LocalOptions options;
    options.few_enough = task.few_enough;
    options.min_gap = task.min_gap;
    // Faces that are inside out have to flip, and their surroundings may have to: then no side is kept.
    switch (settings.method) {
      case LocalMethod::shallow: options.sides = KeepSides::yes; break;  // wider strategies may still keep them
      case LocalMethod::contour:
      case LocalMethod::shorten: options.sides = KeepSides::at_first; break;
      case LocalMethod::smoothing: break;  // it rounds off whatever there is
    }
    return solve_locally(patch, settings, task.tolerated, options, task.stop).iterations;
  };
  return {.name = std::move(name), .rings = rings, .hub_valence = hubs, .solve = solve};
}

/// With the region taken to be at rest where it is now: `solve` starts from there, and is elastic about it.
template <class Solve>
int from_where_it_is(const Solve& solve, Patch& patch, const Task& task) {
  Positions rest = patch.x;
  rest.swap(patch.rest);
  const int iterations = solve(patch, task);
  rest.swap(patch.rest);
  return iterations;
}

int flow_from_where_it_is(Patch& patch, const Task& task) {
  return from_where_it_is([](Patch& p, const Task& t) { return flow(p, t.stop, t.tolerated).iterations; }, patch, task);
}

Strategy repelling(std::string name, Extent extent, int rings = 0) {
  const auto solve = [](Patch& patch, const Task& task) {
    const double coarser = patch.active_count / faces_that_flow;
    return coarser > 1 ? solve_on_coarser_mesh(patch, std::sqrt(coarser), task.tolerated, task.stop).iterations
                       : flow_from_where_it_is(patch, task);
  };
  return {.name = std::move(name),
          .extent = extent,
          .rings = rings,
          .reach = 20,
          .is_last_resort = true,
          .area_floor = 0,  // faces that found little space when they came back are recovered
          .solve = solve};
}

Strategy repelling_at_full_resolution() {
  const auto solve = [](Patch& patch, const Task& task) {
    const bool went_by_a_coarse_mesh = patch.active_count > faces_that_flow;
    return went_by_a_coarse_mesh && patch.active_count <= most_faces_at_once ? flow_from_where_it_is(patch, task) : 0;
  };
  return {.name = "fine_flow", .extent = Extent::whole_components, .reach = 20, .is_last_resort = true, .solve = solve};
}

Strategy receding() {
  const auto solve = [](Patch& patch, const Task& task) {
    if (patch.active_count > most_faces_at_once) return 0;
    return from_where_it_is([](Patch& p, const Task& t) { return recede(p, t.stop, t.tolerated).iterations; }, patch,
                            task);
  };
  return {.name = "recession", .extent = Extent::whole_components, .reach = 20, .is_last_resort = true, .solve = solve};
}

Strategy coarse_to_fine(std::string name, double rings) {
  const auto solve = [](Patch& patch, const Task& task) {
    const double factor = std::max(least_factor, factor_per_depth * task.depth);
    return solve_on_coarser_mesh(patch, factor, task.tolerated, task.stop).iterations;
  };
  return {.name = std::move(name),
          .extent = Extent::depth,
          .rings_per_depth = rings,
          .reach = 2.5,
          .least_depth = deep,
          .area_floor = 0,  // faces that found little space when they came back are recovered
          .solve = solve};
}

Strategy placing() {
  const auto solve = [](Patch& patch, const Task& task) { return place(patch, task.tolerated, {}, task.stop); };
  return {.name = "placement", .extent = Extent::tied_components, .reach = 20, .solve = solve};
}

const LocalSettings contour = {LocalMethod::contour, 0.1, 2, 60};

/// Strategies that move faces hardly more than they overlap.
Tier shallow_tier() {
  return {local("shallow-0", 0, {LocalMethod::shallow, 0.1, 1, 20}, hub_valence),
          local("contour-2", 2, contour, hub_valence), local("contour-4", 4, contour, hub_valence)};
}

/// Layers that are hemmed in from both sides come apart crossing by crossing. Few rings: with 4 and 8, 2 and 6, or 8
/// and 16 what contours leave of twelve meshes moves 13 to 19 % farther.
Tier layers_tier() {
  return {local("contour-8", 8, {LocalMethod::contour, 0.3, 4, 60}),
          local("shorten-2", 2, {LocalMethod::shorten, 0.1, 2, 60}),
          local("shorten-4", 4, {LocalMethod::shorten, 0.3, 4, 60})};
}

/// It rounds off what lies in the conflict and close around it.
Tier smoothing_tier() {
  return {local("smoothing-4", 4, {LocalMethod::smoothing, 0.1, 3, 60})};
}

}  // namespace

std::span<const Tier> default_tiers() {
  // Repelling keeps shapes, smoothing and recession wear them down, the more the wider. With smoothing before the
  // flows, four of six hard meshes end 1.5 to 8 times as far and one 0.8 times; with the recession before smoothing-4,
  // a mannequin ends at 12.6 % instead of 0.015 (docs/performance.md, as what is lost without each of the last ones).
  static const std::vector<Tier> tiers = {shallow_tier(),
                                          {placing()},
                                          {coarse_to_fine("coarse_to_fine", rings_per_depth)},
                                          {coarse_to_fine("coarse_to_fine_wide", 2 * rings_per_depth)},
                                          layers_tier(),
                                          {repelling("flow-8", Extent::rings, 8)},
                                          smoothing_tier(),
                                          {repelling("flow", Extent::whole_components)},
                                          {repelling_at_full_resolution()},
                                          {receding()}};
  return tiers;
}

std::span<const Tier> local_tiers() {
  static const std::vector<Tier> tiers = {shallow_tier(), layers_tier()};
  return tiers;
}

std::span<const Tier> coarse_mesh_tiers() {
  static const std::vector<Tier> tiers =
      without(default_tiers(), std::vector<std::string>{"coarse_to_fine", "coarse_to_fine_wide", "recession"});
  return tiers;
}

std::vector<Tier> without(std::span<const Tier> tiers, std::span<const std::string> names) {
  std::vector<Tier> rest(tiers.begin(), tiers.end());
  for (Tier& tier : rest)
    std::erase_if(tier, [&](const Strategy& strategy) {
      return std::find(names.begin(), names.end(), strategy.name) != names.end();
    });
  std::erase_if(rest, [](const Tier& tier) { return tier.empty(); });
  return rest;
}

std::string_view strategy_name(int number) {
  for (const Tier& tier : default_tiers()) {
    if (number < static_cast<int>(tier.size())) return tier[static_cast<std::size_t>(number)].name;
    number -= static_cast<int>(tier.size());
  }
  return {};
}

int strategy_number(std::string_view name) {
  int number = 0;
  for (const Tier& tier : default_tiers())
    for (const Strategy& strategy : tier) {
      if (strategy.name == name) return number;
      ++number;
    }
  return -1;
}

int last_strategy() {
  int count = 0;
  for (const Tier& tier : default_tiers()) count += static_cast<int>(tier.size());
  return count - 1;
}

}  // namespace unsnarl
