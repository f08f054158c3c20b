#include "untangle/ladder.h"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <optional>
#include <set>

#include "contact/intersection_finder.h"
#include "mesh/areas.h"
#include "mesh/union_find.h"
#include "scene/independent_batches.h"
#include "scene/patch.h"
#include "scene/trajectory.h"
#include "untangle/coarse_to_fine.h"
#include "untangle/conflict_regions.h"
#include "untangle/flow.h"
#include "untangle/local_solver.h"
#include "untangle/strategies.h"
#include "untangle/tangle_depth.h"

namespace unsnarl {
namespace {

/// Obstacles are taken in this many h around a region; regions that move farther are tried again with more. (Checking
/// afterwards whether they met any of those left out is not enough: they may have passed through them.)
constexpr double local_reach = 4;    // of 254 regions that local strategies resolved, 6 moved farther
constexpr double coarse_reach = 10;  // hardly any moves farther than the tangle is deep
constexpr double flow_reach = 20;    // of 4 that flows did, 2 moved by 16 h

/// The ladder is climbed again where it has left at most this share of the pairs.
constexpr double worth_climbing_again = 0.7;
/// Share of the pairs of a large region that a strategy may leave to be done with it. What a coarser mesh leaves is
/// shallow, but much: a body of 428k faces took eight times as long where 503 pairs left of 3720 were too many.
constexpr double large_gain = 0.1, large_gain_of_coarser_mesh = 1.0 / 3;
constexpr std::size_t large = 100;  // pairs

/// Freed around regions that go by a coarser mesh. Of 0.7, 1 and 1.5 the closest on three bodies.
constexpr double rings_per_depth = 1.5;

class Climb {
 public:
  Climb(Scene& scene, SceneIndex& index, std::span<const IntersectingPair> ignored, const LadderOptions& options)
      : scene_(scene), index_(index), ignored_(ignored), options_(options) {}

  LadderResult run() {
    const Positions rest = scene_.rest;
    pairs_ = current_pairs();
    const bool climbs_all = options_.strategies == LadderOptions::Strategies::all ||
                            options_.strategies == LadderOptions::Strategies::of_coarser_mesh;
    if (climbs_all) {
      if (options_.strategies == LadderOptions::Strategies::all) climb(coarser_first());
    }
    climb(options_.strategies == LadderOptions::Strategies::second_way ? second_way_strategies() : gentle_strategies());
    if (climbs_all) {
      for (Index group : find_stuck_groups()) {
        group_ = group;
        climb_apart();
      }
      group_ = everything;
      pairs_ = current_pairs();
    }
    scene_.rest = rest;
    if (options_.tried && stopped())
      for (const IntersectingPair& pair : pairs_)
        for (Index t : {pair.a, pair.b})
          for (Index v : scene_.triangles[t]) options_.tried->is_cut_short[v] = 1;
    for (const ConflictRegion& region : conflict_regions(scene_, pairs_)) {
      RegionReport unresolved;
      unresolved.strategy = "none";
      unresolved.pairs = region.pairs.size();
      result_.regions.push_back(unresolved);
    }
    result_.left = pairs_;
    return std::move(result_);
  }

 private:
  /// Where a strategy that failed had the fewest pairs.
  struct Gain {
    std::vector<Index> vertices;
    Positions start, x;
    std::size_t pairs = 0, pairs_left = 0;
    RegionReport report;
    Trajectory trajectory;
  };

  struct State {
    Positions rest, x;
    std::vector<IntersectingPair> pairs;
    std::vector<Gain> gains;
    std::vector<RegionReport> regions;
    std::vector<std::vector<Index>> moved;
    Recorder::Stages recorded;
  };
  State state() const {
    return {scene_.rest,
            scene_.x,
            pairs_,
            gains_,
            result_.regions,
            result_.moved,
            options_.recorder ? options_.recorder->stages() : Recorder::Stages()};
  }
  void restore(State state) {
    scene_.rest = std::move(state.rest);
    scene_.x = std::move(state.x);
    pairs_ = std::move(state.pairs);
    gains_ = std::move(state.gains);
    result_.regions = std::move(state.regions);
    result_.moved = std::move(state.moved);
    if (options_.recorder) options_.recorder->restore(state.recorded);
  }

