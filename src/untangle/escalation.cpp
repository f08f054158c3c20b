#include "untangle/escalation.h"

#include <algorithm>
#include <chrono>
#include <functional>
#include <map>
#include <optional>
#include <set>

#include "contact/blocking_pairs.h"
#include "contact/intersection_finder.h"
#include "mesh/areas.h"
#include "recover/recover_options.h"
#include "scene/independent_batches.h"
#include "scene/patch_progress.h"
#include "scene/trajectory.h"
#include "untangle/conflict_regions.h"
#include "untangle/local_solver.h"
#include "untangle/placement.h"
#include "untangle/shared_constants.h"
#include "untangle/strategies.h"
#include "untangle/tangle_depth.h"

namespace unsnarl {
namespace {

/// The counts that the progress rule compares.
struct Pairs {
  std::size_t disjoint = 0, total = 0;

  explicit Pairs(std::span<const IntersectingPair> pairs)
      : disjoint(static_cast<std::size_t>(std::count_if(
            pairs.begin(), pairs.end(), [](const auto& pair) { return pair.kind == PairClass::disjoint; }))),
        total(pairs.size()) {}
  bool fell_from(const Pairs& before) const { return total < before.total && disjoint <= before.disjoint; }
  bool is_below(double share, const Pairs& before) const {
    return static_cast<double>(total) < share * static_cast<double>(before.total);
  }
};

/// A region that a strategy is tried on, and its candidate.
struct Attempt {
  ConflictRegion region;
  std::vector<Index> free;
  double edge_length = 0;
  int depth = 0;     // edges, where the strategy asks for it
  double bound = 0;  // of the motion: a candidate beyond waits for a nearer one
  double reach = 0;  // how far around the patch obstacles are taken in
  Patch patch;
  Positions start;
  Trajectory trajectory;
  int iterations = 0;
  double seconds = 0;
  Pairs before{{}}, left{{}};
  bool is_sound = false;     // no face is squeezed
  bool is_rejected = false;  // without pairs, but not accepted
  double distance = 0;       // of the vertices to rest after recovery, summed, where that is known

  bool is_clean() const { return is_sound && left.total == 0; }
  std::size_t resolved() const { return before.total - left.total; }
  double motion() const {
    return std::sqrt((patch.x - start).leftCols(patch.free_count).colwise().squaredNorm().maxCoeff());
  }
};

class Escalation {
 public:
  Escalation(Scene& scene, SceneIndex& index, std::span<const IntersectingPair> ignored,
             const EscalationOptions& options)
      : scene_(scene), index_(index), ignored_(ignored), options_(options), level_(scene.vertex_count(), 0) {
    for (const Tier& tier : options.tiers) {
      const Index first = last();
      for (const Strategy& strategy : tier) {
        if (std::find(options.left_out.begin(), options.left_out.end(), strategy.name) != options.left_out.end())
          continue;
        if (!strategy.is_last_resort && longest_wait_ == last() - 1) ++longest_wait_;
        levels_.push_back({&strategy, false});
      }
      if (last() > first) levels_.back().ends_tier = true;
    }
  }

  EscalationResult run() {
    find_pairs();
    initial_pairs_ = pairs_;
    while (!pairs_.empty() && !stopped()) {
      const Index level = escalate_lowest();
      if (level == last()) break;
      try_strategy(level);
      if (levels_[level].ends_tier) keep_best_candidates(level, few_enough_to_keep);
      if (level >= longest_wait_) keep_waiting(level);
      find_pairs();
    }
    keep_waiting(-1);
    if (!stopped()) keep_best_candidates(last() - 1, 1);
    find_pairs();
    note_what_is_left();
    return std::move(result_);
  }

 private:
  struct Candidate {
    Attempt attempt;
    Index level;
  };
  struct Level {
    const Strategy* strategy;
    bool ends_tier;
  };
  Index last() const { return static_cast<Index>(levels_.size()); }
  bool stopped() const { return options_.stop && options_.stop(); }

