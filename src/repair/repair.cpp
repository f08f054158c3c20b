#include "unsnarl/repair.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <new>
#include <optional>
#include <stdexcept>
#include <utility>

#include "mesh/areas.h"
#include "repair/conflict_regions.h"
#include "repair/cuts.h"
#include "repair/diagnose.h"
#include "repair/far_regions.h"
#include "repair/finders.h"
#include "repair/gap.h"
#include "repair/judge.h"
#include "repair/ladder.h"
#include "repair/limits.h"
#include "repair/local_solver.h"
#include "repair/measure.h"
#include "repair/patch.h"
#include "repair/prepared_surface.h"
#include "repair/recorder.h"
#include "repair/recover.h"
#include "repair/recover_regions.h"
#include "repair/rounding.h"
#include "repair/scene.h"
#include "repair/send_home.h"
#include "repair/threads.h"
#include "repair/untangle_whole.h"

namespace unsnarl {
namespace {

/// Rounding, repair of what rounding brought, and again.
constexpr int rounding_rounds = 4;
/// Times that polygons are cut anew from where their vertices came to lie, and among the first of them that both cuts
/// are worked on at once. Of 412 soups of twisted polygons 1 settled in none of 12 rounds at once.
constexpr int most_cuts = 12, most_cuts_at_once = 6;

class Repair {
 public:
  Repair(const SurfaceView& surface, const RepairOptions& options, Context& context)
      : surface_(surface),
        options_(options),
        context_(context),
        limits_(options, context),
        threads_(options.find.threads) {}

  RepairResult run() {
    check_options();
    start("diagnose");
    prepared_ = prepare(surface_, options_.find);
    diagonal_ = diagonal_of(surface_);
    std::vector<std::uint8_t> fixed(prepared_.identification.count, 0);
    for (std::size_t v = 0; v < options_.fixed.size(); ++v)
      if (options_.fixed[v]) fixed[prepared_.identification.vertex_of[v]] = 1;
    finders_.emplace(prepared_.triangles());
    diagnosis_ = diagnose(surface_, prepared_, fixed, finders_->as_is);
    result_.report.topology = diagnosis_.topology;
    result_.report.obstructions = diagnosis_.obstructions;
    judge_.emplace(prepared_, diagnosis_, options_, *finders_);
    recorder_.emplace(options_.record, prepared_.rest);
    result_.report.before = result_.report.after = judge_->pairs_at(prepared_.rest).faces;
    result_.positions.assign(surface_.positions.begin(), surface_.positions.end());
    reached_ = prepared_.rest;
    try {
      if (options_.each_component)
        work_on_each_component(fixed);
      else
        work_on_everything(std::move(fixed));
    } catch (const std::bad_alloc&) {
      limits_.run_out_of_memory();
    }
    scene_ = {};
    try {
      finish();
    } catch (const std::bad_alloc&) {  // the result cannot be examined, so it is none
      limits_.run_out_of_memory();
      result_.positions.assign(surface_.positions.begin(), surface_.positions.end());
      result_.report.after = result_.report.before;
      result_.status = Status::memory_limit;
    }
    return std::move(result_);
  }

 private:
  void check_options() const {
    if (!options_.fixed.empty() && options_.fixed.size() != surface_.vertex_count())
      throw std::invalid_argument("RepairOptions::fixed has " + std::to_string(options_.fixed.size()) + " flags for " +
                                  std::to_string(surface_.vertex_count()) + " vertices");
    if (!(options_.min_gap_rel >= 0) || !(options_.max_displacement_rel >= 0) || !(options_.time_limit_s >= 0) ||
        !(options_.memory_limit_mb >= 0))
      throw std::invalid_argument("RepairOptions: gaps, displacements and limits must not be negative");
    if (options_.find.threads < 0)
      throw std::invalid_argument("RepairOptions::find.threads is " + std::to_string(options_.find.threads) +
                                  "; give 0 for as many as the machine has, or their number");
  }

  // What is worked on: everything at once, or one component after the other.

  void work_on_everything(std::vector<std::uint8_t> fixed) {
    cut_ = prepared_.triangulation;
    scene_ = make_scene(prepared_.rest, cut_.triangles, std::move(fixed), diagnosis_.edges);
    pairs_ = diagnosis_.pairs;
    component_of_ = diagnosis_.components.component_of_triangle;
    for (const IntersectingPair& pair : pairs_)
      if (judge_->is_set_aside(pair)) ignored_.push_back(pair);
    work_on_scene(*finders_);
  }

