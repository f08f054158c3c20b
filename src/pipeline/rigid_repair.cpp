#include "pipeline/rigid_repair.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "contact/stop_check.h"
#include "geometry/sort_unique.h"
#include "pipeline/gap.h"
#include "pipeline/rigid_report.h"
#include "report/acceptance.h"
#include "report/measure.h"
#include "rigid/bodies.h"
#include "rigid/place_bodies.h"
#include "rigid/recover_bodies.h"
#include "run/limits.h"
#include "run/phases.h"
#include "run/thread_limit.h"
#include "scene/diagnose.h"
#include "scene/finders.h"
#include "scene/prepared_surface.h"
#include "scene/rounding.h"
#include "scene/scene.h"
#include "unsnarl/limit_reached.h"
#include "unsnarl/stage_clock.h"

namespace unsnarl {
namespace {

class RigidRepair {
 public:
  RigidRepair(const SurfaceView& surface, const RepairOptions& options, Context& context)
      : surface_(surface),
        options_(options),
        context_(context),
        limits_(options, context),
        threads_(options.find.threads) {}

  RepairResult run() {
    check_options();
    Phases phases(context_, stages_);
    phases.start("place");
    prepared_ = prepare(surface_, options_.find);
    find_parts();
    finders_.emplace(prepared_.triangles(), prepared_.scale);
    diagnose_within_limits();
    find_obstructions();
    acceptance_.emplace(surface_, prepared_, diagnosis_, options_, *finders_);
    const PairCounts before = acceptance_->pairs_at(prepared_.rest).faces;
    // This attempt, the input itself, is the result if memory runs out before the first one is complete.
    Attempt best;
    best.positions.assign(surface_.positions.begin(), surface_.positions.end());
    best.inner.status = Status::memory_limit;
    best.inner.positions = best.positions;
    try {
      best = repaired_attempt({}, phases);
      const std::vector<Index> in_soft = parts_in_soft(best);
      if (!in_soft.empty() && !limits_.reached()) {
        phases.start("place");
        Attempt other = repaired_attempt(in_soft, phases);
        if (other.inner.report.after.total() < best.inner.report.after.total()) best = std::move(other);
      }
    } catch (const LimitReached& reached) {
      best.inner.status = reached.status();
    } catch (const std::bad_alloc&) {
      limits_.run_out_of_memory();
    }
    try {
      return finished(std::move(best));
    } catch (const std::bad_alloc&) {  // the result cannot be examined, so it is none
      return unchanged(before);
    }
  }

 private:
  struct Attempt {
    std::vector<double> positions;  // with the rigid parts in their places
    bool is_too_far = false;        // a part had no place within the displacement that is allowed
    RepairResult inner;             // of the soft parts around them
  };

  void diagnose_within_limits() {
    try {
      diagnosis_ = diagnose(surface_, prepared_, fixed_, finders_->as_is, limits_.stopper_but_for_cancellation());
    } catch (const WorkStopped&) {
      throw LimitReached(limits_.status_or(Status::time_limit));
    }
  }

  void check_options() const {
    const std::size_t n = surface_.vertex_count();
    if (options_.rigid.size() != n)
      throw std::invalid_argument("RepairOptions::rigid has " + std::to_string(options_.rigid.size()) +
                                  " numbers for " + std::to_string(n) + " vertices");
    if (!options_.fixed.empty() && options_.fixed.size() != n)
      throw std::invalid_argument("RepairOptions::fixed has " + std::to_string(options_.fixed.size()) + " flags for " +
                                  std::to_string(n) + " vertices");
    if (options_.each_component)
      throw std::invalid_argument(
          "RepairOptions: rigid parts move among all components, but each_component repairs each as if alone; leave "
          "one of the two out");
    const auto too_many = std::find_if(options_.rigid.begin(), options_.rigid.end(),
                                       [&](std::int32_t part) { return part < -1 || part >= static_cast<Index>(n); });
    if (too_many != options_.rigid.end())
      throw std::invalid_argument("RepairOptions::rigid: vertex " + std::to_string(too_many - options_.rigid.begin()) +
                                  " is of part " + std::to_string(*too_many) +
                                  "; give -1 for none, or a number from 0, less than that of the vertices");
  }

