#include "untangle/coarse/coarse_to_fine.h"

#include <algorithm>
#include <cassert>
#include <optional>
#include <utility>
#include <vector>

#include "contact/blocking_pairs.h"
#include "contact/intersection_finder.h"
#include "geometry/jitter.h"
#include "geometry/sort_unique.h"
#include "mesh/areas.h"
#include "scene/patch_progress.h"
#include "scene/trajectory.h"
#include "untangle/coarse/coarse_level.h"
#include "untangle/coarse/far_parts.h"
#include "untangle/coarse/vertex_insertion.h"

namespace unsnarl {
namespace {

/// What stays as it is on the way from coarse to fine.
struct CoarseProblem {
  const Patch& patch;
  const Task& task;
  const CoarseOptions& options;
  std::size_t pairs_before;  // of the patch
};

bool must_stop(const CoarseProblem& problem) {
  return problem.task.stop && problem.task.stop();
}

/// The coarse mesh is the first half of the progress, the way back the other.
void note_done(const Patch& patch, double share) {
  if (patch.progress) patch.progress->done = std::max(patch.progress->done.load(), share);
}

/// Notes how far a coarse mesh has been untangled of `all` its pairs.
UntanglingProgress progress_of(const Patch& patch, double all) {
  if (!patch.progress || !(all > 0)) return {};
  return [&patch, all](double pairs_now, double work_left) {
    const double before = static_cast<double>(patch.progress->pairs_before);
    patch.progress->pairs = static_cast<std::size_t>(before * std::clamp(pairs_now / all, 0.0, 1.0));
    note_done(patch, 0.5 * (1 - std::min(1.0, work_left / all)));
  };
}

/// Untangles and recovers the mesh as it is now. Returns how far it is from rest then (total_motion); none: too many
/// pairs are left. Adds to `iterations`.
std::optional<double> solve_coarse(const CoarseProblem& problem, CoarseMesh& coarse, int& iterations) {
  CoarseLevel level = make_level(coarse, problem.patch);
  SceneIndex index(level.scene);
  const std::vector<IntersectingPair> pairs = index.find_pairs();
  const std::vector<IntersectingPair> tolerated = tolerated_on(level, pairs, coarse, problem.task.tolerated);
  const double all = static_cast<double>(blocking_pairs(pairs, tolerated).size());
  const Untangled untangled = problem.task.untangle(level.scene, index, tolerated, problem.options.on_coarse_mesh,
                                                    progress_of(problem.patch, all));
  iterations += untangled.iterations;
  if (static_cast<double>(untangled.left.size()) > problem.options.carried_share * all) return std::nullopt;
  recover_level(level, index, {}, problem.task.stop);
  take_over(level, coarse);
  return total_motion(level.scene);
}

/// Puts the vertices to where the patch's are, the free ones at random up to so far from there.
void begin_elsewhere(const Patch& patch, Index start, double distance, CoarseMesh& coarse) {
  coarse.x = patch.x;
  for (Index v = 0; v < patch.free_count; ++v)
    for (int k = 0; k < 3; ++k) coarse.x(k, v) += distance * jitter(start * patch.free_count + v, k);
}

/// The nearest to rest of several solutions. False: there is none.
bool solve_from_several_starts(const CoarseProblem& problem, CoarseMesh& coarse, int& iterations) {
  const double edge = mean_edge_length(problem.patch.rest, coarse.mesh.triangles());
  std::optional<double> least;
  Positions nearest;
  for (int start = 0; start < problem.options.starts && !must_stop(problem); ++start) {
    begin_elsewhere(problem.patch, start, start > 0 ? problem.options.start_distance * edge : 0, coarse);
    const std::optional<double> motion = solve_coarse(problem, coarse, iterations);
    if (!motion || (least && *motion >= *least)) continue;
    least = motion;
    nearest = coarse.x;
  }
  if (least) coarse.x = std::move(nearest);
  return least.has_value();
}

/// The first solution from starts farther and farther from where the mesh is. False: there is none.
bool solve_from_farther_starts(const CoarseProblem& problem, CoarseMesh& coarse, int& iterations) {
  const Positions& rest = problem.patch.rest;
  const double size = (rest.rowwise().maxCoeff() - rest.rowwise().minCoeff()).norm();
  const int count = problem.options.coarsest_starts;
  for (int start = 1; start <= count && !must_stop(problem); ++start) {
    begin_elsewhere(problem.patch, start, size * start / count, coarse);
    if (solve_coarse(problem, coarse, iterations)) return true;
  }
  return false;
}

/// Parts that are farther than an edge from rest are put back there, one after the other, and untangled from there,
/// among what has made way for them since. What ends nearer to rest is kept.
void retry_far_parts(const CoarseProblem& problem, CoarseLevel& level, std::span<const IntersectingPair> tolerated,
                     const RecoverOptions& steps) {
  const double edge = mean_edge_length(level.scene.rest, level.scene.triangles);
  for (const std::vector<Index>& part : far_parts(level.scene, edge, problem.options.least_motion_share)) {
    if (must_stop(problem)) return;
    CoarseLevel retried = level;
    for (const Index v : part) retried.scene.x.col(v) = retried.scene.rest.col(v);
    SceneIndex index(retried.scene);
    const Untangled untangled =
        problem.task.untangle(retried.scene, index, tolerated, problem.options.on_small_mesh, {});
    if (!untangled.left.empty()) continue;
    recover_level(retried, index, steps, problem.task.stop);
    if (total_motion(retried.scene) < total_motion(level.scene)) level = std::move(retried);
  }
}

/// Those of a level's pairs that may stay on the way back, sorted: also those that were not resolved on the coarsest
/// mesh, where nothing has moved.
std::vector<IntersectingPair> tolerated_on_the_way_back(const CoarseProblem& problem, const CoarseMesh& coarse,
                                                        const CoarseLevel& level,
                                                        std::span<const IntersectingPair> pairs) {
  std::vector<IntersectingPair> tolerated = tolerated_on(level, pairs, coarse, problem.task.tolerated);
  const auto is_unmoved = [&](Index t) {
    return is_at(coarse.mesh[coarse.mesh.faces()[t]], coarse.x, problem.patch.x);
  };
  for (const IntersectingPair& pair : pairs)
    if (is_unmoved(pair.a) && is_unmoved(pair.b)) tolerated.push_back(pair);
  sort_unique(tolerated);
  return tolerated;
}

/// Resolves what the vertices that came back have brought, and recovers by a few steps, so that the next have room.
/// Returns false where too many pairs are left. `retried_at`: faces of the mesh on which far parts were last tried
/// again.
bool make_room(const CoarseProblem& problem, CoarseMesh& coarse, std::size_t& retried_at) {
  const CoarseOptions& options = problem.options;
  CoarseLevel level = make_level(coarse, problem.patch);
  SceneIndex index(level.scene);
  const std::vector<IntersectingPair> pairs = index.find_pairs();
  const std::vector<IntersectingPair> tolerated = tolerated_on_the_way_back(problem, coarse, level, pairs);
  const std::size_t faces = level.scene.triangles.size();
  bool is_clean = true;
  if (!blocking_pairs(pairs, tolerated).empty()) {
    const std::span<const Tier> tiers =
        faces <= options.most_faces_for_all ? options.on_small_mesh : options.on_large_mesh;
    const std::size_t left = problem.task.untangle(level.scene, index, tolerated, tiers, {}).left.size();
    if (static_cast<double>(left) > options.way_back_share * static_cast<double>(problem.pairs_before)) return false;
    is_clean = left == 0;
  }
  RecoverOptions steps;
  steps.has_last_stage = false;
  recover_level(level, index, steps, problem.task.stop);
  if (is_clean && faces <= options.most_faces_to_retry && faces / 2 >= retried_at) {
    retried_at = faces;
    retry_far_parts(problem, level, tolerated, steps);
  }
  take_over(level, coarse);
  return true;
}

/// Puts all vertices back. False: what they bring cannot be resolved, or not in time.
bool refine(const CoarseProblem& problem, CoarseMesh& coarse) {
  const Patch& patch = problem.patch;
  const double rounds = static_cast<double>(coarse.mesh.round_count());
  std::size_t retried_at = 0;
  while (coarse.mesh.round_count() > 0) {
    if (must_stop(problem)) return false;
    const std::vector<ProgressiveMesh::Removal> displaced =
        insert_vertices(patch, coarse.mesh, coarse.mesh.refine(), coarse.x);
    note_done(patch, 1 - 0.5 * static_cast<double>(coarse.mesh.round_count()) / rounds);
    if (coarse.mesh.round_count() == 0) break;
    if (!make_room(problem, coarse, retried_at)) return false;
    offer_better_places(patch, coarse.mesh, displaced, coarse.x);
  }
  return true;
}

}  // namespace

CoarseResult solve_on_coarser_mesh(Patch& patch, const Task& task, const CoarseOptions& options) {
  assert(std::is_sorted(task.tolerated.begin(), task.tolerated.end()));
  assert(task.untangle);
  CoarseResult result;
  IntersectionFinder finder(patch.triangles, patch.active_count, patch.passing());
  const auto count_pairs = [&](const Positions& x) {
    const std::size_t count = blocking_pairs(finder.find(x), task.tolerated).size();
    record(patch, x, {.pairs = count});
    return count;
  };
  const std::size_t before = result.pairs_left = count_pairs(patch.x);
  if (before == 0 || !(patch.edge_length > 0)) return result;
  const CoarseProblem problem{patch, task, options, before};
  const bool is_only_one = options.meshes == CoarseMeshes::one;
  const double most_left = options.solved_share * static_cast<double>(before);
  const auto all_faces = static_cast<std::size_t>(patch.active_count);
  Positions best;
  std::size_t faces = all_faces;
  for (double wanted = static_cast<double>(faces); !must_stop(problem);) {
    wanted /= options.factor * options.factor;
    CoarseMesh coarse(patch, task.tolerated);
    const std::size_t finer = std::exchange(faces, coarsen(coarse, patch, wanted, task.stop));
    const bool is_coarsest = faces == finer;
    if (is_coarsest && (is_only_one || faces == all_faces)) break;
    bool is_solved = false;
    if (is_only_one)
      is_solved = solve_coarse(problem, coarse, result.iterations).has_value();
    else if (is_coarsest)
      is_solved = solve_from_farther_starts(problem, coarse, result.iterations);
    else
      is_solved = solve_from_several_starts(problem, coarse, result.iterations);
    if (is_solved && refine(problem, coarse)) {
      const std::size_t left = count_pairs(coarse.x);
      if (left < result.pairs_left) {
        result.pairs_left = left;
        best = std::move(coarse.x);
      }
    }
    if (static_cast<double>(result.pairs_left) <= most_left || is_coarsest || is_only_one) break;
  }
  if (result.pairs_left < before) patch.x = std::move(best);
  return result;
}

}  // namespace unsnarl