  void work_on_each_component(const std::vector<std::uint8_t>& fixed) {
    const std::vector<Index>& component_of = diagnosis_.components.component_of_triangle;
    const Index count = diagnosis_.components.count();
    std::vector<std::vector<Index>> members(count);
    std::vector<std::vector<IntersectingPair>> pairs(count);
    std::vector<Index> number(component_of.size());  // of each triangle in its component
    for (Index t = 0; t < static_cast<Index>(component_of.size()); ++t) {
      number[t] = static_cast<Index>(members[component_of[t]].size());
      members[component_of[t]].push_back(t);
    }
    for (const IntersectingPair& pair : diagnosis_.pairs)
      if (component_of[pair.a] == component_of[pair.b]) pairs[component_of[pair.a]].push_back(pair);
    bool float32 = true;
    for (Index c = 0; c < count; ++c) {
      // One without conflict is as it should be, unless rounding is asked to be looked at too.
      const bool is_of_interest = !pairs[c].empty() || options_.precision == Precision::float32;
      if (!is_of_interest || diagnosis_.components.list[c].obstructed() || limits_.reached()) continue;
      component_of_.assign(members[c].size(), c);
      cut_ = of_part(prepared_.triangulation);
      scene_ = make_scene(prepared_.rest, cut_.triangles, fixed);
      pairs_.clear();
      ignored_.clear();
      for (const IntersectingPair& pair : pairs[c]) {
        pairs_.push_back({number[pair.a], number[pair.b], pair.kind});
        if (judge_->is_set_aside(pair)) ignored_.push_back(pairs_.back());
      }
      Finders finders(cut_.triangles);
      work_on_scene(finders);
      float32 &= float32_;
    }
    float32_ = float32 && options_.precision != Precision::float64;
  }

  /// What a cut of all polygons has of the part that is worked on.
  Triangulation of_part(const Triangulation& cut) const {
    if (!options_.each_component) return cut;
    Triangulation part;
    for (std::size_t t = 0; t < cut.triangles.size(); ++t) {
      if (diagnosis_.components.component_of_vertex[cut.triangles[t][0]] != component_of_.front()) continue;
      part.triangles.push_back(cut.triangles[t]);
      part.polygon.push_back(cut.polygon[t]);
    }
    return part;
  }

  /// `finders`: of its triangles.
  void work_on_scene(Finders& finders) {
    choose_precision();
    const bool other_diagonals_matter = !prepared_.otherwise.triangles.empty();
    if (ignored_.size() == pairs_.size() && !has_float32_conflict(finders) && !other_diagonals_matter) return;
    try {
      work(finders, true);
      settle_cut(finders);
    } catch (const std::bad_alloc&) {
      limits_.run_out_of_memory();
    }
    if (options_.max_displacement_rel > 0 &&
        send_home_what_is_too_far(scene_, merge_overlapping(std::move(moved_), scene_.vertex_count()),
                                  options_.max_displacement_rel * diagonal_, pairs_, finders.as_is))
      displacement_is_exceeded_ = true;
    moved_.clear();
    for (Index v = 0; v < scene_.vertex_count(); ++v)
      if (!scene_.triangles_of_vertex[v].empty()) reached_.col(v) = scene_.x.col(v);
  }

  // Phases, limits, progress.

  using Clock = std::chrono::steady_clock;

  void start(std::string_view phase) {
    end_stage();
    phase_ = phase;
    phase_begin_ = Clock::now();
  }
  void end_stage() {
    if (phase_.empty()) return;
    result_.report.stages.push_back({std::string(phase_), seconds_since(phase_begin_), peak_memory_mb()});
    phase_ = {};
  }
  static double seconds_since(Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
  }
  void report_progress(double fraction, std::size_t pairs_left) {
    if (!context_.on_progress) return;
    progress_.fraction = std::max(progress_.fraction, fraction);
    progress_.phase = phase_;
    progress_.pairs_left = pairs_left;
    if (diagonal_ > 0) progress_.displacement_rel = largest_displacement() / diagonal_;
    context_.on_progress(progress_);
  }

  double largest_displacement() const {
    const Positions& x = scene_.vertex_count() > 0 ? scene_.x : reached_;
    return x.cols() > 0 ? (x - prepared_.rest).colwise().norm().maxCoeff() : 0;
  }

  // Precision.

