#include "unsnarl/repair.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "contact/intersection_finder.h"
#include "mesh/areas.h"
#include "repair/conflict_regions.h"
#include "repair/cuts.h"
#include "repair/diagnose.h"
#include "repair/ladder.h"
#include "repair/local_solver.h"
#include "repair/measure.h"
#include "repair/paper_untangle.h"
#include "repair/patch.h"
#include "repair/prepared_surface.h"
#include "repair/recover.h"
#include "repair/rounding.h"
#include "repair/scene.h"
#include "repair/threads.h"
#include "repair/waves.h"

namespace unsnarl {
namespace {

/// The gap wanted between sheets, in units in the last place of the format to be written: rounding moves each of the
/// two by half a unit in every coordinate, which is less than two units of distance; the rest is reserve.
constexpr double gap_units = 8;
/// float32 is asked for only where that gap is at most this share of an edge; else coordinates are too coarse for it.
constexpr double largest_gap_of_edge = 0.05;
/// Obstacles are taken in this many h around a region: it hardly leaves the space between start and input.
constexpr double recovery_reach = 2;
/// Rounding, repair of what rounding brought, and again.
constexpr int rounding_rounds = 4;
/// Times that polygons are cut anew from where their vertices came to lie.
constexpr int most_cuts = 6;

class Repair {
 public:
  Repair(const SurfaceView& surface, const RepairOptions& options, Context& context)
      : surface_(surface), options_(options), context_(context), threads_(options.find.threads) {}