  void find_pairs() {
    pairs_ = blocking_pairs(index_.find_pairs(), ignored_);
    report();
  }

  void report() const {
    if (!options_.on_progress) return;
    const double pairs = static_cast<double>(pairs_.size());
    EscalationProgress progress{pairs_, pairs, pairs};
    for (const PatchProgress& candidate : candidates_) {
      const double before = static_cast<double>(candidate.pairs_before);
      progress.pairs_now -= before - static_cast<double>(candidate.pairs.load());
      progress.work_left -= before * candidate.done;
    }
    options_.on_progress(progress);
  }

  Index level_of(const ConflictRegion& region) const {
    Index level = 0;
    for (Index v : region.core) level = std::max(level, level_[v]);
    return level;
  }

  /// The lowest level of any region: what is tried now. The regions there will go on with the next one, unless
  /// something of the candidates is kept.
  Index escalate_lowest() {
    const std::vector<ConflictRegion> regions = conflict_regions(scene_, pairs_);
    Index lowest = last();
    for (const ConflictRegion& region : regions) lowest = std::min(lowest, level_of(region));
    is_tried_.assign(scene_.vertex_count(), 0);
    for (const ConflictRegion& region : regions) {
      if (level_of(region) != lowest) continue;
      for (Index v : region.core) {
        level_[v] = std::min(lowest + 1, last());
        is_tried_[v] = 1;
      }
    }
    return lowest;
  }

  void try_strategy(Index level) {
    const Strategy& strategy = *levels_[level].strategy;
    if (options_.recorder) options_.recorder->begin_stage("untangle");
    std::vector<Attempt> attempts = gather_attempts(strategy);
    note_attempts(attempts, strategy);
    index_.update();
    std::vector<Attempt> far;
    candidates_ = std::vector<PatchProgress>(attempts.size());
    for (std::size_t i = 0; i < attempts.size(); ++i) candidates_[i].begin(attempts[i].region.pairs.size());
    run_in_batches(
        boxes_of(attempts), [&](std::size_t i) { run(attempts[i], strategy, candidates_[i]); },
        [&](std::size_t i) {
          const std::size_t kept = result_.regions.size();
          const std::size_t left = attempts[i].left.total;
          if (!judge(attempts[i], strategy, level)) far.push_back(std::move(attempts[i]));
          const bool is_kept = result_.regions.size() > kept;
          candidates_[i].set_pairs(is_kept ? left : candidates_[i].pairs_before);
        });
    run_in_batches(
        boxes_of(far), [&](std::size_t i) { look_farther(far[i]); },
        [&](std::size_t i) { judge_far(far[i], strategy, level); });
    candidates_.clear();
  }

  std::vector<Box> boxes_of(const std::vector<Attempt>& attempts) const {
    std::vector<Box> boxes;
    for (const Attempt& attempt : attempts) boxes.push_back(patch_box(scene_, attempt.free, 2 * attempt.reach));
    return boxes;
  }