  void choose_precision() {
    float32_ = options_.precision != Precision::float64;
    if (options_.precision == Precision::float32) float32_ = fits_float32(scene_.rest);
    if (options_.precision || pairs_.empty()) return;
    float32_ = float32_can_hold(scene_, pairs_);
  }
  /// Absolute gap wanted between sheets around these vertices. Local, so that distant parts change nothing.
  double wanted_gap(std::span<const Index> vertices) const {
    return std::max(gap_of_format(scene_, vertices, float32_), options_.min_gap_rel * diagonal_);
  }
  /// The state as it will be read back from the file.
  Positions as_written(const Positions& x) const {
    if (options_.as_written)
      return prepared_.gather(options_.as_written(prepared_.scatter(surface_.positions, x), float32_));
    if (!float32_) return x;
    Positions rounded = x;
    for (Index v = 0; v < x.cols(); ++v)
      for (int k = 0; k < 3; ++k)
        if (x(k, v) != scene_.rest(k, v)) rounded(k, v) = static_cast<double>(static_cast<float>(x(k, v)));
    return rounded;
  }
  /// Pairs that exist only after rounding everything to float32, where float32 has to hold: everywhere if asked for,
  /// else where something was repaired.
  std::vector<IntersectingPair> float32_conflicts(Finders& finders, const Positions& x) const {
    if (!float32_) return {};
    std::vector<IntersectingPair> conflicts = blocking_pairs(finders.find_rounded(x), ignored_);
    std::erase_if(conflicts, [&](const IntersectingPair& pair) {
      return !can_be_parted(pair) || (!options_.precision && !has_moved(pair.a, x) && !has_moved(pair.b, x));
    });
    return conflicts;
  }
  bool has_moved(Index t, const Positions& x) const {
    const auto moved = [&](Index v) { return x.col(v) != scene_.rest.col(v); };
    return std::any_of(scene_.triangles[t].begin(), scene_.triangles[t].end(), moved);
  }
  bool can_be_parted(const IntersectingPair& pair) const {
    const Index component = component_of_[pair.a];
    if (component == component_of_[pair.b] && diagnosis_.components.list[component].obstructed()) return false;
    const auto can_move = [&](Index t) {
      return std::any_of(scene_.triangles[t].begin(), scene_.triangles[t].end(),
                         [&](Index v) { return !scene_.fixed[v]; });
    };
    return can_move(pair.a) || can_move(pair.b);
  }
  bool has_float32_conflict(Finders& finders) const {
    return options_.precision && !float32_conflicts(finders, scene_.rest).empty();
  }

  // Work.

  /// is_first: `pairs_` are those of the scene, which is at rest.
  void work(Finders& finders, bool is_first = false) {
    SceneIndex index(scene_, finders.as_is);
    const std::vector<IntersectingPair> ignored = ignored_;
    std::vector<std::uint8_t> is_stuck(diagnosis_.components.count(), 0);
    for (int round = 0; round < rounding_rounds && !limits_.reached(); ++round) {
      start("untangle");
      LadderResult climbed = untangle(index, ignored_);
      if (options_.recover) {
        start("recover");
        report_progress(0.7, climbed.left.size());
        recover(merge_overlapping(climbed.moved, scene_.vertex_count()), index);
        if (is_first && round == 0 && !options_.paper) take_closer_ways(climbed, index);
      }
      auto& regions = result_.report.regions;
      regions.insert(regions.end(), climbed.regions.begin(), climbed.regions.end());
      moved_.insert(moved_.end(), climbed.moved.begin(), climbed.moved.end());
      start("certify");
      report_progress(0.9, climbed.left.size());
      scene_.x = as_written(scene_.x);
      // Components on which pairs are left are let be, and the others go on without them.
      for (const IntersectingPair& pair : climbed.left)
        is_stuck[component_of_[pair.a]] = is_stuck[component_of_[pair.b]] = 1;
      const auto goes_on = [&](const IntersectingPair& pair) {
        return !is_stuck[component_of_[pair.a]] && !is_stuck[component_of_[pair.b]];
      };
      if (!climbed.left.empty()) {
        std::vector<IntersectingPair> left = blocking_pairs(finders.as_is.find(scene_.x), ignored_);
        std::erase_if(left, goes_on);
        ignored_.insert(ignored_.end(), left.begin(), left.end());
        std::sort(ignored_.begin(), ignored_.end());
      }
      std::vector<IntersectingPair> conflicts = float32_conflicts(finders, scene_.x);
      std::erase_if(conflicts, std::not_fn(goes_on));
      if (conflicts.empty() && is_resolved(finders)) break;
      const Positions rounded = rounded_to_float32(scene_.x);
      for (const IntersectingPair& pair : conflicts)
        for (Index t : {pair.a, pair.b})
          for (Index v : scene_.triangles[t])
            if (!scene_.fixed[v]) scene_.x.col(v) = rounded.col(v);
    }
    ignored_ = ignored;
  }

