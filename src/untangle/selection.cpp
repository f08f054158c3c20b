#include "untangle/selection.h"

#include <algorithm>
#include <cassert>

#include "mesh/areas.h"
#include "mesh/union_find.h"

namespace unsnarl {
namespace {

/// The regions that conflicts are cut into, and which of them have been selected or taken in.
struct RegionMap {
  std::vector<ConflictRegion> regions;
  std::vector<Index> region_of;  // per vertex of a core; -1: of none
  std::vector<std::uint8_t> is_taken;
};

RegionMap map_regions(const Conflicts& conflicts, std::size_t most_valence) {
  RegionMap map;
  map.regions = conflict_regions(conflicts.scene, conflicts.pairs, most_valence);
  map.region_of.assign(static_cast<std::size_t>(conflicts.scene.vertex_count()), -1);
  for (std::size_t r = 0; r < map.regions.size(); ++r)
    for (const Index v : map.regions[r].core) map.region_of[v] = static_cast<Index>(r);
  map.is_taken.assign(map.regions.size(), 0);
  return map;
}

/// Takes in the regions that the free vertices reach. Returns their numbers.
std::vector<std::size_t> take_in(RegionMap& map, Selection& selection) {
  ConflictRegion& region = selection.region;
  std::vector<std::size_t> taken;
  for (const Index v : selection.free) {
    const Index other = map.region_of[v];
    if (other < 0 || map.is_taken[other]) continue;
    map.is_taken[other] = 1;
    taken.push_back(static_cast<std::size_t>(other));
    const ConflictRegion& added = map.regions[other];
    region.core.insert(region.core.end(), added.core.begin(), added.core.end());
    region.pairs.insert(region.pairs.end(), added.pairs.begin(), added.pairs.end());
  }
  std::sort(region.core.begin(), region.core.end());
  std::sort(region.pairs.begin(), region.pairs.end());
  return taken;
}

/// Selects around one region. None: nothing is freed, and regions that it reached may be selected by themselves.
std::optional<Selection> select_around(RegionMap& map, std::size_t seed, const Extent& extent) {
  Selection selection;
  selection.region = map.regions[seed];
  selection.depth = extent.depth;
  map.is_taken[seed] = 1;
  std::vector<std::size_t> taken;
  for (bool has_grown = true; has_grown;) {
    selection.free = extent.free_vertices(selection.region);
    const std::vector<std::size_t> added = take_in(map, selection);
    taken.insert(taken.end(), added.begin(), added.end());
    has_grown = !added.empty();
  }
  if (!selection.free.empty() && (!extent.is_wanted || extent.is_wanted(selection))) return selection;
  for (const std::size_t other : taken) map.is_taken[other] = 0;
  return std::nullopt;
}

double edge_length_of(const Scene& scene, const ConflictRegion& region) {
  std::vector<Triangle> faces;
  for (const IntersectingPair& pair : region.pairs)
    for (const Index t : {pair.a, pair.b}) faces.push_back(scene.triangles[t]);
  return mean_equilateral_side(scene.rest, faces);
}

/// The depth that a strategy takes a region to have; 0: it leaves the region to others.
int depth_for(const Conflicts& conflicts, const ConflictRegion& region, const DepthOptions& options) {
  // A region that encloses another one so deep has more vertices.
  const bool may_be_deep = region.core.size() / 2 >= static_cast<std::size_t>(options.least);
  const int depth = may_be_deep ? tangle_depth(conflicts.scene, conflicts.parts(), region.core) : 0;
  if (options.factor > 1) return options.factor * std::max(depth, options.least);
  return depth < options.least ? 0 : depth;
}

/// The largest number of these vertices that are connected to each other.
std::size_t most_in_one_component(const ConnectedParts& parts, std::span<const Index> vertices) {
  std::vector<std::size_t> counts(static_cast<std::size_t>(parts.count), 0);
  for (const Index v : vertices) ++counts[parts.of_vertex[v]];
  return counts.empty() ? 0 : *std::max_element(counts.begin(), counts.end());
}

}  // namespace

std::vector<Selection> select_regions(
    const Conflicts& conflicts, std::size_t most_valence,
    const std::function<std::optional<Extent>(const ConflictRegion& region)>& extent_of) {
  assert(std::is_sorted(conflicts.pairs.begin(), conflicts.pairs.end()));
  assert(conflicts.is_due.size() == static_cast<std::size_t>(conflicts.scene.vertex_count()));
  RegionMap map = map_regions(conflicts, most_valence);
  std::vector<Selection> selections;
  for (std::size_t r = 0; r < map.regions.size(); ++r) {
    const std::vector<Index>& core = map.regions[r].core;
    const auto is_due = [&](Index v) { return conflicts.is_due[v] != 0; };
    if (map.is_taken[r] || std::none_of(core.begin(), core.end(), is_due)) continue;
    const std::optional<Extent> extent = extent_of(map.regions[r]);
    if (!extent) continue;
    std::optional<Selection> selection = select_around(map, r, *extent);
    if (!selection) continue;
    selection->edge_length = edge_length_of(conflicts.scene, selection->region);
    selection->bound = extent->reach * selection->edge_length;
    selections.push_back(std::move(*selection));
  }
  return selections;
}

std::vector<Index> free_vertices_of_components(const Scene& scene, const ConnectedParts& parts,
                                               std::span<const Index> vertices) {
  std::vector<std::uint8_t> is_wanted(static_cast<std::size_t>(parts.count), 0);
  for (const Index v : vertices) is_wanted[parts.of_vertex[v]] = 1;
  std::vector<Index> free;
  for (Index v = 0; v < scene.vertex_count(); ++v)
    if (!scene.fixed[v] && parts.of_vertex[v] >= 0 && is_wanted[parts.of_vertex[v]]) free.push_back(v);
  return free;
}

std::vector<Index> vertices_of_tied_components(const Scene& scene, const ConnectedParts& parts,
                                               const ConflictRegion& region,
                                               std::span<const IntersectingPair> initial_pairs) {
  const auto part_of = [&](Index t) { return parts.of_vertex[scene.triangles[t][0]]; };
  UnionFind tied(parts.count);
  bool is_between = false;
  for (const IntersectingPair& pair : region.pairs) is_between |= part_of(pair.a) != part_of(pair.b);
  if (!is_between) return {};
  for (const auto pairs : {std::span<const IntersectingPair>(region.pairs), initial_pairs})
    for (const IntersectingPair& pair : pairs) tied.unite(part_of(pair.a), part_of(pair.b));
  const Index group = tied.find(part_of(region.pairs.front().a));
  std::vector<std::uint8_t> is_free(static_cast<std::size_t>(parts.count), 0);
  for (std::size_t part = 0; part < is_free.size(); ++part)
    is_free[part] = tied.find(static_cast<Index>(part)) == group;
  for (Index v = 0; v < scene.vertex_count(); ++v)
    if (scene.fixed[v]) is_free[parts.of_vertex[v]] = 0;
  std::vector<Index> vertices;
  for (Index v = 0; v < scene.vertex_count(); ++v)
    if (is_free[parts.of_vertex[v]]) vertices.push_back(v);
  return vertices;
}

Select select_rings(const RingsOptions& options) {
  return [options](const Conflicts& conflicts) {
    return select_regions(conflicts, options.most_valence, [&](const ConflictRegion&) {
      const auto free = [&](const ConflictRegion& region) {
        return dilate(conflicts.scene, region.core, options.rings, options.most_valence);
      };
      return std::optional<Extent>({.free_vertices = free, .reach = options.reach});
    });
  };
}

Select select_by_depth(const DepthOptions& options) {
  return [options](const Conflicts& conflicts) {
    const auto extent_of = [&](const ConflictRegion& seed) -> std::optional<Extent> {
      const int depth = depth_for(conflicts, seed, options);
      if (depth == 0) return std::nullopt;
      const auto free = [&conflicts, rings = static_cast<int>(options.rings_per_edge * depth)](
                            const ConflictRegion& region) { return dilate(conflicts.scene, region.core, rings); };
      const auto is_wanted = [&](const Selection& selection) {
        if (most_in_one_component(conflicts.parts(), selection.free) < options.least_free) return false;
        if (!options.leaves_most) return true;
        return 2 * selection.free.size() <
               free_vertices_of_components(conflicts.scene, conflicts.parts(), selection.region.core).size();
      };
      return Extent{.free_vertices = free, .is_wanted = is_wanted, .reach = options.reach, .depth = depth};
    };
    std::vector<Selection> selections = select_regions(conflicts, any_valence, extent_of);
    for (Selection& selection : selections) selection.bound *= selection.depth;
    return selections;
  };
}

Select select_tied_components(double reach) {
  return [reach](const Conflicts& conflicts) {
    return select_regions(conflicts, any_valence, [&](const ConflictRegion&) {
      const auto free = [&](const ConflictRegion& region) {
        return vertices_of_tied_components(conflicts.scene, conflicts.parts(), region, conflicts.initial_pairs);
      };
      return std::optional<Extent>({.free_vertices = free, .reach = reach});
    });
  };
}

Select select_whole_components(double reach) {
  return [reach](const Conflicts& conflicts) {
    return select_regions(conflicts, any_valence, [&](const ConflictRegion& seed) -> std::optional<Extent> {
      const auto is_rejected = [&](Index v) { return conflicts.is_rejected[v] != 0; };
      if (std::any_of(seed.core.begin(), seed.core.end(), is_rejected)) return std::nullopt;
      const auto free = [&](const ConflictRegion& region) {
        return free_vertices_of_components(conflicts.scene, conflicts.parts(), region.core);
      };
      return Extent{.free_vertices = free, .reach = reach};
    });
  };
}

}  // namespace unsnarl