  /// The regions that are tried now, each with its free vertices; one whose free vertices reach another's core takes it
  /// in.
  std::vector<Attempt> gather_attempts(const Strategy& strategy) {
    const std::vector<ConflictRegion> regions = conflict_regions(scene_, pairs_, strategy.most_valence);
    std::vector<Index> region_of_core(scene_.vertex_count(), -1);
    for (std::size_t r = 0; r < regions.size(); ++r)
      for (Index v : regions[r].core) region_of_core[v] = static_cast<Index>(r);
    std::vector<std::uint8_t> is_taken(regions.size(), 0);
    std::vector<Attempt> attempts;
    for (std::size_t r = 0; r < regions.size(); ++r) {
      const auto is_tried = [&](Index v) { return is_tried_[v] != 0; };
      if (is_taken[r] || !std::any_of(regions[r].core.begin(), regions[r].core.end(), is_tried)) continue;
      Attempt attempt;
      ConflictRegion& region = attempt.region = regions[r];
      if (strategy.extent == Extent::whole_components && was_rejected(region)) continue;
      if (strategy.least_depth > 0) attempt.depth = depth_of(region, strategy.least_depth);
      if (strategy.depth_factor > 1)
        attempt.depth = strategy.depth_factor * std::max(attempt.depth, strategy.least_depth);
      if (attempt.depth < strategy.least_depth) continue;
      std::vector<std::size_t> taken = {r};
      is_taken[r] = 1;
      for (bool has_grown = true; has_grown;) {
        has_grown = false;
        attempt.free = free_vertices(strategy, region, attempt.depth);
        for (Index v : attempt.free) {
          const Index other = region_of_core[v];
          if (other < 0 || is_taken[other]) continue;
          is_taken[other] = 1;
          taken.push_back(static_cast<std::size_t>(other));
          has_grown = true;
          region.core.insert(region.core.end(), regions[other].core.begin(), regions[other].core.end());
          region.pairs.insert(region.pairs.end(), regions[other].pairs.begin(), regions[other].pairs.end());
        }
        std::sort(region.core.begin(), region.core.end());
        std::sort(region.pairs.begin(), region.pairs.end());
      }
      const bool is_too_large =
          strategy.leaves_most && 2 * attempt.free.size() >= free_vertices_of_parts(region.core).size();
      if (attempt.free.empty() || is_too_large) {
        for (const std::size_t other : taken) is_taken[other] = other == r;  // one alone may be small enough
        continue;
      }
      std::vector<Triangle> core_faces;
      for (const IntersectingPair& pair : region.pairs)
        for (Index t : {pair.a, pair.b}) core_faces.push_back(scene_.triangles[t]);
      attempt.edge_length = mean_equilateral_side(scene_.rest, core_faces);
      attempt.bound = strategy.reach * attempt.edge_length;
      if (strategy.extent == Extent::depth) attempt.bound *= attempt.depth;
      attempt.reach = attempt.bound;
      attempts.push_back(std::move(attempt));
    }
    return attempts;
  }

  std::vector<Index> free_vertices(const Strategy& strategy, const ConflictRegion& region, int depth) {
    switch (strategy.extent) {
      case Extent::rings: return dilate(scene_, region.core, strategy.rings, strategy.most_valence);
      case Extent::depth:
        return dilate(scene_, region.core, static_cast<int>(strategy.rings_per_depth * depth), strategy.most_valence);
      case Extent::tied_components: return vertices_of_tied_components(scene_, parts(), region, initial_pairs_);
      case Extent::whole_components: return free_vertices_of_parts(region.core);
    }
    return {};
  }

  /// Returns the free vertices of all components that have one of `vertices`, ascending.
  std::vector<Index> free_vertices_of_parts(std::span<const Index> vertices) {
    const std::vector<Index>& part_of = parts().of_vertex;
    std::vector<std::uint8_t> is_wanted(static_cast<std::size_t>(parts().count), 0);
    for (Index v : vertices) is_wanted[part_of[v]] = 1;
    std::vector<Index> free;
    for (Index v = 0; v < scene_.vertex_count(); ++v)
      if (!scene_.fixed[v] && part_of[v] >= 0 && is_wanted[part_of[v]]) free.push_back(v);
    return free;
  }

  const ConnectedParts& parts() {
    if (!parts_) parts_.emplace(scene_);
    return *parts_;
  }

  /// 0 where it cannot be so deep as `least`.
  int depth_of(const ConflictRegion& region, int least) {
    if (region.core.size() / 2 < static_cast<std::size_t>(least)) return 0;
    return tangle_depth(scene_, parts(), region.core);
  }

  /// A part of it was resolved in a way that was not accepted; the whole will hardly be.
  bool was_rejected(const ConflictRegion& region) const {
    return std::any_of(region.core.begin(), region.core.end(), [&](Index v) { return rejected_.count(v) > 0; });
  }