  // Polygons.

  /// Whoever reads the result, a second run among them, cuts its polygons by its own positions. Where that cut
  /// intersects, work goes on until it and the input's both hold: on both at once or, as long as no way is found to
  /// that, on the one and the other in turn. Quads along either diagonal, if both count.
  void settle_cut(Finders& finders) {
    if (surface_.offsets.empty() || !is_resolved(finders)) return;
    const std::vector<Triangulation> input = {cut_, prepared_.otherwise};
    const std::size_t input_size = unite(input).all.triangles.size();
    Waypoint best = waypoint();
    bool best_holds = false;
    for (int round = 0; round < most_cuts && !limits_.reached(); ++round) {
      const std::vector<Triangulation> now = cuts_by_positions();
      const UnitedCuts both = unite({input[0], input[1], now[0], now[1]});
      if (round == 0 && both.all.triangles.size() == cut_.triangles.size()) return;
      take(both);
      const Waypoint here = waypoint();
      Finders finders_of_both(scene_.triangles);
      const std::vector<IntersectingPair> pairs = set_aside_what_cannot_be_parted(finders_of_both);
      if (is_resolved(finders_of_both)) {
        const std::vector<Index> heaped = polygons_on_new_duplicates(both.all, input_size, pairs);
        if (heaped.empty()) return;
        if (!std::exchange(best_holds, true)) best = here;
        send_home(heaped);
        work_on(input);
      } else {
        if (round < most_cuts_at_once) {
          work(finders_of_both);
          if (is_resolved(finders_of_both)) continue;
          go_back_to(here);
        }
        work_on(round % 2 == 0 ? now : input);
      }
    }
    take(unite(input));
    go_back_to(best);
  }
  std::vector<Triangulation> cuts_by_positions() const {
    const std::vector<double> positions = prepared_.scatter(surface_.positions, scene_.x);
    const SurfaceView result = {positions, surface_.corners, surface_.offsets};
    const std::vector<Index>& vertex_of = prepared_.identification.vertex_of;
    return {of_part(triangulate(result, vertex_of)),
            options_.find.both_diagonals ? of_part(triangulate_otherwise(result, vertex_of)) : Triangulation()};
  }
  /// Makes the scene one of these triangles, where it is now.
  void take(const UnitedCuts& cuts) {
    ignored_ = cuts.strangers;
    component_of_.clear();
    for (const Triangle& t : cuts.all.triangles)
      component_of_.push_back(diagnosis_.components.component_of_vertex[t[0]]);
    Positions x = std::move(scene_.x);
    scene_ = make_scene(prepared_.rest, cuts.all.triangles, std::move(scene_.fixed));
    scene_.x = std::move(x);
  }
  /// Returns all pairs there are.
  std::vector<IntersectingPair> set_aside_what_cannot_be_parted(Finders& finders) {
    std::vector<IntersectingPair> pairs = finders.as_is.find(scene_.x);
    for (const IntersectingPair& pair : blocking_pairs(pairs, ignored_))
      if (pair.kind == PairClass::duplicate || !can_be_parted(pair) ||
          (options_.goal == Goal::disjoint && pair.kind != PairClass::disjoint))
        ignored_.push_back(pair);
    std::sort(ignored_.begin(), ignored_.end());
    return pairs;
  }
  void work_on(const std::vector<Triangulation>& cuts) {
    take(unite(cuts));
    Finders finders(scene_.triangles);
    set_aside_what_cannot_be_parted(finders);
    work(finders);
  }
  void send_home(std::span<const Index> polygons) {
    for (const Index f : polygons)
      for (const Index corner : surface_.face(f)) {
        const Index v = prepared_.identification.vertex_of[corner];
        scene_.x.col(v) = scene_.rest.col(v);
      }
  }
  /// A state to go back to.
  struct Waypoint {
    Positions x;
    std::size_t regions;
    Recorder::Stages recorded;
  };
  Waypoint waypoint() const { return {scene_.x, result_.report.regions.size(), recorder_->stages()}; }
  void go_back_to(const Waypoint& waypoint) {
    scene_.x = waypoint.x;
    result_.report.regions.resize(waypoint.regions);
    recorder_->restore(waypoint.recorded);
  }

