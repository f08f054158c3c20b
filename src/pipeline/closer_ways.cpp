#include "pipeline/closer_ways.h"

#include <algorithm>
#include <limits>

#include "untangle/conflict_regions.h"
#include "untangle/far_regions.h"
#include "untangle/local_solver.h"
#include "untangle/strategies.h"

namespace unsnarl {
namespace {

bool is_part_of(std::span<const Index> region, std::span<const Index> moved) {
  return !moved.empty() && std::binary_search(region.begin(), region.end(), moved.front());
}

bool went_by_whole_components(const LadderResult& climbed, std::span<const Index> region) {
  for (std::size_t k = 0; k < climbed.moved.size(); ++k)
    if (is_part_of(region, climbed.moved[k]) && frees_whole_components(climbed.regions[k].strategy)) return true;
  return false;
}

/// Of the vertices that are elsewhere: are they closer to rest than they were?
bool is_closer(const Scene& scene, const Positions& before) {
  double squares = 0, squares_before = 0;
  for (Index v = 0; v < scene.vertex_count(); ++v)
    if (scene.x.col(v) != before.col(v)) {
      squares += (scene.x.col(v) - scene.rest.col(v)).squaredNorm();
      squares_before += (before.col(v) - scene.rest.col(v)).squaredNorm();
    }
  return squares < squares_before;
}

/// Puts what the other way did to a region in the place of what was done to it before.
void replace(LadderResult& climbed, std::span<const Index> region, const LadderResult& other) {
  const auto at = [](auto& list, std::size_t k) { return list.begin() + static_cast<std::ptrdiff_t>(k); };
  for (std::size_t k = climbed.moved.size(); k-- > 0;)
    if (is_part_of(region, climbed.moved[k])) {
      climbed.moved.erase(at(climbed.moved, k));
      climbed.regions.erase(at(climbed.regions, k));
    }
  climbed.regions.insert(at(climbed.regions, climbed.moved.size()), other.regions.begin(), other.regions.end());
  climbed.moved.insert(climbed.moved.end(), other.moved.begin(), other.moved.end());
}

}  // namespace

double take_closer_ways(Scene& scene, SceneIndex& index, LadderResult& climbed, std::span<const IntersectingPair> pairs,
                        std::span<const IntersectingPair> ignored, const SecondWay& way, Recorder& recorder) {
  double least_gap = std::numeric_limits<double>::infinity();
  const std::vector<std::vector<Index>> moved = merge_overlapping(climbed.moved, scene.vertex_count());
  for (const std::vector<Index>& region : far_regions(scene, moved, pairs)) {
    if (way.stop()) break;
    if (went_by_whole_components(climbed, region)) continue;
    const Positions before = scene.x;
    const Recorder::Stages recorded = recorder.stages();
    std::vector<IntersectingPair> known = blocking_pairs(index.find_pairs(), ignored);
    known.insert(known.end(), ignored.begin(), ignored.end());
    std::sort(known.begin(), known.end());
    for (Index v : region) scene.x.col(v) = scene.rest.col(v);
    const LadderResult other = way.untangle(known);
    double gap = least_gap;
    if (other.left.empty()) gap = std::min(gap, way.recover(merge_overlapping(other.moved, scene.vertex_count())));
    if (other.left.empty() && !way.stop() && is_closer(scene, before)) {
      least_gap = gap;
      replace(climbed, region, other);
    } else {
      scene.x = before;
      recorder.restore(recorded);
      index.update();
    }
  }
  return least_gap;
}

}  // namespace unsnarl
