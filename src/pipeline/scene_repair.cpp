#include "pipeline/scene_repair.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <utility>

#include "contact/blocking_pairs.h"
#include "geometry/sort_unique.h"
#include "mesh/areas.h"
#include "pipeline/gap.h"
#include "pipeline/open_dihedrals.h"
#include "pipeline/restore_to_rest.h"
#include "recover/recover.h"
#include "recover/recover_regions.h"
#include "scene/rounding.h"
#include "unsnarl/stage_clock.h"
#include "untangle/conflict_regions.h"
#include "untangle/local_solver.h"
#include "untangle/push_into_nesting.h"
#include "untangle/strategies.h"
#include "untangle/untangle_whole.h"

namespace unsnarl {
namespace {

/// Rounding, repair of what rounding brought, and again.
constexpr int rounding_rounds = 4;

/// Fractions of the progress that is reported: what has been done when recovery begins, and when it has ended. Mean
/// over 39 samples: 58 % of the time for untangling, 37 % for recovery, 3 % for certification.
constexpr double untangled_fraction = 0.6, recovered_fraction = 0.97;

}  // namespace

SceneRepair::SceneRepair(const Job& job, Scene scene, std::vector<IntersectingPair> pairs,
                         std::vector<IntersectingPair> ignored)
    : job_(job),
      scene_(std::move(scene)),
      pairs_(std::move(pairs)),
      ignored_(std::move(ignored)),
      is_tolerated_(job.diagnosis.components.count(), 0),
      float32_(chooses_float32()) {}

bool SceneRepair::is_resolved(Finders& finders) const {
  const auto components = components_with_rest(finders);
  return std::all_of(components.begin(), components.end(), [&](Index c) { return is_tolerated_[c] != 0; });
}

std::vector<Index> SceneRepair::components_with_rest(Finders& finders) const {
  std::vector<Index> components;
  for (const IntersectingPair& pair : blocking_pairs(finders.as_is.find(scene_.x), ignored_))
    components.insert(components.end(), {component_of(pair.a), component_of(pair.b)});
  for (const Triangle& t : job_.prepared.triangulation.triangles)
    if (count_lost_areas(job_.prepared.rest, scene_.x, {&t, 1}) > 0)
      components.push_back(job_.diagnosis.components.component_of_vertex[t[0]]);
  sort_unique(components);
  return components;
}

bool SceneRepair::has_work(Finders& finders) const {
  if (ignored_.size() != pairs_.size()) return true;
  return job_.options.precision && !float32_conflicts(finders, scene_.x).empty();
}

void SceneRepair::work(Finders& finders) {
  const Rounds rounds = work_in_rounds(finders);
  if (rounds.resolved || !rounds.before_rounding || !may_give_up_float32()) return;
  float32_ = false;
  restore(*rounds.before_rounding);
  scene_.x = as_written(scene_.x);
}

SceneRepair::Rounds SceneRepair::work_in_rounds(Finders& finders) {
  Rounds result;
  SceneIndex index(scene_, finders.as_is);
  const std::vector<IntersectingPair> ignored = ignored_;
  std::vector<std::uint8_t> is_stuck(job_.diagnosis.components.count(), 0);
  for (int round = 0; round < rounding_rounds && !job_.limits.reached(); ++round) {
    job_.phases.start("untangle");
    EscalationOptions escalation = escalation_options();
    // Pairs that rounding brought separate only where they are given space for it; else there is float64.
    const bool may_fail = round > 0 && may_give_up_float32();
    if (round > 0) escalation.min_gap = [this](std::span<const Index> vertices) { return wanted_gap(vertices); };
    if (may_fail) escalation.tiers = local_tiers();
    EscalationResult pushed;
    if (job_.nested && round == 0) push_into_nesting(index, pushed);
    escalation.first_region += pushed.regions.size();
    EscalationResult untangled = untangle(index, ignored_, escalation);
    untangled.regions.insert(untangled.regions.begin(), pushed.regions.begin(), pushed.regions.end());
    untangled.moved.insert(untangled.moved.begin(), pushed.moved.begin(), pushed.moved.end());
    untangled.depths.insert(untangled.depths.begin(), pushed.depths.begin(), pushed.depths.end());
    if (may_fail && !untangled.left.empty()) break;
    if (job_.options.recover) {
      job_.phases.start("recover");
      report_progress(untangled_fraction, untangled.left);
      smallest_gap_ = std::min(
          smallest_gap_, recover(merge_overlapping(untangled.moved, scene_.vertex_count()), untangled.left, index));
    }
    measure_regions(untangled);
    job_.regions.insert(job_.regions.end(), untangled.regions.begin(), untangled.regions.end());
    moved_.insert(moved_.end(), untangled.moved.begin(), untangled.moved.end());
    job_.phases.start("certify");
    report_progress(recovered_fraction, untangled.left);
    job_.attempts.solved = scene_.x;
    result.before_rounding = checkpoint();
    if (may_give_up_float32() && !fits_float32(scene_.x, job_.prepared.scale)) break;
    scene_.x = as_written(scene_.x);
    // Components on which pairs are left are let be, and the others go on without them.
    for (const IntersectingPair& pair : untangled.left)
      is_stuck[component_of(pair.a)] = is_stuck[component_of(pair.b)] = 1;
    const auto goes_on = [&](const IntersectingPair& pair) {
      return !is_stuck[component_of(pair.a)] && !is_stuck[component_of(pair.b)];
    };
    if (!untangled.left.empty()) {
      std::vector<IntersectingPair> left = blocking_pairs(finders.as_is.find(scene_.x), ignored_);
      std::erase_if(left, goes_on);
      ignored_.insert(ignored_.end(), left.begin(), left.end());
      std::sort(ignored_.begin(), ignored_.end());
    }
    std::vector<IntersectingPair> conflicts = float32_conflicts(finders, scene_.x);
    std::erase_if(conflicts, std::not_fn(goes_on));
    result.resolved = conflicts.empty() && is_resolved(finders);
    if (result.resolved) break;
    const Positions rounded = rounded_to_float32(scene_.x, job_.prepared.scale);
    for (const IntersectingPair& pair : conflicts)
      for (Index t : {pair.a, pair.b})
        for (Index v : scene_.triangles[t])
          if (!scene_.fixed[v]) scene_.x.col(v) = rounded.col(v);
  }
  ignored_ = ignored;
  return result;
}

void SceneRepair::open_dihedrals(Finders& finders) {
  OpenDihedralsOptions options;
  options.least_radians = job_.options.min_dihedral_deg * std::numbers::pi / 180;
  options.most_motion = job_.options.max_displacement_rel * job_.diagonal;
  options.least_gap = job_.options.min_gap_rel * job_.diagonal;
  options.as_written = [this](const Positions& x) { return as_written(x); };
  options.pairs_at = [&](const Positions& x) {
    std::vector<IntersectingPair> pairs = finders.as_is.find(x);
    if (!float32_) return pairs;
    const std::vector<IntersectingPair> rounded = finders.find_rounded(x);
    pairs.insert(pairs.end(), rounded.begin(), rounded.end());
    sort_unique(pairs);
    return pairs;
  };
  options.stop = job_.limits.stopper();
  unsnarl::open_dihedrals(scene_, options);
}

EscalationOptions SceneRepair::escalation_options() {
  EscalationOptions escalation;
  escalation.tiers = default_tiers();
  escalation.left_out = job_.options.without_strategies;
  if (job_.nested) escalation.left_out.emplace_back("placement");  // it begins at rest, where the surfaces cross
  escalation.stop = job_.limits.stopper();
  escalation.recorder = &job_.recorder;
  escalation.first_region = job_.regions.size();
  escalation.attempts = &job_.attempts;
  if (job_.options.recover) escalation.recover = [this](Patch& patch) { recover(patch); };
  if (job_.options.max_displacement_rel > 0) escalation.accept = [this](Patch& patch) { return stays_near(patch); };
  escalation.on_progress = [this](const EscalationProgress& progress) {
    const double all = static_cast<double>(std::max<std::size_t>(1, pairs_.size()));
    report_progress(untangled_fraction * (1 - std::min(1.0, progress.work_left / all)), progress.left,
                    progress.pairs_now);
  };
  return escalation;
}

EscalationResult SceneRepair::untangle(SceneIndex& index, std::span<const IntersectingPair> ignored,
                                       const EscalationOptions& escalation) {
  return job_.options.paper ? untangle_whole(scene_, index, ignored, *job_.options.paper, escalation)
                            : escalate(scene_, index, ignored, escalation);
}

void SceneRepair::push_into_nesting(SceneIndex& index, EscalationResult& untangled) {
  const StageClock clock;
  const std::size_t pairs = index.find_pairs().size();
  const PushResult push = unsnarl::push_into_nesting(scene_, index, job_.diagnosis.components.component_of_vertex,
                                                     *job_.nested, job_.limits.stopper());
  if (push.moved.empty()) return;
  std::vector<Index> free = dilate(scene_, push.moved, recovery_rings);
  job_.recorder.begin_stage("untangle");
  job_.recorder.add(job_.recorder.new_trajectory(), "nesting", job_.regions.size(), free, scene_.x);
  RegionReport& region = untangled.regions.emplace_back();
  region.strategy = "nesting";
  std::vector<std::uint8_t> counted(scene_.triangles.size(), 0);
  for (const Index v : push.moved)
    for (const Index t : scene_.triangles_of_vertex[v]) region.faces += std::exchange(counted[t], 1) == 0;
  region.pairs = pairs - std::min(pairs, index.find_pairs().size());
  region.iterations = push.iterations;
  region.seconds = clock.stage("").seconds;
  untangled.depths.push_back((scene_.x - scene_.rest).colwise().norm().maxCoeff());
  untangled.moved.push_back(std::move(free));
}

void SceneRepair::measure_regions(EscalationResult& untangled) const {
  if (!(job_.diagonal > 0)) return;
  for (std::size_t k = 0; k < untangled.moved.size(); ++k) {
    RegionReport& region = untangled.regions[k];
    region.depth_rel = untangled.depths[k] / job_.diagonal;
    for (Index v : untangled.moved[k]) {
      const double displacement_rel = (scene_.x.col(v) - scene_.rest.col(v)).norm() / job_.diagonal;
      if (!(displacement_rel > region.displacement_rel)) continue;
      region.displacement_rel = displacement_rel;
      region.farthest_vertex = job_.prepared.weld_map.first[v];
    }
  }
}

double SceneRepair::recover(const std::vector<std::vector<Index>>& regions, std::span<const IntersectingPair> left,
                            SceneIndex& index) {
  RecoverRegionsOptions options;
  if (job_.options.paper) options.recover = RecoverOptions::paper();
  options.min_gap = [this](std::span<const Index> vertices) { return wanted_gap(vertices); };
  options.stop = job_.limits.stopper();
  options.on_progress = [&](double share) {
    report_progress(untangled_fraction + (recovered_fraction - untangled_fraction) * share, left);
  };
  return recover_regions(scene_, index, regions, options, job_.recorder);
}

void SceneRepair::recover(Patch& patch) const {
  RecoverOptions options;
  options.min_gap = wanted_gap({patch.vertices.data(), static_cast<std::size_t>(patch.free_count)});
  unsnarl::recover(patch, options, job_.limits.stopper());
}

void SceneRepair::report_progress(double fraction, std::span<const IntersectingPair> left,
                                  std::optional<double> pairs_now) {
  // Reports and summaries count faces. A scene of triangles along both diagonals knows no faces.
  std::size_t pairs_left = scene_.face_of.empty() ? left.size() : pairs_of_faces(scene_.face_of, left).size();
  if (pairs_now && !left.empty()) {
    const double share = std::max(0.0, *pairs_now) / static_cast<double>(left.size());
    pairs_left = static_cast<std::size_t>(std::lround(static_cast<double>(pairs_left) * share));
  }
  job_.phases.report(fraction, pairs_left, scene_.x, job_.prepared.rest, job_.diagonal);
}

// Precision.

bool SceneRepair::chooses_float32() const {
  const std::optional<Precision> wanted = job_.options.precision;
  if (wanted) return *wanted == Precision::float32 && fits_float32(scene_.rest, job_.prepared.scale);
  std::map<Index, std::vector<IntersectingPair>> of_group;
  for (const IntersectingPair& pair : pairs_)
    of_group[scene_.group_of.empty() ? 0 : component_of(pair.a)].push_back(pair);
  return std::all_of(of_group.begin(), of_group.end(),
                     [&](const auto& group) { return float32_can_hold(scene_, group.second, job_.prepared.scale); });
}

/// Absolute gap wanted between sheets around these vertices. Local, so that distant parts change nothing.
double SceneRepair::wanted_gap(std::span<const Index> vertices) const {
  return std::max(gap_of_format(scene_, vertices, float32_, job_.prepared.scale),
                  job_.options.min_gap_rel * job_.diagonal);
}

/// The state as it will be read back from the file.
Positions SceneRepair::as_written(const Positions& x) const {
  if (job_.options.as_written) {
    const PreparedSurface& prepared = job_.prepared;
    return prepared.gather(job_.options.as_written(prepared.scatter(job_.surface.positions, x), float32_));
  }
  // At another scale than the file's, double rounds too where it runs out of small numbers.
  if (!float32_ && job_.prepared.scale.is_one()) return x;
  std::vector<double> positions = job_.prepared.scatter(job_.surface.positions, x);
  if (float32_) round_changed_to_float32(job_.surface.positions, positions);
  return job_.prepared.gather(positions);
}

/// Pairs that exist only after rounding everything to float32, where float32 has to hold: everywhere if asked for, else
/// where something was repaired.
std::vector<IntersectingPair> SceneRepair::float32_conflicts(Finders& finders, const Positions& x) const {
  if (!float32_) return {};
  std::vector<IntersectingPair> conflicts = blocking_pairs(finders.find_rounded(x), ignored_);
  std::erase_if(conflicts, [&](const IntersectingPair& pair) {
    return !can_be_separated(pair) || (!job_.options.precision && !has_moved(pair.a, x) && !has_moved(pair.b, x));
  });
  return conflicts;
}

bool SceneRepair::has_moved(Index t, const Positions& x) const {
  const auto moved = [&](Index v) { return x.col(v) != scene_.rest.col(v); };
  return std::any_of(scene_.triangles[t].begin(), scene_.triangles[t].end(), moved);
}

bool SceneRepair::can_be_separated(const IntersectingPair& pair) const {
  const Index component = component_of(pair.a);
  if (component == component_of(pair.b) && job_.diagnosis.components.list[component].obstructed()) return false;
  const auto can_move = [&](Index t) {
    return std::any_of(scene_.triangles[t].begin(), scene_.triangles[t].end(),
                       [&](Index v) { return !scene_.fixed[v]; });
  };
  if (!can_move(pair.a) && !can_move(pair.b)) return false;
  return !fixed_parts_meet(scene_.rest, scene_.fixed, scene_.triangles[pair.a], scene_.triangles[pair.b]);
}

// The limit of displacement.

/// Is a patch that a strategy resolved within the limit, at least once it has recovered?
bool SceneRepair::stays_near(Patch& patch) {
  const double limit = job_.options.max_displacement_rel * job_.diagonal;
  const auto is_near = [&] {
    for (Index v = 0; v < patch.free_count; ++v)
      if ((patch.x.col(v) - job_.prepared.rest.col(patch.vertices[v])).norm() > limit) return false;
    return true;
  };
  if (is_near()) return true;
  if (job_.options.recover) {
    recover(patch);
    if (is_near()) return true;
  }
  displacement_is_exceeded_ = true;
  return false;
}

void SceneRepair::keep_within_displacement(IntersectionFinder& finder) {
  const double limit = job_.options.max_displacement_rel * job_.diagonal;
  if (limit <= 0) return;
  const Positions before = scene_.x;
  if (!restore_what_is_too_far(scene_, merge_overlapping(moved_, scene_.vertex_count()), limit, pairs_, finder)) return;
  displacement_is_exceeded_ = true;
  for (Index v = 0; v < scene_.vertex_count(); ++v)
    if (scene_.x.col(v) != before.col(v)) job_.attempts.is_too_far[v] = 1;
}

// Polygons.

void SceneRepair::take(const UnitedTriangulations& cuts) {
  Scene scene = make_scene(job_.prepared.rest, cuts.all.triangles, scene_.fixed);
  ignored_ = cuts.exclusive;
  scene.x = std::move(scene_.x);
  scene.group_of = std::move(scene_.group_of);
  scene_ = std::move(scene);
}

std::vector<IntersectingPair> SceneRepair::ignore_inseparable_pairs(Finders& finders) {
  std::vector<IntersectingPair> pairs = finders.as_is.find(scene_.x);
  const auto is_tolerated = [&](const IntersectingPair& pair) {
    return is_tolerated_[component_of(pair.a)] || is_tolerated_[component_of(pair.b)];
  };
  for (const IntersectingPair& pair : blocking_pairs(pairs, ignored_))
    if (is_tolerated(pair) || pair.kind == PairClass::duplicate || !can_be_separated(pair) ||
        (job_.options.goal == Goal::disjoint && pair.kind != PairClass::disjoint))
      ignored_.push_back(pair);
  std::sort(ignored_.begin(), ignored_.end());
  std::erase_if(pairs, is_tolerated);
  return pairs;
}

bool SceneRepair::tolerate_what_is_left(Finders& finders) {
  bool any = false;
  for (const Index c : components_with_rest(finders)) any |= std::exchange(is_tolerated_[c], std::uint8_t{1}) == 0;
  return any;
}

void SceneRepair::restore_to_rest(std::span<const Index> vertices) {
  for (const Index v : vertices) scene_.x.col(v) = scene_.rest.col(v);
}

void SceneRepair::restore(const Checkpoint& checkpoint) {
  scene_.x = checkpoint.x;
  job_.regions.resize(checkpoint.regions);
  job_.recorder.restore(checkpoint.recorded);
  smallest_gap_ = checkpoint.smallest_gap;
}

}  // namespace unsnarl
