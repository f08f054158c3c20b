#include "untangle/untangle_whole.h"

#include <chrono>
#include <map>
#include <utility>

#include "contact/blocking_pairs.h"
#include "mesh/areas.h"
#include "scene/trajectory.h"
#include "untangle/paper_untangle.h"

namespace unsnarl {
namespace {

/// The vertices and triangles that are untangled as one patch: those of one group, or of the whole scene.
struct Whole {
  std::vector<Index> free;  // vertices
  std::vector<Triangle> triangles;
  std::size_t pairs = 0;
};

/// Returns the wholes that contain intersecting pairs, by their groups.
std::vector<Whole> wholes_of(const Scene& scene, std::span<const IntersectingPair> pairs) {
  const auto group_of = [&](Index v) { return scene.group_of.empty() ? 0 : scene.group_of[v]; };
  std::map<Index, Whole> wholes;
  for (const IntersectingPair& pair : pairs) ++wholes[group_of(scene.triangles[pair.a][0])].pairs;
  for (const Triangle& t : scene.triangles)
    if (const auto whole = wholes.find(group_of(t[0])); whole != wholes.end()) whole->second.triangles.push_back(t);
  for (Index v = 0; v < scene.vertex_count(); ++v) {
    if (scene.fixed[v] || scene.triangles_of_vertex[v].empty()) continue;
    if (const auto whole = wholes.find(group_of(v)); whole != wholes.end()) whole->second.free.push_back(v);
  }
  std::vector<Whole> result;
  for (auto& [group, whole] : wholes) result.push_back(std::move(whole));
  return result;
}

void untangle(Whole& whole, Scene& scene, SceneIndex& index, const PaperOptions& paper,
              const EscalationOptions& options, EscalationResult& result) {
  const auto begin = std::chrono::steady_clock::now();
  Patch patch = cut_patch(scene, index, whole.free, 0);
  patch.edge_length = mean_edge_length(scene.rest, whole.triangles);
  Trajectory trajectory;
  if (options.recorder && options.recorder->is_on()) {
    trajectory = options.recorder->new_trajectory();
    patch.trajectory = &trajectory;
  }
  const PaperResult untangled = paper_untangle(patch, paper, scene.face_of, options.stop);
  const double depth = (patch.x - patch.rest).leftCols(patch.free_count).colwise().norm().maxCoeff();
  paste_patch(patch, scene, index);
  RegionReport report;
  report.strategy = "paper";
  report.faces = static_cast<std::size_t>(patch.active_count);
  report.pairs = whole.pairs;
  report.iterations = untangled.iterations;
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (options.recorder)
    options.recorder->add(std::move(trajectory), report.strategy, options.first_region + result.regions.size(),
                          whole.free, scene.x);
  result.regions.push_back(report);
  result.depths.push_back(depth);
  result.moved.push_back(std::move(whole.free));
}

}  // namespace

EscalationResult untangle_whole(Scene& scene, SceneIndex& index, std::span<const IntersectingPair> ignored,
                                const PaperOptions& paper, const EscalationOptions& options) {
  EscalationResult result;
  const std::vector<IntersectingPair> pairs = blocking_pairs(index.find_pairs(), ignored);
  if (options.recorder) options.recorder->begin_stage("untangle");
  for (Whole& whole : wholes_of(scene, pairs)) untangle(whole, scene, index, paper, options, result);
  result.left = blocking_pairs(index.find_pairs(), ignored);
  return result;
}

}  // namespace unsnarl