  std::string name(Index part) const { return name_of_rigid_part(options_, part); }

  /// Finds for each welded vertex whether it is fixed, and its rigid part.
  void find_parts() {
    const std::vector<Index>& welded = prepared_.weld_map.vertex_of;
    fixed_.assign(prepared_.weld_map.count, 0);
    part_of_.assign(prepared_.weld_map.count, -1);
    for (std::size_t v = 0; v < options_.fixed.size(); ++v)
      if (options_.fixed[v]) fixed_[welded[v]] = 1;
    for (std::size_t v = 0; v < options_.rigid.size(); ++v) {
      const std::int32_t part = options_.rigid[v];
      if (part < 0) continue;
      part_count_ = std::max(part_count_, part + 1);
      Index& own = part_of_[welded[v]];
      if (own >= 0 && own != part)
        throw std::invalid_argument("vertex " + std::to_string(v) + " is of two rigid parts, " + name(own) + " and " +
                                    name(part) + "; name them as one, or leave one of them out");
      if (fixed_[welded[v]])
        throw std::invalid_argument("vertex " + std::to_string(v) + " is fixed and of the rigid part " + name(part) +
                                    ", so that this cannot move; leave one of the two out");
      own = part;
    }
    part_count_ = std::max(part_count_, static_cast<Index>(options_.rigid_names.size()));
  }

  /// Adds the pairs that no rigid motion resolves.
  void find_obstructions() {
    std::vector<std::int32_t> faces;
    std::vector<std::vector<std::uint8_t>> flags(part_count_);
    for (const IntersectingPair& pair : diagnosis_.pairs) {
      if (std::binary_search(diagnosis_.obstructed.begin(), diagnosis_.obstructed.end(), pair)) continue;
      const Index part = common_part(pair);
      if (part < 0) continue;
      if (flags[part].empty()) {
        flags[part].assign(part_of_.size(), 0);
        for (std::size_t v = 0; v < part_of_.size(); ++v) flags[part][v] = part_of_[v] == part;
      }
      if (obstruction_of(prepared_, diagnosis_.components, flags[part], pair) != Obstruction::Kind::fixed_faces)
        continue;
      rigid_pairs_.push_back(pair);
      faces.insert(faces.end(), {prepared_.triangulation.polygon[pair.a], prepared_.triangulation.polygon[pair.b]});
      in_parts_.push_back(part);
    }
    if (rigid_pairs_.empty()) return;
    diagnosis_.obstructed.insert(diagnosis_.obstructed.end(), rigid_pairs_.begin(), rigid_pairs_.end());
    std::sort(diagnosis_.obstructed.begin(), diagnosis_.obstructed.end());
    sort_unique(faces);
    sort_unique(in_parts_);
    std::string names;
    for (const Index part : in_parts_) names += (names.empty() ? "" : ", ") + name(part);
    const std::string count = std::to_string(faces.size());
    diagnosis_.obstructions.push_back(
        {Obstruction::Kind::rigid_faces, std::move(faces),
         count + " faces of rigid parts intersect others of the same part (" + names + "), which moves as it is"});
  }

  /// The part that both triangles have vertices of; -1: there is none.
  Index common_part(const IntersectingPair& pair) const {
    for (const Index v : prepared_.triangles()[pair.a])
      for (const Index w : prepared_.triangles()[pair.b])
        if (part_of_[v] >= 0 && part_of_[v] == part_of_[w]) return part_of_[v];
    return -1;
  }

  // The places of the parts.

