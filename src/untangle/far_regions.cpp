#include "untangle/far_regions.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

#include "energy/minkowski_penalty.h"
#include "mesh/areas.h"
#include "untangle/tangle_depth.h"

namespace unsnarl {
namespace {

/// Largest motion, in depths of the deepest pair at rest, beyond which a region has gone far. Bodies and animals stay
/// below 15. A spiral with 31 comes 18 times closer by another way, strips of hair with 53 24 times, cushions with 28
/// four times; others beyond do not.
constexpr double far = 20;
/// And in depths of the pocket, where its conflicts cut one off: single faces hide how deep it is, the more so the
/// smaller they are. (A curled body of 107k faces moved 13 of its deepest pair, but 0.13 of its pocket; with 428k
/// beyond 20 of the former. Two sheets of that spiral moved 1.4 and 7 pockets.)
constexpr double far_of_pocket = 1;
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

double largest_motion(const Scene& scene, const std::vector<Index>& vertices) {
  double motion = 0;
  for (Index v : vertices) motion = std::max(motion, (scene.x.col(v) - scene.rest.col(v)).norm());
  return motion;
}

double deepest_overlap(const Scene& scene, std::span<const IntersectingPair> pairs) {
  double deepest = 0;
  for (const IntersectingPair& pair : pairs)
    if (pair.kind == PairClass::disjoint)
      deepest = std::max(deepest, overlap_depth(scene.rest, scene.triangles[pair.a], scene.triangles[pair.b]));
  return deepest;
}

/// As a length.
double depth_of_pocket(const Scene& scene, const ConnectedParts& parts, std::span<const IntersectingPair> pairs) {
  std::vector<Index> core;
  std::vector<Triangle> faces;
  for (const IntersectingPair& pair : pairs)
    for (Index t : {pair.a, pair.b}) {
      const Triangle& face = scene.triangles[t];
      faces.push_back(face);
      core.insert(core.end(), face.begin(), face.end());
    }
  std::sort(core.begin(), core.end());
  core.erase(std::unique(core.begin(), core.end()), core.end());
  return tangle_depth(scene, parts, core) * mean_equilateral_side(scene.rest, faces);
}

}  // namespace

std::vector<std::vector<Index>> far_regions(const Scene& scene, std::span<const std::vector<Index>> regions,
                                            std::span<const IntersectingPair> pairs) {
  std::vector<Index> region_of(scene.vertex_count(), -1);
  for (std::size_t r = 0; r < regions.size(); ++r)
    for (Index v : regions[r]) region_of[v] = static_cast<Index>(r);
  std::vector<std::vector<IntersectingPair>> pairs_of(regions.size());
  for (const IntersectingPair& pair : pairs) {
    Index region = -1;
    for (Index t : {pair.a, pair.b})
      for (Index v : scene.triangles[t]) region = std::max(region, region_of[v]);
    if (region >= 0) pairs_of[region].push_back(pair);
  }
  std::optional<ConnectedParts> parts;
  std::vector<std::vector<Index>> result;
  for (std::size_t r = 0; r < regions.size(); ++r) {
    const double deepest = deepest_overlap(scene, pairs_of[r]);
    const double motion = largest_motion(scene, regions[r]);
    if (!(deepest > 0) || !(motion > far * deepest)) continue;
    if (static_cast<double>(regions[r].size()) < least_share * static_cast<double>(component_size(scene, regions[r])))
      continue;
    if (!parts) parts.emplace(scene);
    if (motion > far_of_pocket * depth_of_pocket(scene, *parts, pairs_of[r])) result.push_back(regions[r]);
  }
  return result;
}

}  // namespace unsnarl