  RepairResult run() {
    check_options();
    start("diagnose");
    prepared_ = prepare(surface_, options_.find);
    diagonal_ = diagonal_of(surface_);
    std::vector<std::uint8_t> fixed(prepared_.identification.count, 0);
    for (std::size_t v = 0; v < options_.fixed.size(); ++v)
      if (options_.fixed[v]) fixed[prepared_.identification.vertex_of[v]] = 1;
    diagnosis_ = diagnose(surface_, prepared_, fixed);
    result_.report.topology = diagnosis_.topology;
    result_.report.obstructions = diagnosis_.obstructions;
    result_.report.before = count_by_class(pairs_of_faces(prepared_, diagnosis_.pairs));
    result_.positions.assign(surface_.positions.begin(), surface_.positions.end());

    ignored_ = diagnosis_.obstructed;
    if (options_.goal == Goal::disjoint) {
      ignored_.clear();
      for (const IntersectingPair& pair : diagnosis_.pairs)
        if (pair.kind != PairClass::disjoint ||
            std::binary_search(diagnosis_.obstructed.begin(), diagnosis_.obstructed.end(), pair))
          ignored_.push_back(pair);
    }
    scene_ = make_scene(prepared_.rest, prepared_.triangulation.triangles, std::move(fixed));
    IntersectionFinder finder(prepared_.triangulation.triangles);
    choose_precision();
    if (ignored_.size() < diagnosis_.pairs.size() || has_float32_conflict(finder)) {
      work(finder);
      settle_cut(finder);
    }
    finish(finder);
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
  std::function<bool()> stopper() {
    return [this] { return stopped(); };
  }
  /// Safe from any thread.
  bool stopped() {
    if (stop_reason_ == no_stop) {
      if (context_.is_cancelled())
        stop_reason_ = static_cast<int>(Status::cancelled);
      else if (options_.time_limit_s > 0 && seconds_since(begin_) > options_.time_limit_s)
        stop_reason_ = static_cast<int>(Status::time_limit);
      else if (options_.memory_limit_mb > 0 && resident_memory_mb() > options_.memory_limit_mb)
        stop_reason_ = static_cast<int>(Status::memory_limit);
    }
    return stop_reason_ != no_stop;
  }
  Status stopped_or(Status status) const {
    const int reason = stop_reason_;
    return reason == no_stop ? status : static_cast<Status>(reason);
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
    return scene_.vertex_count() > 0 ? (scene_.x - scene_.rest).colwise().norm().maxCoeff() : 0;
  }

  // Precision.

  void choose_precision() {
    float32_ = options_.precision != Precision::float64;
    if (options_.precision || diagnosis_.pairs.empty()) return;
    // By the conflicts alone: parts far away that have none change nothing.
    std::vector<Triangle> conflict;
    double largest = 0;
    for (const IntersectingPair& pair : diagnosis_.pairs)
      for (Index t : {pair.a, pair.b}) {
        conflict.push_back(scene_.triangles[t]);
        for (Index v : conflict.back()) largest = std::max(largest, scene_.rest.col(v).cwiseAbs().maxCoeff());
      }
    float32_ = gap_units * float32_unit(largest) <= largest_gap_of_edge * mean_edge_length(scene_.rest, conflict);
  }
  /// Absolute gap wanted between sheets around these vertices. Local, so that distant parts change nothing.
  double wanted_gap(const std::vector<Index>& vertices) const {
    double largest = 0;
    for (Index v : vertices) largest = std::max(largest, scene_.rest.col(v).cwiseAbs().maxCoeff());
    const double gap = gap_units * (float32_ ? float32_unit(largest) : float64_unit(largest));
    return std::max(gap, options_.min_gap_rel * diagonal_);
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
  std::vector<IntersectingPair> float32_conflicts(IntersectionFinder& finder, const Positions& x) const {
    if (!float32_) return {};
    std::vector<IntersectingPair> conflicts = blocking_pairs(finder.find(rounded_to_float32(x)), ignored_);
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
    const std::vector<Index>& component_of = diagnosis_.components.component_of_triangle;
    const Index component = component_of[pair.a];
    if (component == component_of[pair.b] && diagnosis_.components.list[component].obstructed()) return false;
    const auto can_move = [&](Index t) {
      return std::any_of(scene_.triangles[t].begin(), scene_.triangles[t].end(),
                         [&](Index v) { return !scene_.fixed[v]; });
    };
    return can_move(pair.a) || can_move(pair.b);
  }
  bool has_float32_conflict(IntersectionFinder& finder) const {
    return !float32_conflicts(finder, scene_.rest).empty();
  }

  // Work.

  void work(IntersectionFinder& finder) {
    for (int round = 0; round < rounding_rounds && !stopped(); ++round) {
      start("untangle");
      LadderResult climbed = options_.paper ? untangle_as_in_the_paper(finder) : untangle();
      auto& regions = result_.report.regions;
      regions.insert(regions.end(), climbed.regions.begin(), climbed.regions.end());
      if (options_.recover) {
        start("recover");
        recover_regions(merged(std::move(climbed.moved)));
      }
      start("certify");
      report_progress(0.9, climbed.left.size());
      scene_.x = as_written(scene_.x);
      const std::vector<IntersectingPair> conflicts = float32_conflicts(finder, scene_.x);
      if ((conflicts.empty() && is_resolved(finder)) || !climbed.left.empty()) break;
      const Positions rounded = rounded_to_float32(scene_.x);
      for (const IntersectingPair& pair : conflicts)
        for (Index t : {pair.a, pair.b})
          for (Index v : scene_.triangles[t])
            if (!scene_.fixed[v]) scene_.x.col(v) = rounded.col(v);
    }
  }

  /// Whoever reads the result, a second run among them, cuts its polygons by its own positions. Where that cut
  /// intersects, work goes on until all cuts met hold.
  void settle_cut(IntersectionFinder& finder) {
    if (surface_.offsets.empty() || !is_resolved(finder)) return;
    Triangulation cuts = prepared_.triangulation;
    for (int round = 0; round < most_cuts && !stopped(); ++round) {
      const std::vector<double> positions = prepared_.scatter(surface_.positions, scene_.x);
      const std::size_t known = cuts.triangles.size(), regions = result_.report.regions.size();
      const std::vector<IntersectingPair> strangers = add_cut(
          cuts, triangulate({positions, surface_.corners, surface_.offsets}, prepared_.identification.vertex_of));
      if (cuts.triangles.size() == known) return;
      ignored_.insert(ignored_.end(), strangers.begin(), strangers.end());
      for (std::size_t t = known; t < cuts.triangles.size(); ++t)
        diagnosis_.components.component_of_triangle.push_back(
            diagnosis_.components.component_of_vertex[cuts.triangles[t][0]]);
      const Positions before = scene_.x;
      scene_ = make_scene(prepared_.rest, cuts.triangles, std::move(scene_.fixed));
      scene_.x = before;
      IntersectionFinder finder_of_all(scene_.triangles);
      for (const IntersectingPair& pair : finder_of_all.find(scene_.x))
        if (pair.kind == PairClass::duplicate) ignored_.push_back(pair);  // no motion parts them
      std::sort(ignored_.begin(), ignored_.end());
      if (is_resolved(finder_of_all)) return;
      work(finder_of_all);
      if (is_resolved(finder_of_all)) continue;
      scene_.x = before;
      result_.report.regions.resize(regions);
      return;
    }
  }
  bool is_resolved(IntersectionFinder& finder) const {
    return blocking_pairs(finder.find(scene_.x), ignored_).empty() && lost_areas() == 0;
  }

  LadderResult untangle() {
    LadderOptions ladder;
    ladder.stop = stopper();
    ladder.on_progress = [this](std::size_t left) {
      const double all = static_cast<double>(std::max<std::size_t>(1, diagnosis_.pairs.size()));
      report_progress(0.7 * (1 - std::min(1.0, static_cast<double>(left) / all)), left);
    };
    return climb_ladder(scene_, ignored_, ladder);
  }

  /// The whole scene as one patch, until no disjoint pair is left.
  LadderResult untangle_as_in_the_paper(IntersectionFinder& finder) {
    std::vector<Index> free;
    for (Index v = 0; v < scene_.vertex_count(); ++v)
      if (!scene_.fixed[v] && !scene_.triangles_of_vertex[v].empty()) free.push_back(v);
    SceneIndex index(scene_);
    Patch patch = cut_patch(scene_, index, free, 0);
    patch.edge_length = mean_edge_length(scene_.rest, scene_.triangles);
    const PaperResult untangled = paper_untangle(patch, {}, stopper());
    paste_patch(patch, scene_, index);
    LadderResult result;
    RegionReport report;
    report.rung = "paper";
    report.faces = static_cast<std::size_t>(patch.active_count);
    report.pairs = diagnosis_.pairs.size();
    report.iterations = untangled.iterations;
    report.seconds = seconds_since(phase_begin_);
    result.regions.push_back(report);
    result.moved.push_back(std::move(free));
    result.left = blocking_pairs(finder.find(scene_.x), ignored_);
    return result;
  }

  /// Sets of free vertices that overlap become one.
  std::vector<std::vector<Index>> merged(std::vector<std::vector<Index>> sets) const {
    std::vector<Index> owner(scene_.vertex_count(), -1);
    std::vector<std::vector<Index>> result;
    for (std::vector<Index>& set : sets) {
      std::vector<Index> overlapped;
      for (Index v : set)
        if (owner[v] >= 0) overlapped.push_back(owner[v]);
      std::sort(overlapped.begin(), overlapped.end());
      overlapped.erase(std::unique(overlapped.begin(), overlapped.end()), overlapped.end());
      const Index target = overlapped.empty() ? static_cast<Index>(result.size()) : overlapped.front();
      if (overlapped.empty()) result.emplace_back();
      for (std::size_t k = 1; k < overlapped.size(); ++k) {
        set.insert(set.end(), result[overlapped[k]].begin(), result[overlapped[k]].end());
        result[overlapped[k]].clear();
      }
      result[target].insert(result[target].end(), set.begin(), set.end());
      for (Index v : result[target]) owner[v] = target;
    }
    std::erase_if(result, [](const auto& set) { return set.empty(); });
    for (auto& set : result) {
      std::sort(set.begin(), set.end());
      set.erase(std::unique(set.begin(), set.end()), set.end());
    }
    return result;
  }

  void recover_regions(const std::vector<std::vector<Index>>& regions) {
    SceneIndex index(scene_);
    std::vector<double> edge_length(regions.size()), gap(regions.size());
    std::vector<Box> boxes(regions.size());
    for (std::size_t r = 0; r < regions.size(); ++r) {
      std::vector<Triangle> faces;
      for (Index v : regions[r])
        for (Index t : scene_.triangles_of_vertex[v]) faces.push_back(scene_.triangles[t]);
      edge_length[r] = mean_edge_length(scene_.rest, faces);
      boxes[r] = patch_box(scene_, regions[r], recovery_reach * edge_length[r]);
    }
    std::vector<Patch> patches(regions.size());
    run_in_waves(
        boxes,
        [&](std::size_t r) {
          if (stopped()) return;
          patches[r] = cut_patch(scene_, index, regions[r], recovery_reach * edge_length[r]);
          patches[r].edge_length = edge_length[r];
          RecoverOptions recovery = options_.paper ? RecoverOptions::paper() : RecoverOptions{};
          recovery.min_gap = wanted_gap(regions[r]);
          gap[r] = recover(patches[r], recovery, stopper()).min_gap;
        },
        [&](std::size_t r) {
          if (std::isfinite(gap[r]) && gap[r] > 0) smallest_gap_ = std::min(smallest_gap_, gap[r]);
          paste_patch(patches[r], scene_, index);
          patches[r] = {};
        });
  }

  std::size_t lost_areas() const {
    return count_lost_areas(prepared_.rest, scene_.x, prepared_.triangulation.triangles);
  }

  // The end.

  void finish(IntersectionFinder& finder) {
    start("certify");
    const std::vector<IntersectingPair> left = finder.find(scene_.x);
    const PairCounts before = count_by_class(diagnosis_.pairs), after = count_by_class(left);
    RepairReport& report = result_.report;
    report.precision = float32_ ? Precision::float32 : Precision::float64;
    const bool worse = after.total() > before.total() || after[PairClass::disjoint] > before[PairClass::disjoint];
    if (worse) {
      report.after = report.before;
      result_.status = stopped_or(Status::no_progress);
    } else {
      result_.positions = prepared_.scatter(surface_.positions, scene_.x);
      report.after = count_by_class(pairs_of_faces(prepared_, left));
      const std::vector<IntersectingPair> blocking = blocking_pairs(left, ignored_);
      if (!blocking.empty() || lost_areas() > 0)
        result_.status = after.total() < before.total() ? Status::reduced : Status::no_progress;
      else if (left.empty())
        result_.status = Status::embedded;
      else
        result_.status =
            options_.goal == Goal::disjoint && after[PairClass::disjoint] == 0 ? Status::embedded : Status::obstructed;
      if (!blocking.empty()) result_.status = stopped_or(result_.status);
    }
    report.float32_embedded = finder.find(rounded_to_float32(worse ? scene_.rest : scene_.x)).empty();
    measure_change(surface_, prepared_, diagnosis_, result_.positions, report);
    report.min_gap_rel = std::isfinite(smallest_gap_) && report.diagonal > 0 ? smallest_gap_ / report.diagonal : 0;
    if (options_.max_displacement_rel > 0 && report.displacement_max_rel > options_.max_displacement_rel)
      result_.status = Status::displacement_exceeded;
    end_stage();
    phase_ = "certify";
    report_progress(1, left.size());
  }

  const SurfaceView surface_;
  const RepairOptions& options_;
  Context& context_;
  ThreadLimit threads_;
  RepairResult result_;
  PreparedSurface prepared_;
  double diagonal_ = 0;
  Diagnosis diagnosis_;
  std::vector<IntersectingPair> ignored_;
  Scene scene_;
  bool float32_ = false;
  double smallest_gap_ = std::numeric_limits<double>::infinity();
  static constexpr int no_stop = -1;
  std::atomic<int> stop_reason_{no_stop};
  std::string_view phase_;
  Clock::time_point begin_ = Clock::now(), phase_begin_ = begin_;
  Context::Progress progress_;
};

}  // namespace

std::string_view to_string(Status status) {
  switch (status) {
    case Status::embedded:
      return "embedded";
    case Status::reduced:
      return "reduced";
    case Status::no_progress:
      return "no_progress";
    case Status::obstructed:
      return "obstructed";
    case Status::time_limit:
      return "time_limit";
    case Status::memory_limit:
      return "memory_limit";
    case Status::displacement_exceeded:
      return "displacement_exceeded";
    case Status::cancelled:
      return "cancelled";
  }
  return "unknown";
}

std::string_view to_string(Obstruction::Kind kind) {
  switch (kind) {
    case Obstruction::Kind::closed_non_orientable:
      return "closed_non_orientable";
    case Obstruction::Kind::duplicate_faces:
      return "duplicate_faces";
    case Obstruction::Kind::fixed_faces:
      return "fixed_faces";
  }
  return "unknown";
}

RepairResult repair(const SurfaceView& surface, const RepairOptions& options, Context* context) {
  Context own;
  return Repair(surface, options, context ? *context : own).run();
}

}  // namespace unsnarl