  Attempt attempt(std::span<const Index> parts_that_avoid_soft) {
    Attempt result;
    Bodies bodies(prepared_.rest, prepared_.triangles(), part_of_, part_count_, fixed_);
    for (const Index part : parts_that_avoid_soft) bodies.avoid_soft(part);
    const double diagonal = prepared_.diagonal_of(surface_.positions);
    const double limit = options_.max_displacement_rel * diagonal;
    PlaceBodiesOptions place;
    RecoverBodiesOptions recover;
    if (limit > 0) place.most_motion = recover.most_motion = limit;
    place.stop = recover.stop = limits_.stopper();
    result.is_too_far = place_bodies(bodies, place);
    float32_ = options_.precision ? *options_.precision == Precision::float32
                                  : float32_can_hold(scene(), diagnosis_.pairs, prepared_.scale);
    std::vector<Index> of_bodies;
    for (const Body& body : bodies.list())
      of_bodies.insert(of_bodies.end(), body.vertices.begin(), body.vertices.end());
    if (!of_bodies.empty())
      recover.min_gap =
          std::max(gap_of_format(scene(), of_bodies, float32_, prepared_.scale), options_.min_gap_rel * diagonal);
    if (options_.recover) recover_bodies(bodies, recover);
    result.positions = as_written(bodies.x());
    // Digits that are too few for the faces of a part would make it intersect itself.
    if (float32_ && !options_.precision && pairs_within_parts(result.positions) > rigid_pairs_.size()) {
      float32_ = false;
      result.positions = as_written(bodies.x());
    }
    return result;
  }

  const Scene& scene() {
    if (scene_.triangles.empty())
      scene_ = make_scene(prepared_.rest, {prepared_.triangles().begin(), prepared_.triangles().end()}, fixed_,
                          diagnosis_.edges);
    return scene_;
  }

  std::size_t pairs_within_parts(std::span<const double> positions) {
    std::size_t count = 0;
    for (const IntersectingPair& pair : finders_->as_is.find(prepared_.gather(positions))) {
      const auto is_whole = [&](Index t) {
        const Triangle& v = prepared_.triangles()[t];
        return part_of_[v[0]] >= 0 && part_of_[v[0]] == part_of_[v[1]] && part_of_[v[0]] == part_of_[v[2]];
      };
      const bool same = part_of_[prepared_.triangles()[pair.a][0]] == part_of_[prepared_.triangles()[pair.b][0]];
      count += same && is_whole(pair.a) && is_whole(pair.b);
    }
    return count;
  }

  /// Positions of the vertices of the surface, as they will be read back.
  std::vector<double> as_written(const Positions& x) const {
    std::vector<double> positions = prepared_.scatter(surface_.positions, x);
    if (options_.as_written) return options_.as_written(positions, float32_);
    if (float32_) round_changed_to_float32(surface_.positions, positions);
    return positions;
  }

  // The soft parts.

  /// In the phase "place", which it ends.
  Attempt repaired_attempt(const std::vector<Index>& in_soft, Phases& phases) {
    Attempt result = attempt(in_soft);
    phases.end();
    repair_around(result);
    if (result.inner.status == Status::memory_limit) limits_.run_out_of_memory();
    return result;
  }

  void repair_around(Attempt& attempt) {
    RepairOptions inner = options_;
    inner.rigid.clear();
    inner.rigid_names.clear();
    inner.fixed.resize(surface_.vertex_count(), 0);
    for (std::size_t v = 0; v < inner.fixed.size(); ++v)
      if (options_.rigid[v] >= 0) inner.fixed[v] = 1;
    if (!options_.precision && !float32_) inner.precision = Precision::float64;
    if (options_.time_limit_s > 0)
      inner.time_limit_s = std::max(options_.time_limit_s - clock_.stage("place").seconds, least_time_s);
    // A second attempt starts at nothing again, but what is told to the caller never decreases.
    const std::function<void(const Context::Progress&)> tell = context_.on_progress;
    if (tell)
      context_.on_progress = [&, tell](Context::Progress progress) {
        progress.fraction = fraction_ = std::max(fraction_, progress.fraction);
        tell(progress);
      };
    const SurfaceView placed = {attempt.positions, surface_.corners, surface_.offsets};
    // Shares of the input's diagonal, not of that with the parts in their places.
    if (const double diagonal = diagonal_of(placed); diagonal > 0) {
      inner.min_gap_rel *= diagonal_of(surface_) / diagonal;
      inner.max_displacement_rel *= diagonal_of(surface_) / diagonal;
    }
    try {
      attempt.inner = repair(placed, inner, &context_);
    } catch (...) {
      context_.on_progress = tell;
      throw;
    }
    context_.on_progress = tell;
    stages_.insert(stages_.end(), attempt.inner.report.stages.begin(), attempt.inner.report.stages.end());
  }

