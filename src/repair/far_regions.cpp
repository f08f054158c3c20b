#include "repair/far_regions.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "energy/minkowski_penalty.h"

namespace unsnarl {
namespace {

/// Largest motion, in depths of the deepest pair at rest, beyond which a region has gone far. Bodies and animals stay
/// below 15. A spiral with 31 comes 18 times closer by another way, strips of hair with 53 24 times, cushions with 28
/// four times; others beyond do not.
constexpr double far = 20;
/// Least share of its components that a region has to be. (A flow of a whole character for a dent in its collar takes
/// twenty times as long as all else, and is not closer.)
constexpr double least_share = 0.25;

/// How many vertices hang together with these.
std::size_t component_size(const Scene& scene, const std::vector<Index>& vertices) {
  std::vector<std::uint8_t> seen(scene.vertex_count(), 0);
  std::vector<Index> front = vertices;
  for (Index v : front) seen[v] = 1;
  std::size_t size = 0;
  while (!front.empty()) {
    const Index v = front.back();
    front.pop_back();
    ++size;
    for (Index u : scene.neighbours[v])
      if (!std::exchange(seen[u], 1)) front.push_back(u);
  }
  return size;
}

}  // namespace

std::vector<std::vector<Index>> far_regions(const Scene& scene, std::span<const std::vector<Index>> regions,
                                            std::span<const IntersectingPair> pairs) {
  std::vector<Index> region_of(scene.vertex_count(), -1);
  for (std::size_t r = 0; r < regions.size(); ++r)
    for (Index v : regions[r]) region_of[v] = static_cast<Index>(r);
  std::vector<double> deepest(regions.size(), 0);
  for (const IntersectingPair& pair : pairs) {
    if (pair.kind != PairClass::disjoint) continue;
    Index region = -1;
    for (Index t : {pair.a, pair.b})
      for (Index v : scene.triangles[t]) region = std::max(region, region_of[v]);
    if (region < 0) continue;
    const double depth = overlap_depth(scene.rest, scene.triangles[pair.a], scene.triangles[pair.b]);
    deepest[region] = std::max(deepest[region], depth);
  }
  std::vector<std::vector<Index>> result;
  for (std::size_t r = 0; r < regions.size(); ++r) {
    const auto has_gone_far = [&](Index v) { return (scene.x.col(v) - scene.rest.col(v)).norm() > far * deepest[r]; };
    if (!(deepest[r] > 0) || std::none_of(regions[r].begin(), regions[r].end(), has_gone_far)) continue;
    if (static_cast<double>(regions[r].size()) >= least_share * static_cast<double>(component_size(scene, regions[r])))
      result.push_back(regions[r]);
  }
  return result;
}

}  // namespace unsnarl
