#include "pipeline/untangle_stage.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <functional>
#include <iterator>
#include <optional>
#include <utility>

#include "contact/blocking_pairs.h"
#include "pipeline/hold_parts.h"
#include "pipeline/region_work.h"
#include "pipeline/restore_to_rest.h"
#include "untangle/conflict_regions.h"
#include "untangle/escalation.h"
#include "untangle/strategies.h"
#include "untangle/untangle_whole.h"

namespace unsnarl {
namespace {

/// Rounds of rounding and of repairing what rounding brought, at most (unit: rounds)
constexpr int rounding_rounds = 4;

/// Share of a time limit after which what is resolved is recovered, and the rest left (no unit)
constexpr double untangling_time = 0.7;
/// The stage untangles pairs once more where it has left at most this share of those at rest [E223] (no unit)
constexpr double few_left = 0.1;
/// Share of the progress reported when recovery begins (no unit)
constexpr double untangled_fraction = 0.6;
/// Share of the progress reported when recovery ends (no unit)
constexpr double recovered_fraction = 0.97;

/// pairs_now: how many triangles' pairs there are with what is being tried; not given: `left` is all.
void report_progress(const RepairTask& task, const RepairControl& control, const RepairState& state, double fraction,
                     std::span<const IntersectingPair> left, std::optional<double> pairs_now = {}) {
  // Reports and summaries count faces. A scene of triangles along both diagonals knows no faces.
  const std::vector<Index>& face_of = state.scene.face_of;
  std::size_t pairs_left = face_of.empty() ? left.size() : pairs_of_faces(face_of, left).size();
  if (pairs_now && !left.empty()) {
    const double share = std::max(0.0, *pairs_now) / static_cast<double>(left.size());
    pairs_left = static_cast<std::size_t>(std::lround(static_cast<double>(pairs_left) * share));
  }
  control.phases.report(fraction, pairs_left, state.scene.x, task.prepared.rest, task.diagonal);
}

/// Untangles the scene. Pairs that rounding brought (in rounds after the first) separate only where they are given a
/// gap; where float32 is optional, only local strategies try. Returns the pairs that are left; none: it was given up.
std::optional<std::vector<IntersectingPair>> untangle(const RepairTask& task, const RepairControl& control,
                                                      SceneIndex& index, RepairState& state, bool is_first) {
  std::atomic<bool> is_exceeded{false};
  EscalationOptions options = escalation_options(task, control, state, task.most_motion(), is_exceeded);
  if (is_first && task.options.recover) options.stop = control.limits.stopper_at(untangling_time);
  options.attempts = &state.attempts;
  options.on_progress = [&](const EscalationProgress& progress) {
    const double all = static_cast<double>(std::max<std::size_t>(1, state.pairs_at_rest.size()));
    report_progress(task, control, state, untangled_fraction * (1 - std::min(1.0, progress.work_left / all)),
                    progress.left, progress.pairs_now);
  };
  const bool may_fail = !is_first && state.format.may_give_up_float32();
  if (!is_first)
    options.min_gap = [&](std::span<const Index> vertices) { return state.format.wanted_gap(state.scene, vertices); };
  if (may_fail) options.tiers = local_tiers();
  EscalationResult result = task.options.paper
                                ? untangle_whole(state.scene, index, state.ignored, *task.options.paper, options)
                                : escalate(state.scene, index, state.ignored, options);
  state.displacement_is_exceeded |= is_exceeded;
  if (may_fail && !result.left.empty()) return std::nullopt;
  for (std::size_t k = 0; k < result.moved.size(); ++k)
    state.moved.push_back({std::move(result.moved[k]), result.depths[k], state.regions.size() + k});
  state.regions.insert(state.regions.end(), result.regions.begin(), result.regions.end());
  return std::move(result.left);
}

/// While it lives, the scene is at rest where it is.
class AtRestNow {
 public:
  explicit AtRestNow(Scene& scene) : scene_(scene), rest_(std::exchange(scene.rest, scene.x)) {}
  ~AtRestNow() { scene_.rest.swap(rest_); }
  AtRestNow(const AtRestNow&) = delete;
  AtRestNow& operator=(const AtRestNow&) = delete;