  /// Parts that soft faces still intersect.
  std::vector<Index> parts_in_soft(const Attempt& attempt) {
    std::vector<Index> parts;
    if (attempt.inner.report.after.total() == 0) return parts;
    for (const IntersectingPair& pair : finders_->as_is.find(prepared_.gather(attempt.inner.positions))) {
      const Triangle &a = prepared_.triangles()[pair.a], &b = prepared_.triangles()[pair.b];
      const auto is_soft = [&](const Triangle& t) {
        return std::any_of(t.begin(), t.end(), [&](Index v) { return part_of_[v] < 0 && !fixed_[v]; });
      };
      if (is_soft(b) && !is_soft(a) && part_of_[a[0]] >= 0) parts.push_back(part_of_[a[0]]);
      if (is_soft(a) && !is_soft(b) && part_of_[b[0]] >= 0) parts.push_back(part_of_[b[0]]);
    }
    sort_unique(parts);
    return parts;
  }

  RepairResult unchanged(const PairCounts& before) {
    RepairResult result;
    result.positions.assign(surface_.positions.begin(), surface_.positions.end());
    result.status = Status::memory_limit;
    result.report.before = result.report.after = before;
    result.report.topology = diagnosis_.topology;
    result.report.obstructions = diagnosis_.obstructions;
    result.report.stages = std::move(stages_);
    return result;
  }

  // The inner repair has compared with the parts in their places; the report compares with the input.

  RepairResult finished(Attempt attempt) {
    RepairResult result = std::move(attempt.inner);
    RepairReport& report = result.report;
    Positions x = prepared_.gather(result.positions);
    Acceptance::Pairs left = acceptance_->pairs_at(x);
    const bool is_taken_back = acceptance_->is_worse(left);
    if (is_taken_back) {
      result.positions.assign(surface_.positions.begin(), surface_.positions.end());
      x = prepared_.rest;
      left = acceptance_->pairs_at(x);
      result.frames.clear();
    }
    const Status inner = result.status;
    result.status = acceptance_->status(left, x);
    if (result.status == Status::reduced || result.status == Status::no_progress) {
      if (inner == Status::time_limit || inner == Status::memory_limit || inner == Status::displacement_exceeded)
        result.status = inner;
      else if (attempt.is_too_far)
        result.status = Status::displacement_exceeded;
    }
    result.status = limits_.status_of_result(result.status);
    if (inner == Status::cancelled) result.status = inner;
    report.before = acceptance_->pairs_at(prepared_.rest).faces;
    report.after = left.faces;
    report.topology = diagnosis_.topology;
    report.obstructions = diagnosis_.obstructions;
    report.float32_embedded = acceptance_->is_embedded_in_float32(x);
    report.stages = std::move(stages_);
    const double inner_diagonal = report.diagonal;
    measure_change(surface_, prepared_, diagnosis_, result.positions, report);
    if (report.diagonal > 0) {
      const double unit = inner_diagonal / report.diagonal;
      report.min_gap_rel *= unit;
      for (RegionReport& region : report.regions) {
        region.depth_rel *= unit;
        region.displacement_rel *= unit;
      }
    }
    if (options_.max_displacement_rel > 0 && report.displacement_max_rel > options_.max_displacement_rel)
      result.status = Status::displacement_exceeded;
    report.components.clear();
    measure_components(prepared_, diagnosis_, left.triangles, report);
    explain(left, is_taken_back, attempt.is_too_far, report);
    name_duplicates_by_other_cuts(left.by_other_cuts, report);
    measure_rigid_parts(surface_, options_, part_count_, result.positions, report);
    if (!result.frames.empty())
      begin_with_input(surface_, attempt.positions, acceptance_->pairs_at(prepared_.rest).of_faces, result.frames);
    return result;
  }