  void run(Attempt& attempt, const Strategy& strategy, PatchProgress& progress) const {
    if (stopped()) return;
    const auto begin = std::chrono::steady_clock::now();
    Patch& patch = attempt.patch = cut_patch(scene_, index_, attempt.free, attempt.reach);
    patch.edge_length = attempt.edge_length;
    attempt.start = patch.x;
    if (options_.recorder && options_.recorder->is_on()) {
      attempt.trajectory = options_.recorder->new_trajectory();
      patch.trajectory = &attempt.trajectory;
    }
    IntersectionFinder finder(patch.triangles, patch.active_count);
    std::vector<IntersectingPair> own, tolerated;
    for (const IntersectingPair& pair : finder.find(patch.x))
      (is_of_region(patch, attempt.region, pair) ? own : tolerated).push_back(pair);
    attempt.before = Pairs(own);
    patch.progress = &progress;
    Task task{.tolerated = tolerated, .depth = attempt.depth, .left_out = options_.left_out, .stop = ask_};
    if (!options_.accept && !own.empty())
      task.few_enough = static_cast<std::size_t>(few_left * static_cast<double>(own.size() - 1));
    if (options_.min_gap) task.min_gap = options_.min_gap(attempt.free);
    attempt.iterations += strategy.solve(patch, task);
    attempt.left = Pairs(blocking_pairs(finder.find(patch.x), tolerated));
    attempt.is_sound = patch.x.allFinite() && !has_squeezed_face(patch, attempt.start, patch.x, strategy.area_floor);
    attempt.is_rejected = attempt.is_clean() && options_.accept && !options_.accept(patch);
    patch.trajectory = nullptr;
    patch.progress = nullptr;
    attempt.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }

  /// Puts a candidate among the obstacles that are within its reach now. Returns the pairs that it tolerates there.
  std::vector<IntersectingPair> put_among_obstacles(Attempt& attempt) const {
    Patch patch = cut_patch(scene_, index_, attempt.free, attempt.reach);
    patch.edge_length = attempt.edge_length;
    IntersectionFinder finder(patch.triangles, patch.active_count);
    std::vector<IntersectingPair> tolerated;
    for (const IntersectingPair& pair : finder.find(patch.x))
      if (!is_of_region(patch, attempt.region, pair)) tolerated.push_back(pair);
    attempt.start = patch.x;
    patch.x.leftCols(patch.free_count) = attempt.patch.x.leftCols(patch.free_count);
    attempt.patch = std::move(patch);
    attempt.left = Pairs(blocking_pairs(finder.find(attempt.patch.x), tolerated));
    return tolerated;
  }

  /// Puts a candidate among the obstacles within its reach, and recovers it there.
  void look_farther(Attempt& attempt) const {
    const auto begin = std::chrono::steady_clock::now();
    const std::vector<IntersectingPair> tolerated = put_among_obstacles(attempt);
    if (attempt.is_clean() && options_.recover) {
      options_.recover(attempt.patch);
      IntersectionFinder finder(attempt.patch.triangles, attempt.patch.active_count);
      attempt.left = Pairs(blocking_pairs(finder.find(attempt.patch.x), tolerated));
    }
    attempt.distance = distances_to_rest(attempt.patch).sum();
    attempt.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }

  /// Column k: of free vertex k.
  static Eigen::RowVectorXd distances_to_rest(const Patch& patch) {
    return (patch.x - patch.rest).leftCols(patch.free_count).colwise().norm();
  }

  /// Pairs of active triangles that are not the region's belong to other regions or are tolerated.
  static bool is_of_region(const Patch& patch, const ConflictRegion& region, const IntersectingPair& pair) {
    const auto [a, b] = std::minmax(patch.faces[pair.a], patch.faces[pair.b]);
    return std::binary_search(region.pairs.begin(), region.pairs.end(), IntersectingPair{a, b, pair.kind});
  }

