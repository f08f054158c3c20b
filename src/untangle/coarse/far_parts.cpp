#include "untangle/coarse/far_parts.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "untangle/conflict_regions.h"

namespace unsnarl {
namespace {

double motion_of(const Scene& scene, Index v) {
  return scene.fixed[v] ? 0 : (scene.x.col(v) - scene.rest.col(v)).norm();
}

}  // namespace

double total_motion(const Scene& scene) {
  double sum = 0;
  for (Index v = 0; v < scene.vertex_count(); ++v) sum += motion_of(scene, v);
  return sum;
}

std::vector<std::vector<Index>> far_parts(const Scene& scene, double distance, double share) {
  std::vector<std::vector<Index>> far_corners;
  for (const Triangle& t : scene.triangles) {
    std::vector<Index> far;
    std::copy_if(t.begin(), t.end(), std::back_inserter(far), [&](Index v) { return motion_of(scene, v) > distance; });
    if (!far.empty()) far_corners.push_back(std::move(far));
  }
  const double least = share * total_motion(scene);
  std::vector<std::pair<double, std::vector<Index>>> parts;
  for (std::vector<Index>& part : merge_overlapping(std::move(far_corners), scene.vertex_count())) {
    double motion = 0;
    for (const Index v : part) motion += motion_of(scene, v);
    if (motion > least) parts.emplace_back(motion, std::move(part));
  }
  std::stable_sort(parts.begin(), parts.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<std::vector<Index>> result;
  for (auto& [motion, part] : parts) result.push_back(std::move(part));
  return result;
}

}  // namespace unsnarl