  /// Lists the pairs left with the reasons that the inner repair found, except for rigid parts, which it saw as fixed.
  void explain(const Acceptance::Pairs& left, bool is_taken_back, bool is_too_far, RepairReport& report) const {
    std::map<std::pair<Index, Index>, LeftPair> found;
    for (const LeftPair& pair : report.left) found.emplace(std::pair{pair.a, pair.b}, pair);
    std::map<std::pair<Index, Index>, LeftReason> obstructed;
    const std::vector<Index>& polygon = prepared_.triangulation.polygon;
    for (const IntersectingPair& pair : diagnosis_.obstructed) {
      LeftReason reason = LeftReason::fixed_faces;
      if (std::binary_search(rigid_pairs_.begin(), rigid_pairs_.end(), pair))
        reason = LeftReason::rigid_faces;
      else if (pair.kind == PairClass::duplicate)
        reason = LeftReason::duplicate_faces;
      else if (diagnosis_.components.list[diagnosis_.components.component_of_triangle[pair.a]].obstructed())
        reason = LeftReason::closed_non_orientable;
      const auto [a, b] = std::minmax(polygon[pair.a], polygon[pair.b]);
      obstructed.emplace(std::pair{a, b}, reason);
    }
    for (const IntersectingPair& pair : left.by_other_cuts)
      if (const auto tolerated = acceptance_->tolerance_by_other_cuts(pair))
        obstructed.emplace(std::pair{pair.a, pair.b}, *tolerated);
    report.left.clear();
    report.left_by_reason = {};
    for (const IntersectingPair& pair : left.of_faces) {
      LeftPair entry{pair.a, pair.b, pair.kind, LeftReason::unresolved, {}};
      const auto known = found.find({pair.a, pair.b});
      if (const auto own = obstructed.find({pair.a, pair.b}); own != obstructed.end())
        entry.reason = own->second;
      else if (is_taken_back)
        entry.reason = LeftReason::taken_back;
      else if (known != found.end() && known->second.reason != LeftReason::fixed_faces)
        entry = known->second;
      else if (is_too_far)
        entry.reason = LeftReason::displacement;
      ++report.left_by_reason[static_cast<std::size_t>(entry.reason)];
      report.left.push_back(std::move(entry));
    }
  }

  static constexpr double least_time_s = 1e-3;  // that is left to what follows: 0 would be no limit

  const SurfaceView surface_;
  const RepairOptions& options_;
  Context& context_;
  Limits limits_;
  ThreadLimit threads_;
  StageClock clock_;
  std::vector<StageReport> stages_;
  PreparedSurface prepared_;
  std::vector<std::uint8_t> fixed_;  // of the welded vertices
  std::vector<Index> part_of_;       // of the welded vertices
  Index part_count_ = 0;
  std::optional<Finders> finders_;
  Diagnosis diagnosis_;
  std::vector<IntersectingPair> rigid_pairs_;  // within a part, sorted
  std::vector<Index> in_parts_;                // these parts
  std::optional<Acceptance> acceptance_;
  Scene scene_;  // at rest; made when first asked for
  bool float32_ = false;
  double fraction_ = 0;  // of the progress that was told
};

}  // namespace

RepairResult repair_with_rigid_parts(const SurfaceView& surface, const RepairOptions& options, Context& context) {
  return RigidRepair(surface, options, context).run();
}

}  // namespace unsnarl