  /// The progress rule: keeps the candidate, remembers it, or forgets it. False: it went far, or another one of its
  /// region did, and that is to be compared.
  bool judge(Attempt& attempt, const Strategy& strategy, Index level) {
    if (!attempt.is_sound || !attempt.left.fell_from(attempt.before)) return true;
    if (attempt.is_rejected) {
      rejected_.insert(attempt.region.core.begin(), attempt.region.core.end());
      if (options_.attempts)
        for (Index v : attempt.region.core) options_.attempts->is_too_far[v] = 1;
      return true;
    }
    if (options_.accept && !attempt.is_clean()) return true;
    const double motion = attempt.motion();
    if (motion > attempt.reach || waiting_for(attempt.region)) {
      attempt.reach = std::max(attempt.reach, 2 * motion);
      return false;
    }
    keep_or_remember(attempt, strategy, level);
    return true;
  }

  void judge_far(Attempt& attempt, const Strategy& strategy, Index level) {
    if (!attempt.left.fell_from(attempt.before)) return;
    Candidate* const waiting = waiting_for(attempt.region);
    if (waiting && (!attempt.is_clean() || attempt.distance >= waiting->attempt.distance)) return;
    if (distances_to_rest(attempt.patch).maxCoeff() <= attempt.bound)
      keep_or_remember(attempt, strategy, level);
    else if (!attempt.is_clean())
      return;  // what it leaves would have to be resolved from far away
    else if (waiting)
      *waiting = {std::move(attempt), level};
    else
      waiting_.push_back({std::move(attempt), level});
  }

  void keep_or_remember(Attempt& attempt, const Strategy& strategy, Index level) {
    if (!attempt.is_clean()) attempt.trajectory.end_at_fewest_pairs();
    if (attempt.is_clean() || attempt.left.is_below(few_left, attempt.before)) {
      keep(attempt, strategy);
    } else {
      // A region that has taken in another one may have its first vertex: pairs left do not compare, those resolved do.
      const Index key = attempt.region.core.front();
      const auto known = best_.find(key);
      if (known == best_.end() || !is_current(known->second.attempt) ||
          attempt.resolved() > known->second.attempt.resolved())
        best_.insert_or_assign(key, Candidate{std::move(attempt), level});
    }
  }

  /// The candidate of this region that waits; none: null.
  Candidate* waiting_for(const ConflictRegion& region) {
    const auto found = std::find_if(waiting_.begin(), waiting_.end(), [&](const Candidate& waiting) {
      return waiting.attempt.region.core == region.core && is_current(waiting.attempt);
    });
    return found == waiting_.end() ? nullptr : &*found;
  }

  /// Keeps the candidates that wait, the nearest first, of regions that have been through the strategies up to this
  /// level.
  void keep_waiting(Index level) {
    const auto is_due = [&](const Candidate& waiting) { return level_of(waiting.attempt.region) > level; };
    const auto due = std::stable_partition(waiting_.begin(), waiting_.end(), std::not_fn(is_due));
    std::stable_sort(due, waiting_.end(),
                     [](const Candidate& a, const Candidate& b) { return a.attempt.distance < b.attempt.distance; });
    for (auto waiting = due; waiting != waiting_.end(); ++waiting)
      if (still_holds(waiting->attempt)) keep(waiting->attempt, *levels_[waiting->level].strategy);
    waiting_.erase(due, waiting_.end());
  }

  /// Nothing has moved there since the candidate was made.
  bool is_current(const Attempt& attempt) const {
    for (std::size_t k = 0; k < attempt.free.size(); ++k)
      if (scene_.x.col(attempt.free[k]) != attempt.start.col(k)) return false;
    return true;
  }

  /// Other regions may have moved around a candidate since it was made: it counts as what it is among them.
  bool still_holds(Attempt& attempt) const {
    if (!is_current(attempt)) return false;
    put_among_obstacles(attempt);
    return attempt.left.fell_from(attempt.before);
  }

  /// Keeps the best candidates of regions that have been through the strategies up to this level, where they leave less
  /// than this share of the pairs.
  void keep_best_candidates(Index level, double share) {
    for (auto it = best_.begin(); it != best_.end();) {
      Candidate& best = it->second;
      const bool is_due = level_of(best.attempt.region) > level;
      const bool is_worth_while = is_due && best.attempt.left.is_below(share, best.attempt.before);
      if (!is_worth_while && is_current(best.attempt)) {
        ++it;
        continue;
      }
      if (is_worth_while && still_holds(best.attempt)) keep(best.attempt, *levels_[best.level].strategy);
      it = best_.erase(it);
    }
  }