  bool is_resolved(Finders& finders) const {
    return blocking_pairs(finders.as_is.find(scene_.x), ignored_).empty() &&
           count_lost_areas(prepared_.rest, scene_.x, prepared_.triangulation.triangles) == 0;
  }

  /// Contours may be driven a long way off a sheet where whole sheets that repel each other part at once: tries that on
  /// what has gone far, from rest, and keeps what lies closer.
  void take_closer_ways(LadderResult& climbed, SceneIndex& index) {
    const auto of_all = merge_overlapping(climbed.moved, scene_.vertex_count());
    for (const std::vector<Index>& region : far_regions(scene_, of_all, pairs_)) {
      if (limits_.reached()) return;
      const auto is_in_region = [&](const std::vector<Index>& moved) {
        return !moved.empty() && std::binary_search(region.begin(), region.end(), moved.front());
      };
      bool was_whole = false;
      for (std::size_t k = 0; k < climbed.moved.size(); ++k)
        was_whole |= is_in_region(climbed.moved[k]) && frees_whole_components(climbed.regions[k].rung);
      if (was_whole) continue;
      const Positions before = scene_.x;
      const Recorder::Stages recorded = recorder_->stages();
      const double gap = smallest_gap_;
      std::vector<IntersectingPair> known = blocking_pairs(index.find_pairs(), ignored_);
      known.insert(known.end(), ignored_.begin(), ignored_.end());
      std::sort(known.begin(), known.end());
      for (Index v : region) scene_.x.col(v) = scene_.rest.col(v);
      LadderResult other = untangle(index, known, true);
      if (other.left.empty()) recover(merge_overlapping(other.moved, scene_.vertex_count()), index);
      double squares = 0, squares_before = 0;
      for (Index v = 0; v < scene_.vertex_count(); ++v)
        if (scene_.x.col(v) != before.col(v)) {
          squares += (scene_.x.col(v) - scene_.rest.col(v)).squaredNorm();
          squares_before += (before.col(v) - scene_.rest.col(v)).squaredNorm();
        }
      if (!other.left.empty() || limits_.reached() || !(squares < squares_before)) {
        scene_.x = before;
        smallest_gap_ = gap;
        recorder_->restore(recorded);
        index.update();
        continue;
      }
      for (std::size_t k = climbed.moved.size(); k-- > 0;)
        if (is_in_region(climbed.moved[k])) {
          climbed.moved.erase(climbed.moved.begin() + static_cast<std::ptrdiff_t>(k));
          climbed.regions.erase(climbed.regions.begin() + static_cast<std::ptrdiff_t>(k));
        }
      climbed.regions.insert(climbed.regions.begin() + static_cast<std::ptrdiff_t>(climbed.moved.size()),
                             other.regions.begin(), other.regions.end());
      climbed.moved.insert(climbed.moved.end(), other.moved.begin(), other.moved.end());
    }
  }

  LadderResult untangle(SceneIndex& index, std::span<const IntersectingPair> ignored, bool second_way = false) {
    LadderOptions ladder;
    ladder.second_way = second_way;
    ladder.stop = limits_.stopper();
    ladder.recorder = &*recorder_;
    ladder.first_region = result_.report.regions.size();
    if (options_.paper) return untangle_whole(scene_, index, pairs_.size(), ignored_, ladder);
    if (options_.max_displacement_rel > 0) ladder.accept = [this](Patch& patch) { return stays_near(patch); };
    ladder.on_progress = [this](std::size_t left) {
      const double all = static_cast<double>(std::max<std::size_t>(1, pairs_.size()));
      report_progress(0.7 * (1 - std::min(1.0, static_cast<double>(left) / all)), left);
    };
    return climb_ladder(scene_, index, ignored, ladder);
  }

  void recover(const std::vector<std::vector<Index>>& regions, SceneIndex& index) {
    RecoverRegionsOptions options;
    if (options_.paper) options.recover = RecoverOptions::paper();
    options.min_gap = [this](std::span<const Index> vertices) { return wanted_gap(vertices); };
    options.stop = limits_.stopper();
    smallest_gap_ = std::min(smallest_gap_, recover_regions(scene_, index, regions, options, *recorder_));
  }

  // The limit of displacement.

