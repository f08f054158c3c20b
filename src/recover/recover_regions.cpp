#include "recover/recover_regions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "mesh/areas.h"
#include "scene/independent_batches.h"
#include "scene/patch.h"
#include "scene/patch_progress.h"

namespace unsnarl {
namespace {

/// Faces this near to a region are obstacles of its recovery (unit: mean edges of the region's faces)
constexpr int obstacle_reach = 2;

}  // namespace

double recover_regions(Scene& scene, SceneIndex& index, const std::vector<std::vector<Index>>& regions,
                       const RecoverRegionsOptions& options, Recorder& recorder) {
  index.update();
  std::vector<double> edge_length(regions.size()), reach(regions.size()), gap(regions.size());
  std::vector<Box> boxes(regions.size());
  for (std::size_t r = 0; r < regions.size(); ++r) {
    std::vector<Triangle> faces;
    for (Index v : regions[r])
      for (Index t : scene.triangles_of_vertex[v]) faces.push_back(scene.triangles[t]);
    edge_length[r] = mean_edge_length(scene.rest, faces);
    reach[r] = std::max(obstacle_reach * edge_length[r], options.least_reach);
    boxes[r] = patch_box(scene, regions[r], reach[r]);
  }
  std::vector<Patch> patches(regions.size());
  std::vector<Trajectory> trajectories(regions.size(), recorder.new_trajectory());
  recorder.begin_stage("recover");
  double smallest = std::numeric_limits<double>::infinity();
  std::vector<PatchProgress> progress(regions.size());
  // Progress assumes that the work on a region is proportional to its vertices.
  const std::function<void()> report = [&] {
    if (!options.on_progress) return;
    double all = 0, done = 0;
    for (std::size_t r = 0; r < regions.size(); ++r) {
      all += static_cast<double>(regions[r].size());
      done += static_cast<double>(regions[r].size()) * progress[r].done;
    }
    options.on_progress(all > 0 ? done / all : 1);
  };
  ProgressReporter reporter(report, options.stop);
  const std::function<bool()> ask = [&] { return reporter.asked(); };
  run_in_batches(
      boxes,
      [&](std::size_t r) {
        if (options.stop()) return;
        patches[r] = cut_patch(scene, index, regions[r], reach[r]);
        patches[r].edge_length = edge_length[r];
        if (recorder.is_on()) patches[r].trajectory = &trajectories[r];
        RecoverOptions recovery = options.recover;
        recovery.min_gap = options.min_gap(regions[r]);
        patches[r].progress = &progress[r];
        gap[r] = recover(patches[r], recovery, ask).min_gap;
      },
      [&](std::size_t r) {
        if (std::isfinite(gap[r]) && gap[r] > 0) smallest = std::min(smallest, gap[r]);
        paste_patch(patches[r], scene, index);
        recorder.add(std::move(trajectories[r]), "", r, regions[r], scene.x);
        patches[r] = {};
        progress[r].done = 1;
        reporter.asked();
      });
  report();
  return smallest;
}

}  // namespace unsnarl