 private:
  Scene& scene_;
  Positions rest_;
};

/// The input is a poor guide for a few pairs that are left of many: where it draws to, everything intersects.
bool is_worth_untangling_from_here(const RepairTask& task, const RepairControl& control, const RepairState& state,
                                   std::span<const IntersectingPair> left) {
  const double most = few_left * static_cast<double>(state.pairs_at_rest.size());
  return !left.empty() && static_cast<double>(left.size()) <= most && !(task.most_motion() > 0) &&
         !task.options.paper && !control.limits.reached();
}

/// Recovers what moved since the last time. `left`: pairs of triangles that could not be untangled.
void recover_moved(const RepairTask& task, const RepairControl& control, std::span<const IntersectingPair> left,
                   SceneIndex& index, RepairState& state) {
  std::vector<std::vector<Index>> sets;
  for (std::size_t k = state.recovered; k < state.moved.size(); ++k) sets.push_back(state.moved[k].vertices);
  const double gap = recover_sets(task, control, std::move(sets), index, state, [&](double share) {
    report_progress(task, control, state, untangled_fraction + (recovered_fraction - untangled_fraction) * share, left);
  });
  state.smallest_gap = std::min(state.smallest_gap, gap);
}

/// The state that untangling reached; `left`: the pairs of triangles that it left.
PaperUntangling measure_untangled(const RepairTask& task, const RepairState& state,
                                  std::span<const IntersectingPair> left) {
  PaperUntangling reached;
  reached.is_clean = std::none_of(left.begin(), left.end(),
                                  [](const IntersectingPair& pair) { return pair.kind == PairClass::disjoint; });
  const std::vector<Index>& vertex_of = task.prepared.weld_map.vertex_of;
  if (!(task.diagonal > 0)) return reached;
  for (const Index v : vertex_of) {
    const double displacement_rel = (state.scene.x.col(v) - task.prepared.rest.col(v)).norm() / task.diagonal;
    reached.displacement_mean_rel += displacement_rel / static_cast<double>(vertex_of.size());
    reached.displacement_max_rel = std::max(reached.displacement_max_rel, displacement_rel);
  }
  return reached;
}

/// Says of the regions of what moved since the last recovery how deep they were and how far they went.
void measure_regions(const RepairTask& task, RepairState& state) {
  if (!(task.diagonal > 0)) return;
  for (std::size_t k = state.recovered; k < state.moved.size(); ++k) {
    RegionReport& region = state.regions[state.moved[k].region];
    region.depth_rel = state.moved[k].depth / task.diagonal;
    for (const Index v : state.moved[k].vertices) {
      const double displacement_rel = (state.scene.x.col(v) - state.scene.rest.col(v)).norm() / task.diagonal;
      if (!(displacement_rel > region.displacement_rel)) continue;
      region.displacement_rel = displacement_rel;
      region.farthest_vertex = task.prepared.weld_map.first[v];
    }
  }
}

void note_recovered(const RepairTask& task, RepairState& state) {
  measure_regions(task, state);
  state.recovered = state.moved.size();
}

/// Untangles a few pairs that are left of many as if the surface were the input as it is now, and recovers what that
/// moved. Returns what is left then.
std::vector<IntersectingPair> untangle_from_here(const RepairTask& task, const RepairControl& control,
                                                 std::vector<IntersectingPair> left, SceneIndex& index,
                                                 RepairState& state) {
  if (!is_worth_untangling_from_here(task, control, state, left)) return left;
  std::erase_if(state.regions, [](const RegionReport& region) { return region.strategy == "none"; });
  control.phases.start("untangle");
  {
    const AtRestNow at_rest(state.scene);
    left = *untangle(task, control, index, state, true);
  }
  if (task.options.recover) {
    control.phases.start("recover");
    recover_moved(task, control, left, index, state);
  }
  note_recovered(task, state);
  return left;
}

/// Lists the vertices that a recovery frees after a scene was moved to its start and untangled there, in sets that can
/// be recovered one by one: what hangs together, or intersects at rest, is in one set. Vertices at rest stay out of it
/// where nothing was untangled: else more would move with every frame of a sequence [E235].
std::vector<std::vector<Index>> sets_to_recover(const RepairState& state) {
  const Scene& scene = state.scene;
  const auto is_elsewhere = [&](Index v) { return scene.x.col(v) != scene.rest.col(v); };
  std::vector<std::vector<Index>> sets;
  for (const RepairState::Moved& moved : state.moved) sets.push_back(moved.vertices);
  for (ConflictRegion& region : conflict_regions(scene, state.pairs_at_rest)) sets.push_back(std::move(region.core));
  for (Index v = 0; v < scene.vertex_count(); ++v) {
    if (!is_elsewhere(v)) continue;
    std::vector<Index>& set = sets.emplace_back(1, v);
    std::copy_if(scene.neighbours[v].begin(), scene.neighbours[v].end(), std::back_inserter(set), is_elsewhere);
  }
  sets = merge_overlapping(std::move(sets), scene.vertex_count());
  for (std::vector<Index>& set : sets) std::erase_if(set, [&](Index v) { return scene.fixed[v] != 0; });
  return sets;
}

bool has_moved(const Scene& scene, Index t, const Positions& x) {
  const auto moved = [&](Index v) { return x.col(v) != scene.rest.col(v); };
  return std::any_of(scene.triangles[t].begin(), scene.triangles[t].end(), moved);
}

/// Pairs that exist only after rounding everything to float32, where float32 has to hold: everywhere if asked for, else
/// where something was repaired.
std::vector<IntersectingPair> float32_conflicts(const RepairTask& task, Finders& finders, const RepairState& state) {
  if (!state.format.float32()) return {};
  const Scene& scene = state.scene;
  std::vector<IntersectingPair> conflicts = blocking_pairs(finders.find_rounded(scene.x), state.ignored);
  std::erase_if(conflicts, [&](const IntersectingPair& pair) {
    const auto reason = state.policy.reason_to_leave(scene.triangles[pair.a], scene.triangles[pair.b], pair.kind);
    return (reason && is_obstruction(*reason)) ||
           (!task.options.precision && !has_moved(scene, pair.a, scene.x) && !has_moved(scene, pair.b, scene.x));
  });
  return conflicts;
}

/// Faces that are left as they are until the rounds end: those that could not be untangled, and what touches them.
class StuckFaces {
 public:
  explicit StuckFaces(const Scene& scene) : scene_(scene), is_stuck_(static_cast<std::size_t>(scene.vertex_count())) {}
  void add(const IntersectingPair& pair) {
    for (const Index t : {pair.a, pair.b})
      for (const Index v : scene_.triangles[t]) is_stuck_[v] = 1;
  }
  bool have(const IntersectingPair& pair) const {
    const auto is_stuck = [&](Index v) { return is_stuck_[v] != 0; };
    const Triangle &a = scene_.triangles[pair.a], &b = scene_.triangles[pair.b];
    return std::any_of(a.begin(), a.end(), is_stuck) || std::any_of(b.begin(), b.end(), is_stuck);
  }

