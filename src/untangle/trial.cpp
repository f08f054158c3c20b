#include "untangle/trial.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <utility>

#include "contact/blocking_pairs.h"
#include "contact/intersection_finder.h"
#include "mesh/areas.h"
#include "recover/recover_options.h"
#include "untangle/conflict_regions.h"

namespace unsnarl {
namespace {

/// Adds the time from its making to its end to `seconds`.
class TrialClock {
 public:
  explicit TrialClock(double& seconds) : seconds_(seconds) {}
  ~TrialClock() { seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count(); }
  TrialClock(const TrialClock&) = delete;
  TrialClock& operator=(const TrialClock&) = delete;

 private:
  double& seconds_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

/// Pairs of active triangles that are not the region's belong to other regions or are tolerated.
bool is_of_region(const Patch& patch, const ConflictRegion& region, const IntersectingPair& pair) {
  const auto [a, b] = std::minmax(patch.faces[pair.a], patch.faces[pair.b]);
  return std::binary_search(region.pairs.begin(), region.pairs.end(), IntersectingPair{a, b, pair.kind});
}

/// The pairs of a patch: the region's, and others.
struct PatchPairs {
  std::vector<IntersectingPair> own, tolerated;
};

PatchPairs find_patch_pairs(const Patch& patch, IntersectionFinder& finder, const ConflictRegion& region) {
  PatchPairs pairs;
  for (const IntersectingPair& pair : finder.find(patch.x))
    (is_of_region(patch, region, pair) ? pairs.own : pairs.tolerated).push_back(pair);
  return pairs;
}

Patch cut_patch_of(const Trial& trial, const Scene& scene, const SceneIndex& index) {
  Patch patch = cut_patch(scene, index, trial.selection.free, trial.reach);
  patch.edge_length = trial.selection.edge_length;
  return patch;
}

/// Column k: of free vertex k.
Eigen::RowVectorXd distances_to_rest(const Patch& patch) {
  return (patch.x - patch.rest).leftCols(patch.free_count).colwise().norm();
}

}  // namespace

TrialPairs::TrialPairs(std::span<const IntersectingPair> pairs)
    : disjoint(static_cast<std::size_t>(std::count_if(
          pairs.begin(), pairs.end(), [](const auto& pair) { return pair.kind == PairClass::disjoint; }))),
      total(pairs.size()) {}

Trial make_trial(const Strategy& strategy, Selection selection) {
  assert(!selection.free.empty() && std::is_sorted(selection.free.begin(), selection.free.end()));
  Trial trial;
  trial.strategy = &strategy;
  trial.reach = selection.bound;
  trial.selection = std::move(selection);
  return trial;
}

void run_trial(Trial& trial, const Scene& scene, const SceneIndex& index, const TrialOptions& options, Task task,
               PatchProgress& progress) {
  if (options.stop && options.stop()) return;
  const TrialClock clock(trial.seconds);
  Patch& patch = trial.patch = cut_patch_of(trial, scene, index);
  trial.start = patch.x;
  if (options.recorder && options.recorder->is_on()) {
    trial.trajectory = options.recorder->new_trajectory();
    patch.trajectory = &trial.trajectory;
  }
  patch.progress = &progress;
  IntersectionFinder finder(patch.triangles, patch.active_count, patch.passing());
  const auto [own, tolerated] = find_patch_pairs(patch, finder, trial.selection.region);
  trial.before = TrialPairs(own);
  task.tolerated = tolerated;
  task.depth = trial.selection.depth;
  if (!options.accept && !own.empty())
    task.few_enough = static_cast<std::size_t>(kept_at_once * static_cast<double>(own.size() - 1));
  if (options.min_gap) task.min_gap = options.min_gap(trial.selection.free);
  trial.iterations += trial.strategy->solve(patch, task);
  const bool is_finite = patch.x.allFinite();
  if (!is_finite) patch.x = trial.start;
  trial.left = TrialPairs(blocking_pairs(finder.find(patch.x), tolerated));
  trial.is_inside_out = turns_a_solid_inside_out(patch);
  const bool is_refused = is_finite && trial.is_clean() && options.accept && !options.accept(patch);
  trial.is_rejected = is_refused && trial.left.fell_from(trial.before);
  patch.trajectory = nullptr;
  patch.progress = nullptr;
}

std::vector<IntersectingPair> put_among_obstacles(Trial& trial, const Scene& scene, const SceneIndex& index) {
  Patch patch = cut_patch_of(trial, scene, index);
  IntersectionFinder finder(patch.triangles, patch.active_count, patch.passing());
  std::vector<IntersectingPair> tolerated = find_patch_pairs(patch, finder, trial.selection.region).tolerated;
  trial.start = patch.x;
  patch.x.leftCols(patch.free_count) = trial.patch.x.leftCols(patch.free_count);
  trial.patch = std::move(patch);
  trial.left = TrialPairs(blocking_pairs(finder.find(trial.patch.x), tolerated));
  return tolerated;
}

void look_farther(Trial& trial, const Scene& scene, const SceneIndex& index,
                  const std::function<void(Patch& patch)>& recover) {
  const TrialClock clock(trial.seconds);
  const std::vector<IntersectingPair> tolerated = put_among_obstacles(trial, scene, index);
  if (trial.is_clean() && recover) {
    recover(trial.patch);
    IntersectionFinder finder(trial.patch.triangles, trial.patch.active_count, trial.patch.passing());
    trial.left = TrialPairs(blocking_pairs(finder.find(trial.patch.x), tolerated));
  }
  trial.is_inside_out = turns_a_solid_inside_out(trial.patch);
  trial.distance = 0;
  for (Index t = 0; t < trial.patch.active_count; ++t)
    trial.distance += squared_motion(trial.patch.rest, trial.patch.x, trial.patch.triangles[t]);
}

bool is_current(const Trial& trial, const Scene& scene) {
  const std::vector<Index>& free = trial.selection.free;
  for (std::size_t k = 0; k < free.size(); ++k)
    if (scene.x.col(free[k]) != trial.start.col(static_cast<Index>(k))) return false;
  return true;
}

double largest_motion(const Trial& trial) {
  const Patch& patch = trial.patch;
  return std::sqrt((patch.x - trial.start).leftCols(patch.free_count).colwise().squaredNorm().maxCoeff());
}

double largest_distance(const Trial& trial) {
  return distances_to_rest(trial.patch).maxCoeff();
}

std::vector<Index> to_be_recovered(const Trial& trial, const Scene& scene) {
  const std::vector<Index>& free = trial.selection.free;
  if (trial.selection.depth == 0) return free;
  std::vector<Index> moved;
  for (std::size_t k = 0; k < free.size(); ++k)
    if (trial.patch.x.col(static_cast<Index>(k)) != trial.start.col(static_cast<Index>(k))) moved.push_back(free[k]);
  return dilate(scene, moved, recovery_rings);
}

}  // namespace unsnarl
