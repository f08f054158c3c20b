#include "pipeline/hold_parts.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <iterator>
#include <map>
#include <new>
#include <span>
#include <utility>

#include "contact/blocking_pairs.h"
#include "geometry/sort_unique.h"
#include "mesh/areas.h"
#include "pipeline/region_work.h"
#include "scene/meeting_components.h"
#include "scene/patch.h"
#include "untangle/conflict_regions.h"
#include "untangle/strategies.h"

namespace unsnarl {
namespace {

/// Components are not held where they bear less than this share of the squared motion of their cluster together [E213]
/// (no unit)
constexpr double least_share = 0.3;
/// A component is held where its edges are longer than this many times those of another one, which can give way
/// [E214] (no unit)
constexpr double coarser = 2;
/// A result is nearer where its motion by area is below this share of the one before (no unit)
constexpr double nearer_share = 0.98;
/// Recoveries of a cluster that went far, beyond the first, at most [E215] (unit: recoveries)
constexpr int most_recoveries = 2;

/// Conflicts that hang together, and all vertices that were moved for them.
struct Cluster {
  std::vector<Index> vertices;  ///< ascending
  bool was_open = false;        ///< a component has been held for it
  bool is_open = false;         ///< a nearer result may be looked for
};

/// One flag a component.
using Held = std::vector<std::uint8_t>;

Index component_of(const RepairTask& task, Index v) {
  return task.diagnosis.components.component_of_vertex[v];
}

std::vector<Index> triangles_of(const Scene& scene, std::span<const Index> vertices) {
  std::vector<Index> triangles;
  for (const Index v : vertices)
    triangles.insert(triangles.end(), scene.triangles_of_vertex[v].begin(), scene.triangles_of_vertex[v].end());
  sort_unique(triangles);
  return triangles;
}

/// squared_motion() of the triangles of these vertices, summed.
double motion_of(const Scene& scene, const Positions& x, std::span<const Index> vertices) {
  double sum = 0;
  for (const Index t : triangles_of(scene, vertices)) sum += squared_motion(scene.rest, x, scene.triangles[t]);
  return sum;
}

/// The largest distance from rest of these vertices.
double farthest_of(const Scene& scene, const Positions& x, std::span<const Index> vertices) {
  double farthest = 0;
  for (const Index v : vertices) farthest = std::max(farthest, (x.col(v) - scene.rest.col(v)).norm());
  return farthest;
}

/// The same of all open clusters.
double farthest_of(const Scene& scene, const Positions& x, std::span<const Cluster> clusters) {
  double farthest = 0;
  for (const Cluster& cluster : clusters)
    if (cluster.is_open) farthest = std::max(farthest, farthest_of(scene, x, cluster.vertices));
  return farthest;
}

bool is_within_limit(const RepairTask& task, const Scene& scene, std::span<const Index> vertices) {
  return !(task.most_motion() > 0) || are_within(scene.x, scene.rest, vertices, task.most_motion());
}

bool is_nearer(double motion, double before) {
  return motion < nearer_share * nearer_share * before;
}

bool has_two_free_components(const RepairTask& task, const Scene& scene, std::span<const Index> vertices) {
  Index first = -1;
  for (const Index v : vertices) {
    if (scene.fixed[v]) continue;
    if (first >= 0 && component_of(task, v) != first) return true;
    first = component_of(task, v);
  }
  return false;
}

/// The clusters of what was moved from state.recovered on. Open: two components could give way.
std::vector<Cluster> clusters_of(const RepairTask& task, const RepairState& state) {
  const Scene& scene = state.scene;
  std::vector<std::vector<Index>> sets;
  for (std::size_t k = state.recovered; k < state.moved.size(); ++k) sets.push_back(state.moved[k].vertices);
  std::vector<Cluster> clusters;
  for (std::vector<Index>& vertices : merge_overlapping(std::move(sets), scene.vertex_count())) {
    const bool may_give_way = has_two_free_components(task, scene, vertices);
    clusters.push_back({.vertices = std::move(vertices), .is_open = may_give_way});
  }
  return clusters;
}

std::vector<Index> free_of(const Scene& scene, std::span<const Index> vertices) {
  std::vector<Index> free;
  std::copy_if(vertices.begin(), vertices.end(), std::back_inserter(free), [&](Index v) { return !scene.fixed[v]; });
  return free;
}

/// Recovers clusters again that were repaired again, until that brings them no nearer.
void recover_on(const RepairTask& task, const RepairControl& control, std::span<const Cluster> clusters,
                SceneIndex& index, RepairState& state) {
  std::vector<std::vector<Index>> sets;
  for (const Cluster& cluster : clusters)
    if (cluster.was_open) sets.push_back(free_of(state.scene, cluster.vertices));
  for (int k = 0; k < most_recoveries && !sets.empty() && !control.limits.reached(); ++k) {
    std::vector<double> before;
    for (const std::vector<Index>& set : sets) before.push_back(motion_of(state.scene, state.scene.x, set));
    recover_sets(task, control, sets, index, state);
    std::vector<std::vector<Index>> nearer;
    for (std::size_t s = 0; s < sets.size(); ++s)
      if (is_nearer(motion_of(state.scene, state.scene.x, sets[s]), before[s])) nearer.push_back(std::move(sets[s]));
    sets = std::move(nearer);
  }
}

/// A component in a cluster: its part of the motion, and how coarse it is there.
struct Bearing {
  double motion = 0;            ///< squared_motion(), summed
  std::vector<Triangle> faces;  ///< of the cluster
  double edge_length = 0;       ///< mean of these faces at rest
};

std::map<Index, Bearing> bearings_of(const RepairTask& task, const Scene& scene, const Cluster& cluster) {
  std::map<Index, Bearing> bearings;
  for (const Index t : triangles_of(scene, cluster.vertices)) {
    Bearing& bearing = bearings[component_of(task, scene.triangles[t][0])];
    bearing.motion += squared_motion(scene.rest, scene.x, scene.triangles[t]);
    bearing.faces.push_back(scene.triangles[t]);
  }
  for (auto& [component, bearing] : bearings) bearing.edge_length = mean_edge_length(scene.rest, bearing.faces);
  return bearings;
}

/// Per component, those that it intersects in the input.
using Met = std::map<Index, std::vector<Index>>;

Met met_components(const RepairTask& task) {
  Met met;
  for (const auto& [a, b] : meeting_components(task.diagnosis.components, task.diagnosis.pairs)) {
    met[a].push_back(b);
    met[b].push_back(a);
  }
  return met;
}

/// Whether a component is coarser than one that it meets in the cluster.
bool is_coarse(Index component, const std::map<Index, Bearing>& bearings, const Met& met) {
  const auto found = met.find(component);
  return found != met.end() && std::any_of(found->second.begin(), found->second.end(), [&](Index other) {
           const auto of_other = bearings.find(other);
           return of_other != bearings.end() &&
                  bearings.at(component).edge_length > coarser * of_other->second.edge_length;
         });
}

/// The components of a cluster that are worth holding, the one that bears most first: coarse, not held before, no two
/// of them meet, and together they bear a share of the motion.
std::vector<Index> heaviest_components(const std::map<Index, Bearing>& bearings, const Met& met, const Held& was_held) {
  std::vector<Index> heaviest;
  double all = 0, held = 0;
  for (const auto& [component, bearing] : bearings) {
    all += bearing.motion;
    if (!was_held[component] && is_coarse(component, bearings, met)) heaviest.push_back(component);
  }
  std::stable_sort(heaviest.begin(), heaviest.end(),
                   [&](Index a, Index b) { return bearings.at(a).motion > bearings.at(b).motion; });
  std::vector<Index> apart;
  for (const Index component : heaviest) {
    const std::vector<Index>& others = met.at(component);
    if (std::find_first_of(apart.begin(), apart.end(), others.begin(), others.end()) != apart.end()) continue;
    apart.push_back(component);
    held += bearings.at(component).motion;
  }
  return held > least_share * all ? apart : std::vector<Index>();
}

/// Chooses the components of the open clusters to be held next; clusters without one are closed.
Held choose_held(const RepairTask& task, const Scene& scene, const Met& met, const Held& was_held,
                 std::vector<Cluster>& clusters) {
  Held held(task.diagnosis.components.count(), 0);
  for (Cluster& cluster : clusters) {
    if (!cluster.is_open) continue;
    const std::vector<Index> heaviest = heaviest_components(bearings_of(task, scene, cluster), met, was_held);
    cluster.is_open = !heaviest.empty();
    cluster.was_open |= cluster.is_open;
    for (const Index component : heaviest) held[component] = 1;
  }
  return held;
}

/// The pairs that are let be while the open clusters are untangled: also those of `left` that lie elsewhere.
std::vector<IntersectingPair> ignored_around(const RepairState& state, std::span<const IntersectingPair> left,
                                             std::span<const Cluster> clusters) {
  std::vector<std::uint8_t> is_tried(static_cast<std::size_t>(state.scene.vertex_count()), 0);
  for (const Cluster& cluster : clusters)
    for (const Index v : cluster.vertices) is_tried[v] = cluster.is_open;
  const auto is_of_tried = [&](Index t) {
    const Triangle& vertices = state.scene.triangles[t];
    return std::any_of(vertices.begin(), vertices.end(), [&](Index v) { return is_tried[v] != 0; });
  };
  std::vector<IntersectingPair> ignored = state.ignored;
  std::copy_if(left.begin(), left.end(), std::back_inserter(ignored),
               [&](const IntersectingPair& pair) { return !is_of_tried(pair.a) && !is_of_tried(pair.b); });
  sort_unique(ignored);
  return ignored;
}

/// Untangles the open clusters from rest, without the last resorts. `most_motion`: escalation_options().
EscalationResult untangle_from_rest(const RepairTask& task, const RepairControl& control,
                                    std::span<const IntersectingPair> ignored, std::span<const Cluster> clusters,
                                    double most_motion, SceneIndex& index, RepairState& state) {
  for (const Cluster& cluster : clusters)
    if (cluster.is_open) state.restore_to_rest(cluster.vertices);
  index.update();
  std::atomic<bool> is_exceeded{false};
  EscalationOptions options = escalation_options(task, control, state, most_motion, is_exceeded);
  options.tiers = tiers_before_last_resorts();
  options.recorder = nullptr;
  options.recover = {};
  return escalate(state.scene, index, ignored, options);
}

/// Untangles the open clusters again while components are held, and recovers them with these free. Where that leaves
/// pairs, it does so once more, no farther than the first result went: a candidate that goes far may stand in the way.
EscalationResult repair_again(const RepairTask& task, const RepairControl& control,
                              std::span<const IntersectingPair> left, std::span<const Cluster> clusters,
                              const Held& held, SceneIndex& index, RepairState& state) {
  Scene& scene = state.scene;
  const std::vector<IntersectingPair> ignored = ignored_around(state, left, clusters);
  const Positions first = scene.x;
  const std::vector<std::uint8_t> fixed = scene.fixed;
  for (Index v = 0; v < scene.vertex_count(); ++v)
    if (held[component_of(task, v)]) scene.fixed[v] = 1;
  EscalationResult result = untangle_from_rest(task, control, ignored, clusters, task.most_motion(), index, state);
  if (!result.left.empty() && !control.limits.reached()) {
    scene.x = first;
    const double farthest = farthest_of(scene, first, clusters);
    result = untangle_from_rest(task, control, ignored, clusters, farthest, index, state);
  }
  scene.fixed = fixed;
  std::vector<std::vector<Index>> sets = result.moved;
  for (const Cluster& cluster : clusters)
    if (cluster.is_open) sets.push_back(free_of(scene, cluster.vertices));
  recover_sets(task, control, std::move(sets), index, state);
  return result;
}

/// The clusters that hang together once the second result has moved more.
std::vector<Cluster> join(const Scene& scene, std::span<const Cluster> clusters,
                          std::span<const std::vector<Index>> moved, std::vector<Index>& cluster_of) {
  std::vector<std::vector<Index>> sets(moved.begin(), moved.end());
  for (const Cluster& cluster : clusters) sets.push_back(cluster.vertices);
  std::vector<Cluster> joined;
  cluster_of.assign(static_cast<std::size_t>(scene.vertex_count()), -1);
  for (std::vector<Index>& vertices : merge_overlapping(std::move(sets), scene.vertex_count())) {
    for (const Index v : vertices) cluster_of[v] = static_cast<Index>(joined.size());
    joined.push_back({std::move(vertices)});
  }
  for (const Cluster& cluster : clusters) {
    Cluster& whole = joined[cluster_of[cluster.vertices.front()]];
    whole.was_open |= cluster.was_open;
    whole.is_open |= cluster.is_open;
  }
  return joined;
}

std::vector<std::size_t> count_pairs(const Scene& scene, std::span<const IntersectingPair> pairs,
                                     std::span<const Index> cluster_of, std::size_t clusters) {
  std::vector<std::size_t> counts(clusters, 0);
  for (const IntersectingPair& pair : pairs)
    if (const Index k = cluster_of[scene.triangles[pair.a][0]]; k >= 0) ++counts[k];
  return counts;
}

/// Closes clusters whose second result is no better, and those whose second result meets the first one of others; they
/// go back to `first`. Open are those that keep the second one. `left`: the pairs of the first result, then those that
/// remain.
void keep_better(const RepairTask& task, const Positions& first, std::span<const Index> cluster_of,
                 std::vector<Cluster>& clusters, SceneIndex& index, RepairState& state,
                 std::vector<IntersectingPair>& left) {
  Scene& scene = state.scene;
  const auto go_back = [&](Cluster& cluster) {
    cluster.is_open = false;
    for (const Index v : cluster.vertices) scene.x.col(v) = first.col(v);
  };
  const auto find_pairs = [&] { return blocking_pairs(index.find_pairs(), state.ignored); };
  const std::vector<IntersectingPair> second = find_pairs();
  const std::vector<std::size_t> before = count_pairs(scene, left, cluster_of, clusters.size());
  const std::vector<std::size_t> now = count_pairs(scene, second, cluster_of, clusters.size());
  for (std::size_t k = 0; k < clusters.size(); ++k) {
    const std::vector<Index>& vertices = clusters[k].vertices;
    const auto is_kept_if_equal = [&] {
      return is_nearer(motion_of(scene, scene.x, vertices), motion_of(scene, first, vertices)) &&
             !turns_a_solid_inside_out(cut_patch(scene, index, free_of(scene, vertices), 0));
    };
    const bool is_better = now[k] < before[k] || (now[k] == before[k] && is_kept_if_equal());
    clusters[k].is_open = is_better && is_within_limit(task, scene, vertices);
    if (!clusters[k].is_open) go_back(clusters[k]);
  }
  for (bool has_changed = true; has_changed;) {
    has_changed = false;
    left = find_pairs();
    for (const IntersectingPair& pair : left) {
      if (std::binary_search(second.begin(), second.end(), pair)) continue;
      for (const Index t : {pair.a, pair.b})
        for (const Index v : scene.triangles[t]) {
          if (cluster_of[v] < 0 || !clusters[cluster_of[v]].is_open) continue;
          go_back(clusters[cluster_of[v]]);
          has_changed = true;
        }
    }
  }
}

/// Enters what the second result of the open clusters moved in place of what the first one did.
void take_over(EscalationResult& second, std::span<const Cluster> clusters, std::span<const Index> cluster_of,
               RepairState& state) {
  const auto is_open = [&](const std::vector<Index>& vertices) {
    const Index k = cluster_of[vertices.front()];
    return k >= 0 && clusters[k].is_open;
  };
  std::vector<std::uint8_t> is_replaced(state.regions.size(), 0);
  for (const RepairState::Moved& moved : state.moved) is_replaced[moved.region] = is_open(moved.vertices);
  std::vector<std::size_t> number(state.regions.size(), Recorder::no_region);
  std::vector<RegionReport> regions;
  for (std::size_t r = 0; r < number.size(); ++r) {
    if (is_replaced[r]) continue;
    number[r] = regions.size();
    regions.push_back(std::move(state.regions[r]));
  }
  std::erase_if(state.moved, [&](const RepairState::Moved& moved) { return is_replaced[moved.region] != 0; });
  for (RepairState::Moved& moved : state.moved) moved.region = number[moved.region];
  std::vector<std::uint8_t> is_listed(clusters.size(), 0);
  for (std::size_t k = 0; k < second.moved.size(); ++k) {
    if (!is_open(second.moved[k])) continue;
    const auto cluster = static_cast<std::size_t>(cluster_of[second.moved[k].front()]);
    // The recovery moved all of the cluster.
    if (!std::exchange(is_listed[cluster], std::uint8_t{1})) second.moved[k] = clusters[cluster].vertices;
    state.moved.push_back({std::move(second.moved[k]), second.depths[k], regions.size()});
    regions.push_back(std::move(second.regions[k]));
  }
  state.regions = std::move(regions);
  state.recovered = 0;  // their numbers have changed
  state.recorder.renumber(number);
  std::vector<Index> changed;
  for (const Cluster& cluster : clusters)
    if (cluster.is_open) changed.insert(changed.end(), cluster.vertices.begin(), cluster.vertices.end());
  if (changed.empty()) return;
  state.recorder.begin_stage("recover");
  state.recorder.add(state.recorder.new_trajectory(), "", Recorder::no_region, changed, state.scene.x);
}

/// Regions that no strategy resolved, as they are now.
void list_unresolved(std::span<const IntersectingPair> left, RepairState& state) {
  std::erase_if(state.regions, [](const RegionReport& region) { return region.strategy == "none"; });
  for (const ConflictRegion& region : conflict_regions(state.scene, left)) {
    state.regions.emplace_back().strategy = "none";
    state.regions.back().pairs = region.pairs.size();
  }
}

/// Repairs the open clusters again while components are held, and keeps the better results; clusters that keep the
/// first one are closed. Where memory runs out, all keep it.
void try_held(const RepairTask& task, const RepairControl& control, const Held& held, std::vector<Cluster>& clusters,
              SceneIndex& index, RepairState& state, std::vector<IntersectingPair>& left) {
  const Positions first = state.scene.x;
  const std::vector<std::uint8_t> fixed = state.scene.fixed;
  try {
    Recorder::Stages recorded = state.recorder.stages();
    EscalationResult second = repair_again(task, control, left, clusters, held, index, state);
    std::vector<Index> cluster_of;
    clusters = join(state.scene, clusters, second.moved, cluster_of);
    keep_better(task, first, cluster_of, clusters, index, state, left);
    state.recorder.restore(std::move(recorded));
    take_over(second, clusters, cluster_of, state);
  } catch (const std::bad_alloc&) {
    state.scene.x = first;
    state.scene.fixed = fixed;
    throw;
  }
}

}  // namespace

std::vector<IntersectingPair> hold_parts(const RepairTask& task, const RepairControl& control,
                                         std::vector<IntersectingPair> left, SceneIndex& index, RepairState& state) {
  if (task.diagnosis.components.count() < 2 || task.nested || task.options.paper) return left;
  std::vector<Cluster> clusters = clusters_of(task, state);
  const Met met = met_components(task);
  Held was_held(task.diagnosis.components.count(), 0);
  while (!control.limits.reached()) {
    const Held held = choose_held(task, state.scene, met, was_held, clusters);
    if (std::none_of(clusters.begin(), clusters.end(), [](const Cluster& cluster) { return cluster.is_open; })) break;
    for (std::size_t c = 0; c < held.size(); ++c) was_held[c] |= held[c];
    try_held(task, control, held, clusters, index, state, left);
  }
  if (std::none_of(was_held.begin(), was_held.end(), [](std::uint8_t held) { return held != 0; })) return left;
  recover_on(task, control, clusters, index, state);
  index.update();
  list_unresolved(left, state);
  return left;
}

}  // namespace unsnarl