  /// A strategy that left a few of many pairs leaves them to gentle ones, before whole components are moved for them:
  /// of 169 pairs on 414k faces 5 were left, which a flow of all made 280 in 72 s.
  void climb_wild() {
    const bool is_coarser_mesh = options_.strategies == LadderOptions::Strategies::of_coarser_mesh;
    const std::span<const Strategy> strategies =
        is_coarser_mesh ? wild_strategies_of_coarser_mesh() : wild_strategies();
    for (bool again = true; again;) {
      const std::size_t before = large_gains_;
      climb(strategies);
      again = large_gains_ > before && !pairs_.empty() && !stopped();
      if (again) climb(gentle_strategies());
    }
    if (!is_coarser_mesh) climb(whole_component_strategies());
  }

  bool stopped() const { return options_.stop && options_.stop(); }

  /// Of the group that climbs now.
  std::vector<IntersectingPair> current_pairs() {
    auto pairs = blocking_pairs(index_.find_pairs(), ignored_);
    if (options_.on_progress) options_.on_progress(pairs.size());
    std::erase_if(pairs, [&](const IntersectingPair& pair) { return !is_in_group(pair.a) && !is_in_group(pair.b); });
    return pairs;
  }
  bool is_in_group(Index triangle) const {
    return group_ == everything || group_of_vertex_[scene_.triangles[triangle][0]] == group_;
  }

  /// Components, with those that the pairs there are tie together taken as one: what is decided for one of these groups
  /// does not depend on the others.
  std::vector<Index> find_stuck_groups() {
    if (pairs_.empty()) return {};
    UnionFind sets = vertices_joined_by(scene_.triangles, scene_.vertex_count());
    for (const IntersectingPair& pair : pairs_) sets.unite(scene_.triangles[pair.a][0], scene_.triangles[pair.b][0]);
    group_of_vertex_ = sets.dense_ids();
    std::vector<Index> groups;
    for (const IntersectingPair& pair : pairs_) groups.push_back(group_of_vertex_[scene_.triangles[pair.a][0]]);
    std::sort(groups.begin(), groups.end());
    groups.erase(std::unique(groups.begin(), groups.end()), groups.end());
    return groups;
  }

  /// The group, of which gentle strategies have left pairs, by itself.
  void climb_apart() {
    pairs_ = current_pairs();
    if (pairs_.empty() || stopped()) return;
    std::vector<Gain> gains_of_others;
    const auto others = std::stable_partition(gains_.begin(), gains_.end(), [&](const Gain& gain) {
      return group_of_vertex_[gain.vertices.front()] == group_;
    });
    std::move(others, gains_.end(), std::back_inserter(gains_of_others));
    gains_.erase(others, gains_.end());

    // Gently, again from where that has got to, as long as it takes away pairs.
    const State first = state();
    while (!pairs_.empty() && take_gains() && !stopped()) climb(gentle_strategies());
    if (pairs_.size() > options_.good_enough && !stopped()) {
      // Wild strategies do better from farther back than from where gentle ones got stuck.
      State gentle = state();
      restore(first);
      climb_wild();
      while (!pairs_.empty() && take_gains() && !stopped()) {
        climb(gentle_strategies());
        climb_wild();
      }
      if (gentle.pairs.size() < pairs_.size()) restore(std::move(gentle));
    }
    gains_ = std::move(gains_of_others);
  }

  /// A region about to be tried on a strategy.
  struct Attempt {
    ConflictRegion region;
    std::vector<Index> free;
    double edge_length = 0;
    int depth = 0;     // in edges, where the strategy asks for it
    double reach = 0;  // how far around the patch obstacles are taken in
    Patch patch;
    Positions start;
    Trajectory trajectory;
    int iterations = 0;
    double seconds = 0;
    bool clean = false;
    std::size_t pairs_left = not_counted;
    bool rejected = false;  // clean, but not accepted
  };

  /// A strategy that fails a region of many pairs but takes away most of them has done its part: the few that are left,
  /// in regions of their own, climb on from there. (8807 pairs of two spheres: 8 left after 104 shallow iterations,
  /// none after 24 more.)
  bool is_large_gain(const Attempt& attempt, const Strategy& strategy) const {
    const std::size_t enough = few_enough(attempt, strategy);
    return enough > 0 && attempt.pairs_left <= enough;
  }
  /// Pairs left that make a large gain; 0: there is none.
  std::size_t few_enough(const Attempt& attempt, const Strategy& strategy) const {
    if (options_.accept || (attempt.region.pairs.size() < large && !strategy.is_on_coarser_mesh())) return 0;
    const double share = strategy.is_on_coarser_mesh() ? large_gain_of_coarser_mesh : large_gain;
    return static_cast<std::size_t>(share * static_cast<double>(attempt.region.pairs.size()));
  }

