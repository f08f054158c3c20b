#include "untangle/strategies.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "untangle/coarse_to_fine.h"
#include "untangle/local_solver.h"
#include "untangle/placement.h"
#include "untangle/shared_constants.h"

namespace unsnarl {
namespace {

/// Valence beyond which the first strategies hold a vertex. The needles of a CAD export met at two of 1900.
constexpr std::size_t most_valence_of_shallow = 100;  // neighbours

/// Edges: tangles at least so deep go from coarse to fine. (27k faces of a warped torus, 4 deep: nearer, in half the
/// time. 6.6k faces, 2 deep: 0.53 % instead of 0.41.)
constexpr int deep = 4;
/// Edges freed around a tangle for each edge of its depth. Of 0.7, 1 and 1.5 the closest on three bodies; with 3
/// seventeen deep meshes end as close in a tenth more time.
constexpr double rings_per_depth = 1.5;
/// The coarse mesh of a deep tangle has edges longer by this factor for each edge of its depth. Without unit. On 58
/// deep, warped and immersed surfaces 0.25, 0.35, 0.5, 1 end 2 to 9 % farther, with up to a quarter more flipped faces;
/// 3 for all, however deep, leaves two tangled (docs/experiments.md).
constexpr double factor_per_depth = 0.7;
/// The same for whole components and what comes close to them. With 3, 42 samples end 3 % farther and twenty punctured
/// surfaces 12 %, but eight random warps 5 % nearer.
constexpr double factor_of_whole = 1.6;

/// Strategy::reach of a deep tangle for each edge of its depth. With 4, ten deep meshes end 2 % farther.
constexpr double deep_reach = 2.5;  // h
/// Strategy::depth_factor of what coarse to fine leaves, at first and before whole components (docs/experiments.md).
constexpr int wide_depths = 2, far_depths = 8;  // times the depth

/// LocalSettings::step of strategies that move faces hardly more than they overlap, and of those that part layers. With
/// 0.15 for the former, thirteen deep and warped meshes end 8 % farther.
constexpr double short_step = 0.1;  // h
/// LocalSettings::max_iterations, and those of shallow-0: with as many, 115 meshes end as near in 1.05 of the time.
constexpr int iterations = 60, shallow_iterations = 20;  // steps

/// Strategy::reach of layers, placement and whole components. With 4 for layers, which sometimes part only far from
/// where they were, a layered cloth of 92,000 faces is not resolved in 139 s of CPU, not 34. Other numbers were not
/// tried.
constexpr double far_reach = 20;  // h

/// Directions are smoothed over as many edges as rings are free, and over one at least. With half as many where four
/// and eight are, 28 warps end 1.03 times as far in 1.1 to 1.2 of the time, with a seventh more flipped faces.
Strategy local(std::string name, int rings, LocalMethod method, SheetMotion motion, double step, int max_iterations,
               std::size_t most_valence = any_valence) {
  const LocalSettings settings = {method, motion, step, std::max(1.0, static_cast<double>(rings)), max_iterations};
  const auto solve = [settings](Patch& patch, const Task& task) {
    LocalOptions options;
    options.few_enough = task.few_enough;
    options.min_gap = task.min_gap;
    // Faces that are inside out have to flip, and their surroundings may have to: wider strategies let them.
    if (settings.method == LocalMethod::shallow) options.orientation = KeepOrientation::yes;
    return solve_locally(patch, settings, task.tolerated, options, task.stop).iterations;
  };
  return {.name = std::move(name), .rings = rings, .most_valence = most_valence, .solve = solve};
}

/// On one coarse mesh: what is not resolved there is connected beyond its surroundings, as a tube does that is inside
/// out between two curves, and coarser meshes of these take long and hardly resolve it (layered cloth: 3 minutes).
Strategy coarse_to_fine() {
  const auto solve = [](Patch& patch, const Task& task) {
    return solve_on_coarser_mesh(patch, task, factor_per_depth * task.depth, CoarseMeshes::one).iterations;
  };
  return {.name = "coarse_to_fine",
          .extent = Extent::depth,
          .rings_per_depth = rings_per_depth,
          .reach = deep_reach,
          .least_depth = deep,
          .area_floor = 0,  // faces that found little space when they came back are recovered
          .solve = solve};
}

/// This strategy takes what the others have left for twice as deep, and so resolves it in wider surroundings on a
/// coarser mesh. It saves time: without it whole components take its place, and samples, posed bodies and the deepest
/// warps end as near in 1.1 of the time, a torus of these in 57 s, not 32 (docs/experiments.md).
Strategy wide_coarse_to_fine() {
  Strategy wide = coarse_to_fine();
  wide.name = "coarse_to_fine_wide";
  wide.is_last_resort = true;
  wide.depth_factor = wide_depths;
  return wide;
}

/// Solves a patch on a mesh of most_faces_of_small at most, or with edges factor_of_whole times as long where that is
/// coarser.
int solve_coarsely(Patch& patch, const Task& task, CoarseMeshes meshes) {
  const double factor =
      std::max(factor_of_whole, std::sqrt(patch.active_count / static_cast<double>(most_faces_of_small)));
  return solve_on_coarser_mesh(patch, task, factor, meshes).iterations;
}

/// This strategy resolves what is stuck in a small part of a large component there, before the whole is solved. A
/// layered cloth of 369,000 faces with 163 pairs left takes 65 s from there; without it the whole goes so far that it
/// stays tangled. With four times the depth it takes 67 s, with sixteen more than 172. The same cloth turned takes
/// longer with it than without: where it fails, the whole is solved after it. Of meshes of up to 27,000 faces hardly
/// one gets here (docs/experiments.md).
Strategy far_coarse_to_fine() {
  Strategy far = wide_coarse_to_fine();
  far.name = "coarse_to_fine_far";
  far.depth_factor = far_depths;
  far.leaves_most = true;
  far.solve = [](Patch& patch, const Task& task) { return solve_coarsely(patch, task, CoarseMeshes::until_solved); };
  return far;
}

Strategy coarse_to_fine_of_whole_components(CoarseMeshes meshes) {
  return {.name = "coarse_to_fine_whole",
          .extent = Extent::whole_components,
          .reach = far_reach,
          .is_last_resort = true,
          .area_floor = 0,
          .solve = [meshes](Patch& patch, const Task& task) { return solve_coarsely(patch, task, meshes); }};
}

Strategy placing() {
  const auto solve = [](Patch& patch, const Task& task) { return place(patch, task.tolerated, task.stop); };
  return {.name = "placement", .extent = Extent::tied_components, .reach = far_reach, .solve = solve};
}

/// Strategies that move faces hardly more than they overlap.
Tier shallow_tier() {
  return {
      local("shallow-0", 0, LocalMethod::shallow, SheetMotion::slide, short_step, shallow_iterations,
            most_valence_of_shallow),
      local("contour-2", 2, LocalMethod::contour, SheetMotion::slide, short_step, iterations, most_valence_of_shallow),
      local("contour-4", 4, LocalMethod::contour, SheetMotion::steeper, short_step, iterations,
            most_valence_of_shallow)};
}

/// Layers that are hemmed in from both sides come apart crossing by crossing: without shorten-4 layered cloth takes
/// twice the time. Two rings tried before four bring nothing nearer (docs/experiments.md).
Tier layers_tier() {
  Tier tier = {local("contour-8", 8, LocalMethod::contour, SheetMotion::offset, longest_step, iterations),
               local("shorten-4", 4, LocalMethod::contour, SheetMotion::free, longest_step, iterations)};
  for (Strategy& strategy : tier) strategy.reach = far_reach;
  return tier;
}

std::vector<Tier> all_tiers(CoarseMeshes meshes) {
  std::vector<Tier> tiers = {shallow_tier(), {placing()}, {coarse_to_fine()}, layers_tier()};
  // On a coarse mesh, wider surroundings are soon the whole.
  if (meshes == CoarseMeshes::until_solved) {
    tiers.push_back({wide_coarse_to_fine()});
    tiers.push_back({far_coarse_to_fine()});
  }
  tiers.push_back({coarse_to_fine_of_whole_components(meshes)});
  return tiers;
}

}  // namespace

std::span<const Tier> default_tiers() {
  static const std::vector<Tier> tiers = all_tiers(CoarseMeshes::until_solved);
  return tiers;
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