  /// The rest of the region begins with the first strategy.
  void keep(Attempt& attempt, const Strategy& strategy) {
    result_.depths.push_back(distances_to_rest(attempt.patch).maxCoeff());
    paste_patch(attempt.patch, scene_, index_);
    for (Index v : attempt.free) level_[v] = 0;
    for (Index v : attempt.region.core) level_[v] = 0;  // some are fixed
    RegionReport report;
    report.strategy = strategy.name;
    report.faces = static_cast<std::size_t>(attempt.patch.active_count);
    report.pairs = attempt.before.total - attempt.left.total;
    report.iterations = attempt.iterations;
    report.seconds = attempt.seconds;
    if (options_.recorder)
      options_.recorder->add(std::move(attempt.trajectory), strategy.name,
                             options_.first_region + result_.regions.size(), attempt.free, scene_.x);
    result_.regions.push_back(std::move(report));
    result_.moved.push_back(strategy.extent == Extent::depth ? moved_surroundings(attempt) : std::move(attempt.free));
  }

  /// The vertices that have moved and a few rings around them.
  std::vector<Index> moved_surroundings(const Attempt& attempt) const {
    std::vector<Index> moved;
    for (std::size_t k = 0; k < attempt.free.size(); ++k)
      if (attempt.patch.x.col(k) != attempt.start.col(k)) moved.push_back(attempt.free[k]);
    return dilate(scene_, moved, recovery_rings);
  }

  void note_attempts(const std::vector<Attempt>& attempts, const Strategy& strategy) {
    if (!options_.attempts) return;
    const auto number = static_cast<std::int8_t>(strategy_number(strategy.name));
    for (const Attempt& attempt : attempts)
      for (Index v : attempt.region.core)
        options_.attempts->strategy[v] = std::max(options_.attempts->strategy[v], number);
  }

  void note_what_is_left() {
    if (options_.attempts && stopped())
      for (const IntersectingPair& pair : pairs_)
        for (Index t : {pair.a, pair.b})
          for (Index v : scene_.triangles[t]) options_.attempts->is_cut_short[v] = 1;
    for (const ConflictRegion& region : conflict_regions(scene_, pairs_)) {
      RegionReport unresolved;
      unresolved.strategy = "none";
      unresolved.pairs = region.pairs.size();
      result_.regions.push_back(unresolved);
    }
    result_.left = pairs_;
  }

  Scene& scene_;
  SceneIndex& index_;
  std::span<const IntersectingPair> ignored_;
  const EscalationOptions& options_;
  std::vector<Level> levels_;
  std::vector<IntersectingPair> pairs_, initial_pairs_;
  std::vector<Index> level_;               // per vertex: the strategy that its conflict is to be tried on next
  std::vector<PatchProgress> candidates_;  // of the regions that are tried now
  const std::function<void()> report_ = [this] { report(); };
  ProgressReporter reporter_{report_, options_.stop};
  const std::function<bool()> ask_ = [this] { return reporter_.asked(); };
  std::vector<std::uint8_t> is_tried_;   // per vertex: in the core of a region that is tried now
  std::map<Index, Candidate> best_;      // by the first vertex of the region's core
  std::vector<Candidate> waiting_;       // clean ones that went far
  Index longest_wait_ = -1;              // the last level before the last resorts
  std::optional<ConnectedParts> parts_;  // made when first asked for
  std::set<Index> rejected_;             // vertices of regions that were resolved in a way that was not accepted
  EscalationResult result_;
};

}  // namespace

EscalationResult escalate(Scene& scene, SceneIndex& index, std::span<const IntersectingPair> ignored,
                          const EscalationOptions& options) {
  return Escalation(scene, index, ignored, options).run();
}

}  // namespace unsnarl
