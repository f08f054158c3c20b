#include "untangle/coarse_solver.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <vector>

#include "contact/intersection_finder.h"
#include "recover/recover_regions.h"
#include "scene/trajectory.h"
#include "untangle/coarse_scene.h"
#include "untangle/conflict_regions.h"
#include "untangle/escalation.h"
#include "untangle/local_solver.h"
#include "untangle/strategies.h"

namespace unsnarl {
namespace {

/// h of the fine mesh: the gap that is kept on the coarse one, so that what it carries does not overlap. On two bodies
/// with 910 and 722 pairs 428 and 53 are left with 0, 60 and 0 with this; with 0.2 the recovery takes four times as
/// long.
constexpr double carried_gap = 0.05;

/// Pairs of which nothing may move.
std::vector<IntersectingPair> fixed_pairs(const Scene& scene, const std::vector<IntersectingPair>& pairs) {
  const auto is_fixed = [&](Index t) {
    return std::all_of(scene.triangles[t].begin(), scene.triangles[t].end(), [&](Index v) { return scene.fixed[v]; });
  };
  std::vector<IntersectingPair> result;
  std::copy_if(pairs.begin(), pairs.end(), std::back_inserter(result),
               [&](const IntersectingPair& pair) { return is_fixed(pair.a) && is_fixed(pair.b); });
  return result;
}

/// Returns the iterations of the ladder.
int untangle_and_recover(Scene& scene, double min_gap, const std::function<bool()>& stop) {
  SceneIndex index(scene);
  const std::vector<IntersectingPair> pairs = index.find_pairs();
  const std::vector<IntersectingPair> fixed = fixed_pairs(scene, pairs);
  EscalationOptions escalation;
  escalation.tiers = coarse_mesh_tiers();
  escalation.stop = stop;
  const EscalationResult climbed = escalate(scene, index, fixed, escalation);
  RecoverRegionsOptions recovery;
  recovery.min_gap = [&](std::span<const Index>) { return min_gap; };
  recovery.stop = stop ? stop : [] { return false; };
  Recorder nobody({}, scene.x);
  recover_regions(scene, index, merge_overlapping(climbed.moved, scene.vertex_count()), recovery, nobody);
  int iterations = 0;
  for (const RegionReport& region : climbed.regions) iterations += region.iterations;
  return iterations;
}

}  // namespace

CoarseResult solve_on_coarser_mesh(Patch& patch, std::span<const IntersectingPair> tolerated,
                                   const std::function<bool()>& stop) {
  CoarseResult result;
  IntersectionFinder finder(patch.triangles, patch.active_count);
  const auto count = [&] {
    result.pairs_left = blocking_pairs(finder.find(patch.x), tolerated).size();
    record(patch, patch.x, {.pairs = result.pairs_left});
  };
  count();
  if (const std::optional<CoarseScene> coarse = CoarseScene::of(patch)) {
    Scene scene = coarse->scene();
    result.iterations = untangle_and_recover(scene, carried_gap * patch.edge_length, stop);
    coarse->carry(scene.x, patch);
    count();
  }
  result.clean = result.pairs_left == 0;
  return result;
}

}  // namespace unsnarl
