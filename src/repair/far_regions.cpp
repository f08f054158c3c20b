#include "repair/far_regions.h"

#include <algorithm>
#include <array>

#include "energy/minkowski_penalty.h"

namespace unsnarl {
namespace {

/// Largest motion, in depths of the deepest pair at rest, beyond which a region has gone far. Bodies and animals stay
/// below 15. A spiral with 31 comes 18 times closer by another way, strips of hair with 53 24 times, cushions with 28
/// four times; others beyond do not.
constexpr double far = 20;

}  // namespace

std::vector<std::vector<Index>> far_regions(const Scene& scene, std::span<const std::vector<Index>> regions,
                                            std::span<const IntersectingPair> pairs) {
  std::vector<Index> region_of(scene.vertex_count(), -1);
  for (std::size_t r = 0; r < regions.size(); ++r)
    for (Index v : regions[r]) region_of[v] = static_cast<Index>(r);
  const auto corners = [&](Index t) {
    const Triangle& c = scene.triangles[t];
    return std::array<Vec3, 3>{scene.rest.col(c[0]), scene.rest.col(c[1]), scene.rest.col(c[2])};
  };
  std::vector<double> deepest(regions.size(), 0);
  for (const IntersectingPair& pair : pairs) {
    if (pair.kind != PairClass::disjoint) continue;
    Index region = -1;
    for (Index t : {pair.a, pair.b})
      for (Index v : scene.triangles[t]) region = std::max(region, region_of[v]);
    if (region < 0) continue;
    deepest[region] = std::max(deepest[region], triangle_penetration(corners(pair.a), corners(pair.b), 0).depth);
  }
  std::vector<std::vector<Index>> result;
  for (std::size_t r = 0; r < regions.size(); ++r) {
    const auto has_gone_far = [&](Index v) { return (scene.x.col(v) - scene.rest.col(v)).norm() > far * deepest[r]; };
    if (deepest[r] > 0 && std::any_of(regions[r].begin(), regions[r].end(), has_gone_far)) result.push_back(regions[r]);
  }
  return result;
}

}  // namespace unsnarl
