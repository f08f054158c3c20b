#include "untangle/conflict_regions.h"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <utility>

#include "geometry/sort_unique.h"
#include "mesh/union_find.h"

namespace unsnarl {

namespace {

bool is_of_higher_valence(const Scene& scene, Index v, std::size_t most_valence) {
  return scene.neighbours[v].size() > most_valence;
}

}  // namespace

std::vector<ConflictRegion> conflict_regions(const Scene& scene, std::span<const IntersectingPair> pairs,
                                             std::size_t most_valence) {
  const auto is_inner = [&](Index v) { return !is_of_higher_valence(scene, v, most_valence); };
  const auto inner_vertex = [&](Index t) {
    const Triangle& corners = scene.triangles[t];
    const auto it = std::find_if(corners.begin(), corners.end(), is_inner);
    return it == corners.end() ? Index{-1} : *it;
  };
  // Only the vertices at and around the pairs are numbered, so that the cost follows the conflicts, not the surface.
  std::vector<Index> core;
  for (const IntersectingPair& pair : pairs)
    for (Index t : {pair.a, pair.b})
      std::copy_if(scene.triangles[t].begin(), scene.triangles[t].end(), std::back_inserter(core), is_inner);
  sort_unique(core);
  std::vector<Index> around = core;
  for (Index v : core) around.insert(around.end(), scene.neighbours[v].begin(), scene.neighbours[v].end());
  sort_unique(around);
  auto local = [&](Index v) {
    return static_cast<Index>(std::lower_bound(around.begin(), around.end(), v) - around.begin());
  };

  UnionFind sets(static_cast<Index>(around.size()));
  for (Index v : core)
    for (Index u : scene.neighbours[v])
      if (is_inner(u)) sets.unite(local(v), local(u));
  std::vector<std::pair<Index, IntersectingPair>> placed;
  for (const IntersectingPair& pair : pairs) {
    const Index a = inner_vertex(pair.a), b = inner_vertex(pair.b);
    if (a < 0 || b < 0) continue;
    sets.unite(local(a), local(b));
    placed.emplace_back(local(a), pair);
  }

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
  for (const auto& [v, pair] : placed) regions[region_of_root[sets.find(v)]].pairs.push_back(pair);
  std::erase_if(regions, [](const ConflictRegion& region) { return region.pairs.empty(); });
  return regions;
}

std::vector<Index> dilate(const Scene& scene, std::span<const Index> vertices, int rings, std::size_t most_valence) {
  assert(std::is_sorted(vertices.begin(), vertices.end()));
  std::vector<Index> all(vertices.begin(), vertices.end()), front = all;
  for (int ring = 0; ring < rings && !front.empty(); ++ring) {
    std::vector<Index> next;
    for (Index v : front) next.insert(next.end(), scene.neighbours[v].begin(), scene.neighbours[v].end());
    sort_unique(next);
    front.clear();
    std::erase_if(next, [&](Index v) { return is_of_higher_valence(scene, v, most_valence); });
    std::set_difference(next.begin(), next.end(), all.begin(), all.end(), std::back_inserter(front));
    const auto middle = all.insert(all.end(), front.begin(), front.end());
    std::inplace_merge(all.begin(), middle, all.end());
  }
  std::erase_if(all, [&](Index v) { return scene.fixed[v] != 0; });
  return all;
}

std::vector<std::vector<Index>> merge_overlapping(std::vector<std::vector<Index>> sets, Index vertex_count) {
  std::vector<Index> owner(vertex_count, -1);
  std::vector<std::vector<Index>> result;
  for (std::vector<Index>& set : sets) {
    std::vector<Index> overlapped;
    for (Index v : set)
      if (owner[v] >= 0) overlapped.push_back(owner[v]);
    sort_unique(overlapped);
    const Index target = overlapped.empty() ? static_cast<Index>(result.size()) : overlapped.front();
    if (overlapped.empty()) result.emplace_back();
    for (std::size_t k = 1; k < overlapped.size(); ++k) {
      set.insert(set.end(), result[overlapped[k]].begin(), result[overlapped[k]].end());
      result[overlapped[k]].clear();
    }
    result[target].insert(result[target].end(), set.begin(), set.end());
    for (Index v : set) owner[v] = target;
  }
  std::erase_if(result, [](const auto& set) { return set.empty(); });
  for (auto& set : result) {
    sort_unique(set);
  }
  return result;
}

}  // namespace unsnarl