  void keep_gain(Attempt& attempt, const Strategy& strategy) {
    if (options_.accept || attempt.pairs_left >= attempt.region.pairs.size()) return;
    const Index n = attempt.patch.free_count;
    const RegionReport report = report_of(attempt, strategy);
    gains_.push_back({std::move(attempt.free), attempt.start.leftCols(n), attempt.patch.x.leftCols(n),
                      attempt.region.pairs.size(), attempt.pairs_left, report, std::move(attempt.trajectory)});
    gains_.back().trajectory.end_at_fewest_pairs();
  }

  /// Moves the regions that no strategy resolved to the states with the fewest pairs, which become the rest positions
  /// to climb again from: fewer pairs make smaller regions. False where that is not worth while.
  bool take_gains() {
    std::stable_sort(gains_.begin(), gains_.end(),
                     [](const Gain& a, const Gain& b) { return a.pairs - a.pairs_left > b.pairs - b.pairs_left; });
    const Positions before = scene_.x;
    std::vector<std::vector<Index>> moved;
    std::vector<RegionReport> reports;
    std::vector<Trajectory> trajectories;
    std::vector<std::uint8_t> is_taken(scene_.vertex_count(), 0);
    for (Gain& gain : gains_) {
      bool is_current = true;
      for (std::size_t k = 0; k < gain.vertices.size() && is_current; ++k)
        is_current = !is_taken[gain.vertices[k]] && scene_.x.col(gain.vertices[k]) == gain.start.col(k);
      if (!is_current) continue;
      for (std::size_t k = 0; k < gain.vertices.size(); ++k) {
        scene_.x.col(gain.vertices[k]) = gain.x.col(k);
        is_taken[gain.vertices[k]] = 1;
      }
      moved.push_back(std::move(gain.vertices));
      reports.push_back(std::move(gain.report));
      trajectories.push_back(std::move(gain.trajectory));
    }
    if (moved.empty()) return false;
    gains_.clear();
    const std::size_t count_before = pairs_.size();
    std::vector<IntersectingPair> pairs = current_pairs();
    const auto disjoint = [](const auto& all) {
      return std::count_if(all.begin(), all.end(), [](const auto& p) { return p.kind == PairClass::disjoint; });
    };
    if (pairs.size() >= count_before || disjoint(pairs) > disjoint(pairs_)) {
      scene_.x = before;
      return false;
    }
    pairs_ = std::move(pairs);
    if (options_.recorder) {
      options_.recorder->begin_stage("untangle");
      for (std::size_t k = 0; k < moved.size(); ++k)
        options_.recorder->add(std::move(trajectories[k]), reports[k].strategy,
                               options_.first_region + result_.regions.size() + k, moved[k], scene_.x);
    }
    for (const std::vector<Index>& vertices : moved) start_anew(vertices);
    std::move(moved.begin(), moved.end(), std::back_inserter(result_.moved));
    std::move(reports.begin(), reports.end(), std::back_inserter(result_.regions));
    return static_cast<double>(pairs_.size()) <= worth_climbing_again * static_cast<double>(count_before);
  }

  /// Where they are now counts as rest position in what follows.
  void start_anew(const std::vector<Index>& vertices) {
    for (Index v : vertices) scene_.rest.col(v) = scene_.x.col(v);
  }

  void climb(std::span<const Strategy> strategies) {
    for (const Strategy& strategy : strategies) {
      if (pairs_.empty() || stopped()) return;
      climb_one(strategy);
      pairs_ = current_pairs();
    }
  }

