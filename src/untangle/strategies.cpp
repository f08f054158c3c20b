#include "untangle/strategies.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "untangle/alone_first.h"
#include "untangle/coarse/coarse_to_fine.h"
#include "untangle/free_search.h"
#include "untangle/local/local_solver.h"
#include "untangle/placement.h"
#include "untangle/squeezed_faces.h"

namespace unsnarl {
namespace {

// Constants of the table. h is the mean edge length of a region's faces. Numbers in brackets: docs/experiments.md.

/// The first strategies hold vertices that have more [E38] (unit: neighbours)
constexpr std::size_t most_valence_of_shallow = 100;
/// Steps of strategies that move faces hardly more than they overlap [E19] (unit: h)
constexpr double short_step = 0.1;
/// Steps of strategies that part layers (unit: h)
constexpr double long_step = 0.3;
/// LocalSettings::max_iterations of `push_apart` [E23] (unit: steps)
constexpr int shallow_iterations = 20;
/// LocalSettings::max_iterations of the other local strategies [E23] (unit: steps)
constexpr int iterations = 60;

/// Bound of the motion of layers [E8] (unit: h)
constexpr double reach_of_layers = 20;
/// Bound of the motion of components that are placed; what went farther waits for nearer candidates [E218] (unit: h)
constexpr double reach_of_placement = 5;
/// Bound of the motion of whole components (unit: h)
constexpr double reach_of_whole = 20;

/// Tangles at least so deep go from coarse to fine [E133, E233] (unit: edges)
constexpr int deep = 4;
/// Edges freed around a tangle for each edge of its depth [E134] (unit: edges / edge)
constexpr double rings_per_depth = 1.5;
/// Bound of the motion for each edge of a tangle's depth [E46] (unit: h)
constexpr double reach_per_depth = 2.5;
/// `coarse_to_fine_wide` takes tangles to be so many times as deep as they are [E44, E69] (no unit)
constexpr int wide_depths = 2;
/// `coarse_to_fine_far` takes tangles to be so many times as deep as they are [E65, E66] (no unit)
constexpr int far_depths = 8;

/// `half_resolution` frees at least so many in one component: on smaller ones local strategies are fast, and end nearer
/// [E234] (unit: vertices)
constexpr std::size_t least_of_half_resolution = 3000;
/// CoarseOptions::factor of `half_resolution` [E229] (no unit)
constexpr double factor_of_half_resolution = 2;
/// CoarseOptions::factor for each edge of a tangle's depth [E40] (no unit)
constexpr double factor_per_depth = 0.7;
/// CoarseOptions::factor of whole components and what comes close to them, at least [E135] (no unit)
constexpr double factor_of_whole = 1.6;
/// The first coarse mesh of these has so many at most [E52] (unit: faces)
constexpr double most_faces_of_first_mesh = 4000;

/// Directions are smoothed over as many edges as rings are free, and over one at least.
Strategy local(std::string name, RingsOptions freed, LocalMethod method, SheetMotion motion, double step,
               int max_iterations) {
  const LocalSettings settings = {method, motion, step, std::max(1.0, static_cast<double>(freed.rings)),
                                  max_iterations};
  const auto solve = [settings](Patch& patch, const Task& task) {
    LocalOptions options;
    options.few_enough = task.few_enough;
    options.min_gap = task.min_gap;
    // Faces that are inside out have to flip, and their surroundings may have to: wider strategies let them.
    if (settings.method == LocalMethod::shallow) options.orientation = KeepOrientation::yes;
    return solve_locally(patch, settings, task.tolerated, options, task.stop).iterations;
  };
  return {.name = std::move(name), .select = select_rings(freed), .solve = solve};
}

constexpr DepthOptions around_deep = {.rings_per_edge = rings_per_depth, .reach = reach_per_depth, .least = deep};

/// One coarse mesh only. A region that it does not resolve is usually tied to something outside it (for instance a tube
/// turned inside out between two curves); coarser meshes rarely help there and are slow. `factor_of`:
/// CoarseOptions::factor for a tangle that is so deep.
Strategy coarse_to_fine(std::string name, const DepthOptions& freed, double (*factor_of)(int depth)) {
  const auto solve = [factor_of](Patch& patch, const Task& task) {
    return solve_on_coarser_mesh(patch, task, coarse_options(factor_of(task.depth), CoarseMeshes::one)).iterations;
  };
  return {.name = std::move(name), .select = select_by_depth(freed), .solve = solve};
}

double by_depth(int depth) {
  return factor_per_depth * depth;
}

/// The cost of local strategies is faces times steps, and a step is a share of an edge. On the coarse mesh a large deep
/// region has a quarter of the faces and takes half of the steps. What is large and deep there too is halved again.
Strategy half_resolution() {
  DepthOptions freed = around_deep;
  freed.least_free = least_of_half_resolution;
  return coarse_to_fine("half_resolution", freed, [](int) { return factor_of_half_resolution; });
}

Strategy deep_coarse_to_fine() {
  return coarse_to_fine("coarse_to_fine", around_deep, by_depth);
}

/// Takes what the others have left to be twice as deep, and so resolves it in wider surroundings on a coarser mesh.
Strategy wide_coarse_to_fine() {
  DepthOptions freed = around_deep;
  freed.factor = wide_depths;
  return coarse_to_fine("coarse_to_fine_wide", freed, by_depth);
}

/// The first coarse mesh has most_faces_of_first_mesh at most, or edges factor_of_whole times as long if that is
/// coarser.
int solve_coarsely(Patch& patch, const Task& task, CoarseMeshes meshes) {
  const double factor = std::max(factor_of_whole, std::sqrt(patch.active_count / most_faces_of_first_mesh));
  return solve_on_coarser_mesh(patch, task, coarse_options(factor, meshes)).iterations;
}

/// Resolves what is stuck in a small part of a large component there, before the whole is solved.
Strategy far_coarse_to_fine() {
  DepthOptions freed = around_deep;
  freed.factor = far_depths;
  freed.leaves_most = true;
  const auto solve = [](Patch& patch, const Task& task) {
    return solve_coarsely(patch, task, CoarseMeshes::until_solved);
  };
  return {.name = "coarse_to_fine_far", .select = select_by_depth(freed), .solve = solve};
}

Strategy alone_first() {
  const auto solve = [](Patch& patch, const Task& task) {
    return untangle_alone_first(patch, task, tiers_before_last_resorts());
  };
  return {.name = "alone_first", .select = select_whole_components(reach_of_whole), .solve = solve};
}

Strategy coarse_to_fine_of_whole_components(CoarseMeshes meshes) {
  return {.name = "coarse_to_fine_whole",
          .select = select_whole_components(reach_of_whole),
          .solve = [meshes](Patch& patch, const Task& task) { return solve_coarsely(patch, task, meshes); }};
}

/// What goes back to rest or shrinks must not lose the area of a face on the way.
Strategy placing() {
  const auto solve = [](Patch& patch, const Task& task) {
    const Positions start = patch.x;
    const int placed = place(patch, task.tolerated, task.stop);
    if (has_squeezed_face(patch, start, patch.x)) patch.x = start;
    return placed;
  };
  return {.name = "placement", .select = select_tied_components(reach_of_placement), .solve = solve};
}

/// Strategies that move faces hardly more than they overlap.
Tier shallow_tier() {
  const auto rings = [](int count) { return RingsOptions{.rings = count, .most_valence = most_valence_of_shallow}; };
  return {{local("push_apart", rings(0), LocalMethod::shallow, SheetMotion::slide, short_step, shallow_iterations),
           local("slide_apart", rings(2), LocalMethod::contour, SheetMotion::slide, short_step, iterations),
           local("slide_apart_wide", rings(4), LocalMethod::contour, SheetMotion::steeper, short_step, iterations)}};
}

/// Layers that are hemmed in from both sides come apart crossing by crossing.
Tier layers_tier() {
  const auto rings = [](int count) { return RingsOptions{.rings = count, .reach = reach_of_layers}; };
  return {{local("part_layers", rings(8), LocalMethod::contour, SheetMotion::offset, long_step, iterations),
           local("shorten_curves", rings(4), LocalMethod::contour, SheetMotion::free, long_step, iterations)}};
}

Tier last_resort(Strategy strategy) {
  return {.strategies = {std::move(strategy)}, .is_last_resort = true};
}

/// The table.
std::vector<Tier> all_tiers(CoarseMeshes meshes) {
  std::vector<Tier> tiers;
  tiers.push_back({{half_resolution()}});
  tiers.push_back(shallow_tier());
  tiers.push_back({{placing()}});
  tiers.push_back({{deep_coarse_to_fine()}});
  tiers.push_back(layers_tier());
  // On a coarse mesh, wider surroundings are soon the whole.
  if (meshes == CoarseMeshes::until_solved) {
    tiers.push_back(last_resort(alone_first()));
    tiers.push_back(last_resort(wide_coarse_to_fine()));
    tiers.push_back(last_resort(far_coarse_to_fine()));
  }
  tiers.push_back(last_resort(coarse_to_fine_of_whole_components(meshes)));
  if (meshes == CoarseMeshes::until_solved) tiers.push_back(last_resort(free_search()));
  return tiers;
}

/// All strategies of the default, in their order.
std::vector<std::string> all_names() {
  std::vector<std::string> names;
  for (const Tier& tier : default_tiers())
    for (const Strategy& strategy : tier.strategies) names.push_back(strategy.name);
  return names;
}

const std::vector<std::string>& names_of_strategies() {
  static const std::vector<std::string> names = all_names();
  return names;
}

}  // namespace

std::span<const Tier> default_tiers() {
  static const std::vector<Tier> tiers = all_tiers(CoarseMeshes::until_solved);
  return tiers;
}

std::span<const Tier> tiers_before_last_resorts() {
  const std::span<const Tier> all = default_tiers();
  const auto last = std::find_if(all.begin(), all.end(), [](const Tier& tier) { return tier.is_last_resort; });
  return all.first(static_cast<std::size_t>(last - all.begin()));
}

std::span<const Tier> coarse_mesh_tiers() {
  static const std::vector<Tier> tiers = all_tiers(CoarseMeshes::one);
  return tiers;
}

std::span<const Tier> local_tiers() {
  static const std::vector<Tier> tiers = {shallow_tier(), layers_tier()};
  return tiers;
}

std::span<const Tier> shallow_tiers() {
  return local_tiers().first(1);
}

CoarseOptions coarse_options(double factor, CoarseMeshes meshes) {
  return {.factor = factor,
          .meshes = meshes,
          .on_coarse_mesh = coarse_mesh_tiers(),
          .on_small_mesh = local_tiers(),
          .on_large_mesh = shallow_tiers()};
}

std::string_view strategy_name(int number) {
  return names_of_strategies()[static_cast<std::size_t>(number)];
}

int strategy_number(std::string_view name) {
  const std::vector<std::string>& names = names_of_strategies();
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? -1 : static_cast<int>(found - names.begin());
}

int last_strategy() {
  return static_cast<int>(names_of_strategies().size()) - 1;
}

}  // namespace unsnarl
