#include "pipeline/hold_parts.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

#include "contact/blocking_pairs.h"
#include "energy/minkowski_penalty.h"
#include "geometry/sort_unique.h"
#include "mesh/areas.h"
#include "mesh/union_find.h"
#include "pipeline/region_work.h"
#include "untangle/conflict_regions.h"
#include "untangle/strategies.h"

namespace unsnarl {
namespace {

double env(const char* name, double value) { const char* e = std::getenv(name); return e ? std::atof(e) : value; }

/// A result that is not nearer than this, by area, is not worth a change (unit: share of the motion before)
constexpr double nearer_share = 0.98;

/// Conflicts that hang together, and all vertices that were moved for them.
struct Cluster {
  std::vector<Index> vertices;  // ascending
  std::vector<Index> held;      // components that have been held
  int failures = 0;
  bool is_open = true;          // another component may be held
};

Index part_of(const RepairTask& task, Index v) {
  return task.diagnosis.components.component_of_vertex[v];
}

std::vector<Index> triangles_of(const Scene& scene, std::span<const Index> vertices) {
  std::vector<Index> triangles;
  for (const Index v : vertices)
    triangles.insert(triangles.end(), scene.triangles_of_vertex[v].begin(), scene.triangles_of_vertex[v].end());
  sort_unique(triangles);
  return triangles;
}

/// Integral of the squared motion over the triangles of these vertices.
double motion_of(const Scene& scene, const Positions& x, std::span<const Index> vertices) {
  double sum = 0;
  for (const Index t : triangles_of(scene, vertices)) sum += squared_motion(scene.rest, x, scene.triangles[t]);
  return sum;
}

/// Sets that have a vertex in common are joined.
std::vector<std::vector<Index>> joined(const Scene& scene, std::span<const std::vector<Index>> sets) {
  return merge_overlapping({sets.begin(), sets.end()}, scene.vertex_count());
}

bool goes_beyond_depth(const Scene& scene, std::span<const IntersectingPair> pairs, std::span<const Index> cluster_of,
                       Index cluster, const Cluster& c) {
  double deepest = 0, farthest = 0;
  for (const IntersectingPair& pair : pairs)
    if (cluster_of[scene.triangles[pair.a][0]] == cluster)
      deepest = std::max(deepest, overlap_depth(scene.rest, scene.triangles[pair.a], scene.triangles[pair.b]));
  for (const Index v : c.vertices) farthest = std::max(farthest, (scene.x.col(v) - scene.rest.col(v)).norm());
  return farthest > env("U_DEPTH", 2) * 0.5 * deepest;
}

bool has_two_free_parts(const RepairTask& task, const Scene& scene, const Cluster& cluster) {
  Index first = -1;
  for (const Index v : cluster.vertices) {
    if (scene.fixed[v]) continue;
    if (first >= 0 && part_of(task, v) != first) return true;
    first = part_of(task, v);
  }
  return false;
}

std::vector<Cluster> clusters_of(const RepairTask& task, const RepairState& state) {
  const Scene& scene = state.scene;
  std::vector<std::vector<Index>> sets;
  for (const RepairState::Moved& moved : state.moved) sets.push_back(moved.vertices);
  const std::vector<IntersectingPair> pairs = blocking_pairs(state.pairs_at_rest, state.ignored);
  for (const IntersectingPair& pair : pairs) {
    std::vector<Index> corners;
    for (const Index t : {pair.a, pair.b})
      corners.insert(corners.end(), scene.triangles[t].begin(), scene.triangles[t].end());
    sort_unique(corners);
    sets.push_back(std::move(corners));
  }
  std::vector<Cluster> clusters;
  std::vector<Index> cluster_of(static_cast<std::size_t>(scene.vertex_count()), -1);
  for (std::vector<Index>& vertices : joined(scene, sets)) {
    for (const Index v : vertices) cluster_of[v] = static_cast<Index>(clusters.size());
    clusters.push_back({std::move(vertices), {}});
  }
  for (std::size_t k = 0; k < clusters.size(); ++k)
    clusters[k].is_open = has_two_free_parts(task, scene, clusters[k]) &&
                          goes_beyond_depth(scene, pairs, cluster_of, static_cast<Index>(k), clusters[k]);
  return clusters;
}

/// Of the components that have not been held, the one that bears most of the motion; none: none moved.
std::optional<Index> heaviest_part(const RepairTask& task, const Scene& scene, const Cluster& cluster) {
  std::map<Index, double> motion;
  for (const Index t : triangles_of(scene, cluster.vertices)) {
    const Triangle& corners = scene.triangles[t];
    motion[part_of(task, corners[0])] += squared_motion(scene.rest, scene.x, corners);
  }
  double all = 0;
  for (const auto& [part, m] : motion) all += m;
  for (const Index part : cluster.held) motion.erase(part);
  const auto most =
      std::ranges::max_element(motion, {}, [](const auto& part_and_motion) { return part_and_motion.second; });
  if (most == motion.end() || !(most->second > env("U_SHARE", 0) * all)) return std::nullopt;
  return most->first;
}

/// Repairs the open clusters again from rest, these components held, and recovers with them free.
EscalationResult repair_again(const RepairTask& task, const RepairControl& control, std::span<const Cluster> clusters,
                              std::span<const std::uint8_t> is_held, SceneIndex& index, RepairState& state, const Positions& saved) {
  Scene& scene = state.scene;
  std::vector<std::uint8_t> fixed = scene.fixed;
  for (const Cluster& cluster : clusters)
    if (cluster.is_open) state.restore_to_rest(cluster.vertices);
  for (Index v = 0; v < scene.vertex_count(); ++v)
    if (is_held[part_of(task, v)]) scene.fixed[v] = 1;
  index.update();
  std::atomic<bool> is_exceeded{false};
  EscalationOptions options = escalation_options(task, control, state, is_exceeded);
  std::vector<Tier> tiers(options.tiers.begin(), options.tiers.end());
  if (std::getenv("U_NOLAST")) std::erase_if(tiers, [](const Tier& tier) { return tier.is_last_resort; });
  if (std::getenv("U_LOCAL")) tiers = {tiers[0]};
  if (std::getenv("U_NOCTF")) tiers = {tiers[0], tiers[1], tiers[3]};
  if (std::getenv("U_NOREC")) options.recover = {};
  options.tiers = tiers;
  const auto t0 = std::chrono::steady_clock::now();
  EscalationResult result = escalate(scene, index, state.ignored, options);
  const auto t1 = std::chrono::steady_clock::now();
  scene.fixed = std::move(fixed);
  std::vector<std::vector<Index>> sets = result.moved;
  for (const Cluster& cluster : clusters) {
    if (!cluster.is_open) continue;
    sets.emplace_back();
    std::ranges::copy_if(cluster.vertices, std::back_inserter(sets.back()), [&](Index v) { return !scene.fixed[v]; });
  }
  const auto r0 = recover_sets;
  (void)r0;
  if (result.left.empty() || !std::getenv("U_FAIL")) {
    if (std::getenv("U_QUICK")) quick_recovery = true;
    recover_sets(task, control, sets, index, state, {});
    if (quick_recovery) {
      quick_recovery = false;
      std::vector<Index> all;
      for (auto& s : sets) all.insert(all.end(), s.begin(), s.end());
      sort_unique(all);
      const double is = motion_of(scene, scene.x, all), was = motion_of(scene, saved, all);
      if (is < env("U_QUICK", 1) * was) recover_sets(task, control, sets, index, state, {});
    }
  }
  if (std::getenv("U_VERBOSE")) std::printf("   escalate %.3f recover %.3f left %zu\n", std::chrono::duration<double>(t1 - t0).count(), std::chrono::duration<double>(std::chrono::steady_clock::now() - t1).count(), result.left.size());
  if (std::getenv("U_VERBOSE")) for (auto& r : result.regions) std::printf("      %s %zu\n", r.strategy.c_str(), r.pairs);
  return result;
}

}  // namespace

std::vector<IntersectingPair> hold_parts(const RepairTask& task, const RepairControl& control, SceneIndex& index,
                                         RepairState& state) {
  Scene& scene = state.scene;
  const bool verbose = std::getenv("U_VERBOSE");
  std::vector<Cluster> clusters = clusters_of(task, state);
  std::vector<IntersectingPair> left = blocking_pairs(index.find_pairs(), state.ignored);
  if (const char* e = std::getenv("U_AGAIN")) {
    std::vector<std::vector<Index>> sets;
    for (const Cluster& c : clusters) { sets.emplace_back(); for (Index v : c.vertices) if (!scene.fixed[v]) sets.back().push_back(v); }
    for (int k = 0; k < std::atoi(e); ++k) recover_sets(task, control, sets, index, state, {});
  }
  if (std::getenv("U_NOHOLD")) return blocking_pairs(index.find_pairs(), state.ignored);
  for (int round = 0;; ++round) {
    std::vector<std::uint8_t> is_held(task.diagnosis.components.count(), 0);
    bool any = false;
    for (Cluster& cluster : clusters) {
      if (!cluster.is_open) continue;
      const std::optional<Index> part = heaviest_part(task, scene, cluster);
      cluster.is_open = part.has_value();
      if (!part) continue;
      cluster.held.push_back(*part);
      is_held[*part] = 1;
      any = true;
      if (verbose) std::printf("round %d cluster of %zu vertices holds %d\n", round, cluster.vertices.size(), *part);
    }
    if (!any || control.limits.reached()) break;
    const Positions saved = scene.x;
    EscalationResult again = repair_again(task, control, clusters, is_held, index, state, saved);
    // Decide.
    std::vector<std::vector<Index>> sets = again.moved;
    for (const Cluster& cluster : clusters) sets.push_back(cluster.vertices);
    std::vector<Cluster> unions;
    std::vector<Index> union_of(static_cast<std::size_t>(scene.vertex_count()), -1);
    for (std::vector<Index>& vertices : joined(scene, sets)) {
      for (const Index v : vertices) union_of[v] = static_cast<Index>(unions.size());
      unions.push_back({std::move(vertices), {}, 0, false});
    }
    for (const Cluster& cluster : clusters) {
      Cluster& u = unions[union_of[cluster.vertices.front()]];
      u.held.insert(u.held.end(), cluster.held.begin(), cluster.held.end());
      u.is_open |= cluster.is_open;
      u.failures = std::max(u.failures, cluster.failures);
    }
    std::vector<IntersectingPair> pairs = blocking_pairs(index.find_pairs(), state.ignored);
    const auto count = [&](std::span<const IntersectingPair> list) {
      std::vector<std::size_t> counts(unions.size(), 0);
      for (const IntersectingPair& pair : list)
        if (const Index u = union_of[scene.triangles[pair.a][0]]; u >= 0) ++counts[u];
      return counts;
    };
    const std::vector<std::size_t> before = count(left), now = count(pairs);
    std::vector<std::uint8_t> is_kept(unions.size(), 0);
    const auto revert = [&](std::size_t k) {
      is_kept[k] = 0;
      for (const Index v : unions[k].vertices) scene.x.col(v) = saved.col(v);
    };
    for (std::size_t k = 0; k < unions.size(); ++k) {
      Cluster& u = unions[k];
      const double was = motion_of(scene, saved, u.vertices), is = motion_of(scene, scene.x, u.vertices);
      is_kept[k] = now[k] < before[k] || (now[k] == before[k] && is < nearer_share * nearer_share * was);
      if (verbose && u.is_open) std::printf("  union of %zu: pairs %zu -> %zu motion %.5f -> %.5f\n", u.vertices.size(), before[k], now[k], std::sqrt(was), std::sqrt(is));
      if (!is_kept[k]) revert(k);
      if (!is_kept[k] && ++u.failures > env("U_PATIENCE", 0)) u.is_open = false;
    }
    for (bool changed = true; changed;) {
      changed = false;
      index.update();
      left = blocking_pairs(index.find_pairs(), state.ignored);
      for (const IntersectingPair& pair : left) {
        if (std::ranges::binary_search(pairs, pair)) continue;
        for (const Index t : {pair.a, pair.b})
          for (const Index v : scene.triangles[t])
            if (union_of[v] >= 0 && is_kept[union_of[v]]) revert(union_of[v]), changed = true;
      }
    }
    // Take over.
    std::vector<RepairState::Moved> moved;
    std::vector<RegionReport> regions;
    const auto add = [&](RepairState::Moved m, const RegionReport& region) {
      m.region = regions.size();
      regions.push_back(region);
      moved.push_back(std::move(m));
    };
    for (RepairState::Moved& m : state.moved) {
      const Index u = union_of[m.vertices.front()];
      if (u < 0 || !is_kept[u]) add(std::move(m), state.regions[m.region]);
    }
    for (std::size_t k = 0; k < again.moved.size(); ++k)
      if (is_kept[union_of[again.moved[k].front()]]) add({std::move(again.moved[k]), again.depths[k], 0}, again.regions[k]);
    state.moved = std::move(moved);
    state.regions = std::move(regions);
    clusters = std::move(unions);
  }
  return left;
}

}  // namespace unsnarl