 private:
  const Scene& scene_;
  std::vector<std::uint8_t> is_stuck_;  // per vertex: of a face that is stuck
};

/// Ignores what intersects on faces that are stuck, so that the others go on without them.
void ignore_stuck(Finders& finders, const StuckFaces& stuck, RepairState& state) {
  std::vector<IntersectingPair> left = blocking_pairs(finders.as_is.find(state.scene.x), state.ignored);
  std::erase_if(left, [&](const IntersectingPair& pair) { return !stuck.have(pair); });
  state.ignored.insert(state.ignored.end(), left.begin(), left.end());
  std::sort(state.ignored.begin(), state.ignored.end());
}

/// Moves what is free of these triangles to where float32 has it, so that the next round sees their conflict.
void move_to_float32(std::span<const IntersectingPair> conflicts, const Scale& scale, Scene& scene) {
  const Positions rounded = rounded_to_float32(scene.x, scale);
  for (const IntersectingPair& pair : conflicts)
    for (const Index t : {pair.a, pair.b})
      for (const Index v : scene.triangles[t])
        if (!scene.fixed[v]) scene.x.col(v) = rounded.col(v);
}

struct Rounds {
  bool is_resolved = false;
  std::optional<RepairState::Checkpoint> before_rounding;  // the last state without pairs, but of what is stuck
};

/// Untangles, recovers and rounds until nothing intersects after rounding.
Rounds work_in_rounds(const RepairTask& task, const RepairControl& control, Finders& finders, RepairState& state) {
  Rounds result;
  SceneIndex index(state.scene, finders.as_is);
  StuckFaces stuck(state.scene);
  for (int round = 0; round < rounding_rounds && !control.limits.reached(); ++round) {
    control.phases.start("untangle");
    auto left = untangle(task, control, index, state, round == 0);
    if (!left) break;
    if (round == 0 && task.options.paper) state.before_recovery = measure_untangled(task, state, *left);
    if (task.options.recover) {
      control.phases.start("recover");
      report_progress(task, control, state, untangled_fraction, *left);
      recover_moved(task, control, *left, index, state);
      if (round == 0 && !task.start) left = hold_parts(task, control, std::move(*left), index, state);
    }
    note_recovered(task, state);
    if (round == 0) left = untangle_from_here(task, control, std::move(*left), index, state);
    control.phases.start("certify");
    report_progress(task, control, state, recovered_fraction, *left);
    state.attempts.solved = state.scene.x;
    result.before_rounding = state.checkpoint();
    if (state.format.may_give_up_float32() && !fits_float32(state.scene.x, task.prepared.scale)) break;
    state.scene.x = state.format.as_written(state.scene.x);
    for (const IntersectingPair& pair : *left) stuck.add(pair);
    if (!left->empty()) ignore_stuck(finders, stuck, state);
    std::vector<IntersectingPair> conflicts = float32_conflicts(task, finders, state);
    std::erase_if(conflicts, [&](const IntersectingPair& pair) { return stuck.have(pair); });
    result.is_resolved = conflicts.empty() && is_resolved(task, finders, state);
    if (result.is_resolved) break;
    move_to_float32(conflicts, task.prepared.scale, state.scene);
  }
  return result;
}

}  // namespace

bool has_work(const RepairTask& task, Finders& finders, const RepairState& state) {
  if (state.ignored.size() != state.pairs_at_rest.size()) return true;
  return task.options.precision && !float32_conflicts(task, finders, state).empty();
}

void start_stage(const RepairTask& task, const RepairControl& control, Finders& finders, RepairState& state) {
  assert(finders.are_of(state.scene.triangles));
  if (!task.start) return;
  control.phases.start("untangle");
  Scene& scene = state.scene;
  for (Index v = 0; v < scene.vertex_count(); ++v)
    if (!scene.fixed[v]) scene.x.col(v) = task.start->col(v);
  SceneIndex index(scene, finders.as_is);
  {
    const AtRestNow at_rest(scene);
    untangle(task, control, index, state, true);
  }
  std::vector<std::vector<Index>> sets = sets_to_recover(state);
  state.moved.clear();
  for (std::vector<Index>& set : sets) {
    double depth = 0;
    for (const Index v : set) depth = std::max(depth, (scene.x.col(v) - scene.rest.col(v)).norm());
    state.moved.push_back({std::move(set), depth, state.regions.size()});
    state.regions.push_back({.strategy = "start"});
  }
}

void untangle_stage(const RepairTask& task, const RepairControl& control, Finders& finders, RepairState& state) {
  assert(finders.are_of(state.scene.triangles));
  const std::vector<IntersectingPair> ignored = state.ignored;
  const Rounds rounds = work_in_rounds(task, control, finders, state);
  state.ignored = ignored;
  if (rounds.is_resolved || !rounds.before_rounding || !state.format.may_give_up_float32()) return;
  state.format.give_up_float32();
  state.restore(*rounds.before_rounding);
  state.scene.x = state.format.as_written(state.scene.x);
}

void keep_within_displacement(const RepairTask& task, IntersectionFinder& finder, RepairState& state) {
  if (!(task.most_motion() > 0)) return;
  const Positions before = state.scene.x;
  std::vector<std::vector<Index>> sets;
  for (const RepairState::Moved& moved : state.moved) sets.push_back(moved.vertices);
  sets = merge_overlapping(std::move(sets), state.scene.vertex_count());
  if (!restore_what_is_too_far(state.scene, sets, task.most_motion(), state.pairs_at_rest, finder)) return;
  state.displacement_is_exceeded = true;
  for (Index v = 0; v < state.scene.vertex_count(); ++v)
    if (state.scene.x.col(v) != before.col(v)) state.attempts.is_too_far[v] = 1;
}

}  // namespace unsnarl