  void climb_one(const Strategy& strategy) {
    if (options_.recorder) options_.recorder->begin_stage("untangle");
    std::vector<Attempt> attempts = gather_attempts(strategy);
    note_tried(attempts, strategy);
    index_.update();
    // A second round for those that moved farther than their obstacles reach.
    for (int round = 0; round < 3 && !attempts.empty() && !stopped(); ++round) {
      std::vector<Box> boxes;
      for (const Attempt& attempt : attempts) boxes.push_back(patch_box(scene_, attempt.free, 2 * attempt.reach));
      std::vector<Attempt> again;
      run_in_batches(
          boxes, [&](std::size_t i) { run(attempts[i], strategy); },
          [&](std::size_t i) {
            Attempt& attempt = attempts[i];
            if (attempt.rejected) {
              rejected_.insert(attempt.region.core.begin(), attempt.region.core.end());
              if (options_.tried)
                for (Index v : attempt.region.core) options_.tried->is_too_far[v] = 1;
              return;
            }
            if (!attempt.clean && !is_large_gain(attempt, strategy)) return keep_gain(attempt, strategy);
            const double moved =
                (attempt.patch.x - attempt.start).leftCols(attempt.patch.free_count).colwise().norm().maxCoeff();
            if (moved > attempt.reach) {
              attempt.reach = 2 * moved;
              again.push_back(std::move(attempt));
              return;
            }
            paste_patch(attempt.patch, scene_, index_);
            if (!attempt.clean) attempt.trajectory.end_at_fewest_pairs();
            if (options_.recorder)
              options_.recorder->add(std::move(attempt.trajectory), std::string(strategy.name),
                                     options_.first_region + result_.regions.size(), attempt.free, scene_.x);
            result_.regions.push_back(report_of(attempt, strategy));
            if (!attempt.clean) {
              start_anew(attempt.free);
              ++large_gains_;
            }
            result_.moved.push_back(strategy.is_on_coarser_mesh() ? moved_surroundings(attempt)
                                                                  : std::move(attempt.free));
          });
      attempts = std::move(again);
    }
  }

  /// Of what a coarser mesh has carried along, what is elsewhere than before and a little around it.
  std::vector<Index> moved_surroundings(const Attempt& attempt) const {
    constexpr int rings = 4;
    std::vector<Index> moved;
    for (std::size_t k = 0; k < attempt.free.size(); ++k)
      if (attempt.patch.x.col(k) != attempt.start.col(k)) moved.push_back(attempt.free[k]);
    return dilate(scene_, moved, rings);
  }

  void note_tried(const std::vector<Attempt>& attempts, const Strategy& strategy) {
    if (!options_.tried) return;
    std::int8_t number = 0;
    while (number < last_strategy() && strategy_name(number) != strategy.name) ++number;
    for (const Attempt& attempt : attempts)
      for (Index v : attempt.region.core) options_.tried->strategy[v] = std::max(options_.tried->strategy[v], number);
  }

  /// The regions there are now, each with its free vertices; one whose free vertices reach another's core takes it in.
  std::vector<Attempt> gather_attempts(const Strategy& strategy) const {
    const std::vector<ConflictRegion> regions = conflict_regions(scene_, pairs_, strategy.hub_valence);
    std::vector<Index> region_of_core(scene_.vertex_count(), -1);
    for (std::size_t r = 0; r < regions.size(); ++r)
      for (Index v : regions[r].core) region_of_core[v] = static_cast<Index>(r);
    std::vector<std::uint8_t> taken(regions.size(), 0);
    std::vector<Attempt> attempts;
    for (std::size_t r = 0; r < regions.size(); ++r) {
      // What is not accepted of a part will hardly be of the whole.
      const auto was_rejected = [&](Index v) { return rejected_.count(v) > 0; };
      if (strategy.rings == whole_component &&
          std::any_of(regions[r].core.begin(), regions[r].core.end(), was_rejected))
        continue;
      if (taken[r]) continue;
      const int depth = depth_for(strategy, regions[r]);
      if (depth < strategy.least_depth || depth >= strategy.below_depth) continue;
      const int rings = strategy.rings == by_depth ? static_cast<int>(rings_per_depth * depth) : strategy.rings;
      taken[r] = 1;
      Attempt attempt;
      attempt.depth = depth;
      ConflictRegion& region = attempt.region = regions[r];
      for (bool grown = true; grown;) {
        grown = false;
        attempt.free = dilate(scene_, region.core, rings, strategy.hub_valence);
        for (Index v : attempt.free) {
          const Index other = region_of_core[v];
          if (other < 0 || taken[other]) continue;
          taken[other] = 1;
          grown = true;
          region.core.insert(region.core.end(), regions[other].core.begin(), regions[other].core.end());
          region.pairs.insert(region.pairs.end(), regions[other].pairs.begin(), regions[other].pairs.end());
        }
        std::sort(region.core.begin(), region.core.end());
        std::sort(region.pairs.begin(), region.pairs.end());
      }
      std::vector<Triangle> core_faces;
      for (const IntersectingPair& pair : region.pairs)
        for (Index t : {pair.a, pair.b}) core_faces.push_back(scene_.triangles[t]);
      attempt.edge_length = mean_equilateral_side(scene_.rest, core_faces);
      attempt.reach = (strategy.local ? local_reach : strategy.flow ? flow_reach : coarse_reach) * attempt.edge_length;
      attempts.push_back(std::move(attempt));
    }
    return attempts;
  }

