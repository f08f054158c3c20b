#include "repair/conflict_regions.h"

#include <algorithm>
#include <map>

#include "mesh/union_find.h"

namespace unsnarl {

std::vector<ConflictRegion> conflict_regions(const Scene& scene, std::span<const IntersectingPair> pairs) {
  // Only the vertices at and around the pairs are numbered, so that the cost follows the conflicts, not the surface.
  std::vector<Index> core;
  for (const IntersectingPair& pair : pairs)
    for (Index t : {pair.a, pair.b}) core.insert(core.end(), scene.triangles[t].begin(), scene.triangles[t].end());
  std::sort(core.begin(), core.end());
  core.erase(std::unique(core.begin(), core.end()), core.end());
  std::vector<Index> around = core;
  for (Index v : core) around.insert(around.end(), scene.neighbours[v].begin(), scene.neighbours[v].end());
  std::sort(around.begin(), around.end());
  around.erase(std::unique(around.begin(), around.end()), around.end());
  auto local = [&](Index v) {
    return static_cast<Index>(std::lower_bound(around.begin(), around.end(), v) - around.begin());
  };

  UnionFind sets(static_cast<Index>(around.size()));
  for (Index v : core)
    for (Index u : scene.neighbours[v]) sets.unite(local(v), local(u));
  for (const IntersectingPair& pair : pairs)
    sets.unite(local(scene.triangles[pair.a][0]), local(scene.triangles[pair.b][0]));

  std::vector<ConflictRegion> regions;
  std::vector<Index> region_of_root(around.size(), -1);
  for (Index v : core) {
    const Index root = sets.find(local(v));
    if (region_of_root[root] < 0) {
      region_of_root[root] = static_cast<Index>(regions.size());
      regions.emplace_back();
    }
    regions[region_of_root[root]].core.push_back(v);
  }
  for (const IntersectingPair& pair : pairs)
    regions[region_of_root[sets.find(local(scene.triangles[pair.a][0]))]].pairs.push_back(pair);
  return regions;
}

std::vector<Index> dilate(const Scene& scene, std::span<const Index> vertices, int rings) {
  std::vector<Index> all(vertices.begin(), vertices.end()), front = all;
  for (int ring = 0; ring < rings && !front.empty(); ++ring) {
    std::vector<Index> next;
    for (Index v : front) next.insert(next.end(), scene.neighbours[v].begin(), scene.neighbours[v].end());
    std::sort(next.begin(), next.end());
    next.erase(std::unique(next.begin(), next.end()), next.end());
    front.clear();
    std::set_difference(next.begin(), next.end(), all.begin(), all.end(), std::back_inserter(front));
    const auto middle = all.insert(all.end(), front.begin(), front.end());
    std::inplace_merge(all.begin(), middle, all.end());
  }
  std::erase_if(all, [&](Index v) { return scene.fixed[v] != 0; });
  return all;
}

}  // namespace unsnarl
