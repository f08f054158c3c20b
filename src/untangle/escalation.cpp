#include "untangle/escalation.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <optional>
#include <utility>

#include "contact/blocking_pairs.h"
#include "scene/independent_batches.h"
#include "scene/patch_progress.h"
#include "untangle/agenda.h"
#include "untangle/candidates.h"
#include "untangle/conflict_regions.h"

namespace unsnarl {
namespace {

/// Makes the surface take the positions of a candidate.
using Keep = std::function<void(Trial& trial)>;

bool is_stopped(const EscalationOptions& options) {
  return options.stop && options.stop();
}

/// `trials`: how far the candidates are that are made now.
void report(const EscalationOptions& options, std::span<const IntersectingPair> left,
            std::span<const PatchProgress> trials) {
  if (!options.on_progress) return;
  const double pairs = static_cast<double>(left.size());
  EscalationProgress progress{left, pairs, pairs};
  for (const PatchProgress& trial : trials) {
    const double before = static_cast<double>(trial.pairs_before);
    progress.pairs_now -= before - static_cast<double>(trial.pairs.load());
    progress.work_left -= before * trial.done;
  }
  options.on_progress(progress);
}

std::vector<Trial> begin_trials(const Strategy& strategy, const Conflicts& conflicts,
                                const EscalationOptions& options) {
  if (options.recorder) options.recorder->begin_stage("untangle");
  std::vector<Trial> trials;
  for (Selection& selection : strategy.select(conflicts)) {
    if (options.attempts) options.attempts->note_tried(selection.region.core, strategy.name);
    trials.push_back(make_trial(strategy, std::move(selection)));
  }
  return trials;
}

std::vector<Box> boxes_of(const Scene& scene, std::span<const Trial> trials) {
  std::vector<Box> boxes;
  for (const Trial& trial : trials) boxes.push_back(patch_box(scene, trial.selection.free, 2 * trial.reach));
  return boxes;
}

void apply_verdict(Trial& trial, Verdict verdict, const Scene& scene, Candidates& candidates, const Keep& keep) {
  const bool is_of_use = verdict == Verdict::keep || verdict == Verdict::remember;
  if (is_of_use && !trial.is_clean()) trial.trajectory.end_at_fewest_pairs();
  if (verdict == Verdict::keep) keep(trial);
  if (verdict == Verdict::remember) candidates.remember(std::move(trial), scene);
  if (verdict == Verdict::wait) candidates.wait(std::move(trial), scene);
}

/// Puts candidates that went far among what they meet there, and decides what becomes of each.
void compare(std::vector<Trial>& trials, const Scene& scene, const SceneIndex& index, const EscalationOptions& options,
             Candidates& candidates, const Keep& keep) {
  run_in_batches(
      boxes_of(scene, trials), [&](std::size_t i) { look_farther(trials[i], scene, index, options.recover); },
      [&](std::size_t i) {
        const Trial* rival = candidates.rival(trials[i].selection.region, scene);
        apply_verdict(trials[i], judge_far(trials[i], rival), scene, candidates, keep);
      });
}

/// Runs trials, those that do not disturb each other in parallel, and decides what becomes of each candidate. `pairs`:
/// all that are left before.
void try_candidates(std::vector<Trial>& trials, std::span<const IntersectingPair> pairs, const Scene& scene,
                    const SceneIndex& index, const EscalationOptions& options, Candidates& candidates,
                    const Keep& keep) {
  std::vector<PatchProgress> progress(trials.size());
  for (std::size_t i = 0; i < trials.size(); ++i) progress[i].begin(trials[i].selection.region.pairs.size());
  const std::function<void()> tell = [&] { report(options, pairs, progress); };
  ProgressReporter reporter(tell, options.stop);
  const std::function<bool()> stop = [&] { return reporter.asked(); };
  const Task task{.untangle = make_untangler(stop, options.left_out), .stop = stop};
  std::vector<Trial> far;
  run_in_batches(
      boxes_of(scene, trials), [&](std::size_t i) { run_trial(trials[i], scene, index, options, task, progress[i]); },
      [&](std::size_t i) {
        Trial& trial = trials[i];
        const bool must_be_clean = static_cast<bool>(options.accept);
        const Verdict verdict = judge(trial, must_be_clean, candidates.rival(trial.selection.region, scene));
        progress[i].set_pairs(verdict == Verdict::keep ? trial.left.total : progress[i].pairs_before);
        if (verdict == Verdict::compare) {
          trial.reach = std::max(trial.reach, 2 * largest_motion(trial));
          far.push_back(std::move(trial));
        } else {
          apply_verdict(trial, verdict, scene, candidates, keep);
        }
      });
  compare(far, scene, index, options, candidates, keep);
}

/// Regions that were resolved in a way that was not accepted: the whole around them will hardly be.
void note_rejected(std::span<const Trial> trials, AttemptLog* attempts, std::vector<std::uint8_t>& is_rejected) {
  for (const Trial& trial : trials) {
    if (!trial.is_rejected) continue;
    for (const Index v : trial.selection.region.core) is_rejected[v] = 1;
    if (attempts) attempts->note_too_far(trial.selection.region.core);
  }
}

/// Pastes a candidate into the scene and enters it in the result.
void commit(Trial& trial, Scene& scene, SceneIndex& index, const EscalationOptions& options, EscalationResult& result) {
  paste_patch(trial.patch, scene, index);
  if (options.recorder)
    options.recorder->add(std::move(trial.trajectory), trial.strategy->name,
                          options.first_region + result.regions.size(), trial.selection.free, scene.x);
  RegionReport region;
  region.strategy = trial.strategy->name;
  region.faces = static_cast<std::size_t>(trial.patch.active_count);
  region.pairs = trial.resolved();
  region.iterations = trial.iterations;
  region.seconds = trial.seconds;
  result.regions.push_back(std::move(region));
  result.depths.push_back(largest_distance(trial));
  result.moved.push_back(to_be_recovered(trial, scene));
}

/// Other regions may have moved around a candidate since it was made: it counts as what it is among them.
bool still_holds(Trial& trial, const Scene& scene, const SceneIndex& index) {
  if (!is_current(trial, scene)) return false;
  put_among_obstacles(trial, scene, index);
  return trial.left.fell_from(trial.before);
}

void note_what_is_left(const Scene& scene, const EscalationOptions& options, EscalationResult& result) {
  if (options.attempts && is_stopped(options)) options.attempts->note_cut_short(result.left, scene.triangles);
  for (const ConflictRegion& region : conflict_regions(scene, result.left)) {
    RegionReport unresolved;
    unresolved.strategy = "none";
    unresolved.pairs = region.pairs.size();
    result.regions.push_back(unresolved);
  }
}

}  // namespace

EscalationResult escalate(Scene& scene, SceneIndex& index, std::span<const IntersectingPair> ignored,
                          const EscalationOptions& options) {
  assert(std::is_sorted(ignored.begin(), ignored.end()));
  const std::vector<Level> levels = levels_of(options.tiers, options.left_out);
  const auto last = static_cast<Index>(levels.size());
  Agenda agenda(scene.vertex_count(), last);
  Candidates candidates;
  std::vector<std::uint8_t> is_rejected(static_cast<std::size_t>(scene.vertex_count()), 0);
  std::optional<ConnectedParts> parts;
  const auto parts_once = [&]() -> const ConnectedParts& { return parts ? *parts : parts.emplace(scene); };
  EscalationResult result;

  const auto find_pairs = [&] {
    result.left = blocking_pairs(index.find_pairs(), ignored);
    report(options, result.left, {});
  };
  const Keep keep = [&](Trial& trial) {
    commit(trial, scene, index, options, result);
    agenda.restart(trial.selection.free);
    agenda.restart(trial.selection.region.core);  // some are fixed
  };
  const Keep keep_if_it_holds = [&](Trial& trial) {
    if (still_holds(trial, scene, index)) keep(trial);
  };
  const auto is_beyond = [&](Index level) {
    return [&agenda, level](const Trial& trial) { return agenda.level_of(trial.selection.region) > level; };
  };

  find_pairs();
  const std::vector<IntersectingPair> initial_pairs = result.left;
  while (!result.left.empty() && !is_stopped(options)) {
    const Agenda::Due due = agenda.advance(conflict_regions(scene, result.left));
    if (due.level == last) break;
    const Level& level = levels[static_cast<std::size_t>(due.level)];
    const Conflicts conflicts{scene, result.left, initial_pairs, due.vertices, is_rejected, parts_once};
    std::vector<Trial> trials = begin_trials(*level.strategy, conflicts, options);
    index.update();
    try_candidates(trials, result.left, scene, index, options, candidates, keep);
    note_rejected(trials, options.attempts, is_rejected);
    if (level.ends_tier) candidates.take_best(kept_of_tier, is_beyond(due.level), scene, keep_if_it_holds);
    if (level.ends_waiting)
      for (Trial& trial : candidates.take_waiting(is_beyond(due.level))) keep_if_it_holds(trial);
    find_pairs();
  }
  for (Trial& trial : candidates.take_waiting(is_beyond(-1))) keep_if_it_holds(trial);
  if (!is_stopped(options)) candidates.take_best(1, is_beyond(last - 1), scene, keep_if_it_holds);
  find_pairs();
  note_what_is_left(scene, options, result);
  return result;
}

Untangler make_untangler(std::function<bool()> stop, std::span<const std::string> left_out) {
  return [stop = std::move(stop), left_out](Scene& scene, SceneIndex& index,
                                            std::span<const IntersectingPair> tolerated, std::span<const Tier> tiers,
                                            const UntanglingProgress& tell) {
    EscalationOptions options;
    options.stop = stop;
    options.tiers = tiers;
    options.left_out.assign(left_out.begin(), left_out.end());
    if (tell)
      options.on_progress = [&](const EscalationProgress& progress) { tell(progress.pairs_now, progress.work_left); };
    EscalationResult result = escalate(scene, index, tolerated, options);
    Untangled untangled{std::move(result.left)};
    for (const RegionReport& region : result.regions) untangled.iterations += region.iterations;
    return untangled;
  };
}

}  // namespace unsnarl