  /// 0 where it cannot reach the strategy's bounds, or there are none.
  int depth_for(const Strategy& strategy, const ConflictRegion& region) const {
    const int least = strategy.least_depth > 0 ? strategy.least_depth : strategy.below_depth;
    if (region.core.size() / 2 < static_cast<std::size_t>(least)) return 0;  // no such girth
    if (!parts_) parts_.emplace(scene_);
    return tangle_depth(scene_, *parts_, region.core);
  }

  void run(Attempt& attempt, const Strategy& strategy) const {
    if (stopped()) return;
    const auto begin = std::chrono::steady_clock::now();
    attempt.patch = cut_patch(scene_, index_, attempt.free, attempt.reach);
    attempt.patch.edge_length = attempt.edge_length;
    attempt.start = attempt.patch.x;
    if (stopped()) return;
    if (options_.recorder && options_.recorder->is_on()) {
      attempt.trajectory = options_.recorder->new_trajectory();
      attempt.patch.trajectory = &attempt.trajectory;
    }
    solve(attempt, strategy, foreign_pairs(attempt.patch, attempt.region));
    attempt.patch.trajectory = nullptr;
    attempt.rejected = attempt.clean && options_.accept && !options_.accept(attempt.patch);
    attempt.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }

  static RegionReport report_of(const Attempt& attempt, const Strategy& strategy) {
    RegionReport report;
    report.strategy = strategy.name;
    report.faces = static_cast<std::size_t>(attempt.patch.active_count);
    report.pairs = attempt.region.pairs.size() - (attempt.clean ? 0 : attempt.pairs_left);
    report.iterations = attempt.iterations;
    report.seconds = attempt.seconds;
    return report;
  }

  void solve(Attempt& attempt, const Strategy& strategy, const std::vector<IntersectingPair>& foreign) const {
    const auto take = [&](const auto& result) {
      attempt.iterations += result.iterations;
      attempt.clean = result.clean;
      attempt.pairs_left = result.pairs_left;
    };
    if (strategy.is_on_coarser_mesh())
      return take(solve_on_coarser_mesh(attempt.patch, attempt.depth, foreign, options_.stop));
    if (strategy.flow) return take(flow(attempt.patch, *strategy.flow, options_.stop, foreign));
    LocalOptions local;
    // Pockets that are inside out have to turn, and what surrounds them may have to: then nothing is kept.
    switch (strategy.local->method) {
      case LocalMethod::shallow: local.sides = KeepSides::yes; break;  // wider strategies may still keep them
      case LocalMethod::contour:
      case LocalMethod::shorten: local.sides = KeepSides::at_first; break;
      case LocalMethod::smoothing: break;  // it rounds off whatever there is
    }
    local.few_enough = few_enough(attempt, strategy);
    if (options_.min_gap)
      local.min_gap = options_.min_gap({attempt.patch.vertices.data(), std::size_t(attempt.patch.free_count)});
    take(solve_locally(attempt.patch, *strategy.local, foreign, local, options_.stop));
  }

  /// Pairs of active triangles that are not the region's: other regions' and those that cannot be resolved.
  std::vector<IntersectingPair> foreign_pairs(const Patch& patch, const ConflictRegion& region) const {
    std::vector<IntersectingPair> foreign;
    IntersectionFinder finder(patch.triangles, patch.active_count);
    for (const IntersectingPair& pair : finder.find(patch.x)) {
      const auto [a, b] = std::minmax(patch.faces[pair.a], patch.faces[pair.b]);
      if (!std::binary_search(region.pairs.begin(), region.pairs.end(), IntersectingPair{a, b, pair.kind}))
        foreign.push_back(pair);
    }
    return foreign;
  }

  Scene& scene_;
  SceneIndex& index_;
  std::span<const IntersectingPair> ignored_;
  const LadderOptions& options_;
  static constexpr Index everything = -1;
  Index group_ = everything;            // what climbs now
  std::vector<Index> group_of_vertex_;  // once there are groups
  std::vector<IntersectingPair> pairs_;
  mutable std::optional<ConnectedParts> parts_;  // made when first asked for
  std::vector<Gain> gains_;
  std::size_t large_gains_ = 0;  // that were kept
  std::set<Index> rejected_;     // vertices of regions that were resolved in a way that was not accepted
  LadderResult result_;
};

}  // namespace

LadderResult climb_ladder(Scene& scene, SceneIndex& index, std::span<const IntersectingPair> ignored,
                          const LadderOptions& options) {
  return Climb(scene, index, ignored, options).run();
}

}  // namespace unsnarl
