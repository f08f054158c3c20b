#include "untangle/untangle_whole.h"

#include <chrono>
#include <utility>

#include "mesh/areas.h"
#include "scene/trajectory.h"
#include "untangle/local_solver.h"
#include "untangle/paper_untangle.h"

namespace unsnarl {

EscalationResult untangle_whole(Scene& scene, SceneIndex& index, std::size_t pairs,
                                std::span<const IntersectingPair> ignored, const PaperOptions& paper,
                                const EscalationOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  index.update();
  std::vector<Index> free;
  for (Index v = 0; v < scene.vertex_count(); ++v)
    if (!scene.fixed[v] && !scene.triangles_of_vertex[v].empty()) free.push_back(v);
  Patch patch = cut_patch(scene, index, free, 0);
  patch.edge_length = mean_edge_length(scene.rest, scene.triangles);
  Trajectory trajectory;
  if (options.recorder && options.recorder->is_on()) {
    trajectory = options.recorder->new_trajectory();
    patch.trajectory = &trajectory;
  }
  const Positions start = patch.x;
  const PaperResult untangled = paper_untangle(patch, paper, scene.face_of, options.stop);
  const double motion = (patch.x - start).colwise().norm().maxCoeff();
  paste_patch(patch, scene, index);
  EscalationResult result;
  RegionReport report;
  report.strategy = "paper";
  report.faces = static_cast<std::size_t>(patch.active_count);
  report.pairs = pairs;
  report.iterations = untangled.iterations;
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (options.recorder) {
    options.recorder->begin_stage("untangle");
    options.recorder->add(std::move(trajectory), report.strategy, options.first_region, free, scene.x);
  }
  result.regions.push_back(report);
  result.depths.push_back(motion);
  result.moved.push_back(std::move(free));
  result.left = blocking_pairs(index.find_pairs(), ignored);
  return result;
}

}  // namespace unsnarl