  /// Is a patch that a rung resolved within the limit, at least once it has recovered?
  bool stays_near(Patch& patch) {
    const auto is_near = [&] {
      for (Index v = 0; v < patch.free_count; ++v)
        if ((patch.x.col(v) - prepared_.rest.col(patch.vertices[v])).norm() > options_.max_displacement_rel * diagonal_)
          return false;
      return true;
    };
    if (is_near()) return true;
    if (options_.recover) {
      RecoverOptions recovery;
      recovery.min_gap = wanted_gap({patch.vertices.data(), static_cast<std::size_t>(patch.free_count)});
      unsnarl::recover(patch, recovery, limits_.stopper());
      if (is_near()) return true;
    }
    displacement_is_exceeded_ = true;
    return false;
  }

  // The end.

  /// Components that were repaired as if alone may run into each other: takes them over one by one, without those that
  /// make it worse.
  void take_over_what_makes_nothing_worse() {
    const Positions wanted = std::exchange(reached_, prepared_.rest);
    const std::vector<Index>& component_of = diagnosis_.components.component_of_vertex;
    std::vector<std::vector<Index>> vertices(diagnosis_.components.count());
    for (Index v = 0; v < wanted.cols(); ++v)
      if (component_of[v] >= 0 && wanted.col(v) != prepared_.rest.col(v)) vertices[component_of[v]].push_back(v);
    for (const std::vector<Index>& component : vertices) {
      if (component.empty()) continue;
      for (Index v : component) reached_.col(v) = wanted.col(v);
      if (!judge_->is_worse(judge_->pairs_at(reached_))) continue;
      for (Index v : component) reached_.col(v) = prepared_.rest.col(v);
    }
  }

  void finish() {
    start("certify");
    RepairReport& report = result_.report;
    report.precision = float32_ ? Precision::float32 : Precision::float64;
    Judge::Pairs left = judge_->pairs_at(reached_);
    if (judge_->is_worse(left)) {
      if (options_.each_component)
        take_over_what_makes_nothing_worse();
      else
        reached_ = prepared_.rest;
      left = judge_->pairs_at(reached_);
    }
    result_.positions = prepared_.scatter(surface_.positions, reached_);
    report.after = left.faces;
    result_.status = judge_->status(left, reached_);
    if (result_.status == Status::reduced || result_.status == Status::no_progress)
      result_.status = limits_.status_or(displacement_is_exceeded_ ? Status::displacement_exceeded : result_.status);
    // Who cancels is not given, unasked, what lies farther off than it need.
    if (limits_.status_or(result_.status) == Status::cancelled) result_.status = Status::cancelled;
    report.float32_embedded = judge_->is_embedded_in_float32(reached_);
    measure_change(surface_, prepared_, diagnosis_, result_.positions, report);
    report.min_gap_rel = std::isfinite(smallest_gap_) && report.diagonal > 0 ? smallest_gap_ / report.diagonal : 0;
    if (options_.max_displacement_rel > 0 && report.displacement_max_rel > options_.max_displacement_rel)
      result_.status = Status::displacement_exceeded;
    measure_components(prepared_, diagnosis_, left.triangles, report);
    if (options_.each_component) name_pairs_between_components(prepared_, diagnosis_, left.triangles, report);
    report.history = recorder_->history();
    result_.frames = recorder_->frames(surface_, prepared_, result_.positions, *judge_);
    end_stage();
    phase_ = "certify";
    report_progress(1, left.triangles.size());
  }

  const SurfaceView surface_;
  const RepairOptions& options_;
  Context& context_;
  Limits limits_;
  ThreadLimit threads_;
  RepairResult result_;
  PreparedSurface prepared_;
  double diagonal_ = 0;
  Diagnosis diagnosis_;
  std::optional<Finders> finders_;  // of the prepared triangles
  std::optional<Judge> judge_;
  std::optional<Recorder> recorder_;
  // What is worked on at the moment; ids of pairs are those of its triangles.
  Triangulation cut_;  // of the polygons, as the input has them
  Scene scene_;        // of these triangles, and of others that polygons may be cut into
  std::vector<IntersectingPair> pairs_, ignored_;
  std::vector<Index> component_of_;        // of its triangles
  std::vector<std::vector<Index>> moved_;  // what regions freed, where the displacement is limited
  std::atomic<bool> displacement_is_exceeded_{false};
  Positions reached_;  // of all vertices
  bool float32_ = false;
  double smallest_gap_ = std::numeric_limits<double>::infinity();
  std::string_view phase_;
  Clock::time_point phase_begin_ = Clock::now();
  Context::Progress progress_;
};

}  // namespace

RepairResult repair(const SurfaceView& surface, const RepairOptions& options, Context* context) {
  Context own;
  return Repair(surface, options, context ? *context : own).run();
}

}  // namespace unsnarl
