#include "unsnarl/repair.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <new>
#include <optional>
#include <stdexcept>
#include <utility>

#include "contact/stop_check.h"
#include "mesh/areas.h"
#include "pipeline/job.h"
#include "pipeline/nesting.h"
#include "pipeline/repair_from.h"
#include "pipeline/rigid_repair.h"
#include "pipeline/scene_repair.h"
#include "pipeline/settle_triangulation.h"
#include "pipeline/triangulations.h"
#include "report/acceptance.h"
#include "report/left_pairs.h"
#include "report/measure.h"
#include "report/recorded_frames.h"
#include "run/calling_thread.h"
#include "run/limits.h"
#include "run/phases.h"
#include "run/thread_limit.h"
#include "scene/diagnose.h"
#include "scene/finders.h"
#include "scene/prepared_surface.h"
#include "scene/recorder.h"
#include "unsnarl/limit_reached.h"
#include "untangle/attempt_log.h"
#include "untangle/paper_untangle.h"
#include "untangle/strategies.h"

namespace unsnarl {
namespace {

/// The widest gap, in mean sides of the faces (mean_equilateral_side): the pairs of faces that have to keep it grow
/// with its square. Two tubes of 10,560 triangles take 1.4 GB and 39 s at 2.8 sides, 5 GB and 67 s at 5.6; a gap of 0.3
/// that was meant as a length, but is a share of the diagonal, is 21 and took all of 24 GB.
constexpr double widest_gap_in_sides = 8;

/// Lengths and vertices as they are at work -> those of the input.
void put_into_units_of_file(const PreparedSurface& prepared, RegionHistory& region) {
  const Scale& scale = prepared.scale;
  for (IterationRecord& iteration : region.iterations) {
    for (double* length : {&iteration.step, &iteration.min_gap}) *length = scale.out(*length);
    for (double& length : iteration.bandwidth) length = scale.out(length);
  }
  if (region.bandwidths.empty()) return;
  std::vector<double> of_file;
  for (const Index v : prepared.weld_map.vertex_of) of_file.push_back(scale.out(region.bandwidths[v]));
  region.bandwidths = std::move(of_file);
}

class Repair {
 public:
  /// `known` and `finders`: as in repair_from(), or null. `nesting`: null for none.
  Repair(const SurfaceView& surface, const KnownSurface* known, Finders* finders, const Nesting* nesting,
         const RepairOptions& options, Context& context)
      : surface_(surface),
        known_(known),
        finders_(finders),
        nesting_(nesting),
        options_(options),
        limits_(options, context),
        threads_(options.find.threads),
        phases_(context, result_.report.stages) {}

  RepairResult run() {
    check_options();
    phases_.start("diagnose");
    prepare_surface();
    if (nesting_) {
      nested_ = nested_surfaces(surface_, prepared_, *nesting_);
      require_order_is_possible(*nested_, prepared_.rest, *nesting_);
    }
    diagonal_ = prepared_.diagonal_of(surface_.positions);
    std::vector<std::uint8_t> fixed(prepared_.weld_map.count, 0);
    for (std::size_t v = 0; v < options_.fixed.size(); ++v)
      if (options_.fixed[v]) fixed[prepared_.weld_map.vertex_of[v]] = 1;
    diagnose_within_limits(fixed);
    check_gap();
    result_.report.topology = diagnosis_.topology;
    result_.report.triangulation = prepared_.triangulation.statistics.describe();
    result_.report.obstructions = diagnosis_.obstructions;
    acceptance_.emplace(surface_, prepared_, diagnosis_, options_, *finders_);
    recorder_.emplace(options_.record, prepared_.rest);
    result_.report.before = result_.report.after = acceptance_->pairs_at(prepared_.rest).faces;
    result_.positions.assign(surface_.positions.begin(), surface_.positions.end());
    reached_ = prepared_.rest;
    attempts_.emplace(prepared_.rest);
    job_.emplace(Job{surface_, options_, prepared_, diagnosis_, diagonal_, limits_, *recorder_, phases_, *attempts_,
                     result_.report.regions, nested_ ? &*nested_ : nullptr});
    try {
      work_on(std::move(fixed));
    } catch (const std::bad_alloc&) {
      limits_.run_out_of_memory();
    }
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
  void prepare_surface() {
    if (known_) {
      prepared_ = known_->prepared;
      prepared_.rest = prepared_.gather(surface_.positions);
      diagnosis_ = known_->topology;
      return;
    }
    prepared_ = prepare(surface_, options_.find);
    diagnosis_ = diagnose_topology(surface_, prepared_);
    finders_ = &own_finders_.emplace(prepared_.triangles(), prepared_.scale);
  }

  void diagnose_within_limits(std::span<const std::uint8_t> fixed) {
    try {
      diagnose_intersections(prepared_, fixed, finders_->as_is, diagnosis_, limits_.stopper_but_for_cancellation());
    } catch (const WorkStopped&) {
      throw LimitReached(limits_.status_or(Status::time_limit));
    }
  }

  void check_options() const {
    if (!options_.fixed.empty() && options_.fixed.size() != surface_.vertex_count())
      throw std::invalid_argument("RepairOptions::fixed has " + std::to_string(options_.fixed.size()) + " flags for " +
                                  std::to_string(surface_.vertex_count()) + " vertices");
    if (!(options_.min_gap_rel >= 0) || !(options_.max_displacement_rel >= 0) || !(options_.time_limit_s >= 0) ||
        !(options_.memory_limit_mb >= 0))
      throw std::invalid_argument("RepairOptions: gaps, displacements and limits must not be negative");
    if (!(options_.min_dihedral_deg >= 0 && options_.min_dihedral_deg < 90))
      throw std::invalid_argument("RepairOptions::min_dihedral_deg is " + std::to_string(options_.min_dihedral_deg) +
                                  "; give degrees from 0 to less than 90");
    if (options_.paper) check_paper_options(*options_.paper);
    for (const std::string& name : options_.without_strategies)
      if (strategy_number(name) < 0)
        throw std::invalid_argument("RepairOptions::without_strategies: there is no strategy '" + name + "'");
  }

  void check_gap() const {
    if (diagnosis_.pairs.empty() && !(options_.min_dihedral_deg > 0)) return;  // no gap is opened
    const double gap = options_.min_gap_rel * diagonal_;
    const double side = mean_equilateral_side(prepared_.rest, prepared_.triangles());
    if (gap > widest_gap_in_sides * side)
      throw GapTooWide(
          fmt::format("a gap of {:.3g}, {:.3g} % of the diagonal, is {:.3g} times as wide as the faces; {:.3g} is the "
                      "most. Gaps are "
                      "shares of the diagonal unless said to be absolute",
                      gap, 100 * options_.min_gap_rel, gap / side, widest_gap_in_sides * side));
  }

  void work_on(std::vector<std::uint8_t> fixed) {
    const Triangulation& cut = prepared_.triangulation;
    std::vector<IntersectingPair> pairs = diagnosis_.pairs, ignored;
    std::optional<Finders> of_each;
    if (options_.each_component) {
      std::erase_if(pairs, [&](const auto& pair) { return are_of_two_components(diagnosis_.components, pair); });
      of_each.emplace(cut.triangles, prepared_.scale, VertexGroups(diagnosis_.components.component_of_vertex));
    }
    Finders& finders = of_each ? *of_each : *finders_;
    for (const IntersectingPair& pair : pairs)
      if (acceptance_->is_tolerated(pair)) ignored.push_back(pair);
    Scene surface = make_scene(prepared_.rest, cut.triangles, std::move(fixed), diagnosis_.edges);
    surface.face_of = cut.polygon;
    if (options_.each_component) surface.group_of = diagnosis_.components.component_of_vertex;
    SceneRepair scene(*job_, std::move(surface), std::move(pairs), std::move(ignored));
    float32_ = scene.float32();
    const bool is_at_work = scene.has_work(finders) || !prepared_.other_diagonals.triangles.empty();
    if (!is_at_work && options_.min_dihedral_deg <= 0) return;
    try {
      if (is_at_work) {
        scene.work(finders);
        settle_triangulation(scene, *job_, finders);
      }
      if (options_.min_dihedral_deg > 0) {
        // Settling may have united several cuts.
        Finders finders_of_all_cuts = scene.make_finders();
        scene.open_dihedrals(finders_of_all_cuts);
      }
    } catch (const std::bad_alloc&) {
      limits_.run_out_of_memory();
      scene.round();
    }
    scene.keep_within_displacement(finders.as_is);
    displacement_is_exceeded_ = scene.displacement_is_exceeded();
    smallest_gap_ = scene.smallest_gap();
    float32_ = scene.float32();
    reached_ = scene.scene().x;
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
      if (component.empty() || limits_.reached()) continue;
      for (Index v : component) reached_.col(v) = wanted.col(v);
      if (!acceptance_->is_worse(acceptance_->pairs_at(reached_))) continue;
      for (Index v : component) reached_.col(v) = prepared_.rest.col(v);
    }
  }

  void finish() {
    phases_.start("certify");
    RepairReport& report = result_.report;
    report.precision = float32_ ? Precision::float32 : Precision::float64;
    Acceptance::Pairs left = acceptance_->pairs_at(reached_);
    if (acceptance_->is_worse(left)) {
      if (options_.each_component)
        take_over_what_makes_nothing_worse();
      else
        reached_ = prepared_.rest;
      left = acceptance_->pairs_at(reached_);
    }
    result_.positions = prepared_.scatter(surface_.positions, reached_);
    report.after = left.faces;
    result_.status = acceptance_->status(left, reached_);
    if (result_.status == Status::reduced || result_.status == Status::no_progress)
      result_.status = limits_.status_or(displacement_is_exceeded_ ? Status::displacement_exceeded : result_.status);
    result_.status = limits_.status_of_result(result_.status);
    report.float32_embedded = acceptance_->is_embedded_in_float32(reached_);
    measure_change(surface_, prepared_, diagnosis_, result_.positions, report);
    report.min_gap_rel = std::isfinite(smallest_gap_) && diagonal_ > 0 ? smallest_gap_ / diagonal_ : 0;
    if (options_.max_displacement_rel > 0 && report.displacement_max_rel > options_.max_displacement_rel)
      result_.status = Status::displacement_exceeded;
    measure_components(prepared_, diagnosis_, left.triangles, report);
    explain_left_pairs(prepared_, diagnosis_, options_, limits_.status_or(Status::reduced), *attempts_, *acceptance_,
                       left, reached_, report);
    name_duplicates_by_other_cuts(left.by_other_cuts, report);
    if (options_.each_component) name_pairs_between_components(prepared_, diagnosis_, left.triangles, report);
    report.history = recorder_->history();
    for (RegionHistory& region : report.history) put_into_units_of_file(prepared_, region);
    result_.frames = recorded_frames(*recorder_, surface_, prepared_, result_.positions, *acceptance_);
    phases_.report(1, left.of_faces.size(), reached_, prepared_.rest, diagonal_);
    phases_.end();
  }

  const SurfaceView surface_;
  const KnownSurface* const known_;
  std::optional<Finders> own_finders_;  // where there are no others
  Finders* finders_;                    // of the prepared triangles
  const Nesting* const nesting_;
  const RepairOptions& options_;
  Limits limits_;
  ThreadLimit threads_;
  RepairResult result_;
  Phases phases_;
  PreparedSurface prepared_;
  double diagonal_ = 0;
  Diagnosis diagnosis_;
  std::optional<NestedSurfaces> nested_;
  std::optional<Acceptance> acceptance_;
  std::optional<Recorder> recorder_;
  std::optional<AttemptLog> attempts_;
  std::optional<Job> job_;
  Positions reached_;  // of all vertices
  bool float32_ = false, displacement_is_exceeded_ = false;
  double smallest_gap_ = std::numeric_limits<double>::infinity();
};

}  // namespace

RepairResult repair(const SurfaceView& surface, const RepairOptions& options, Context* context) {
  return work_reporting_here(context, [&](Context& own) {
    if (!options.rigid.empty()) return repair_with_rigid_parts(surface, options, own);
    return Repair(surface, nullptr, nullptr, nullptr, options, own).run();
  });
}

RepairResult repair_nested(const SurfaceView& surface, const Nesting& nesting, const RepairOptions& options,
                           Context* context) {
  if (!options.rigid.empty() || options.each_component || options.paper)
    throw std::invalid_argument(
        "RepairOptions: rigid, each_component and paper know nothing of surfaces inside each other; leave them or the "
        "nesting out");
  return work_reporting_here(
      context, [&](Context& own) { return Repair(surface, nullptr, nullptr, &nesting, options, own).run(); });
}

RepairResult repair_from(const SurfaceView& surface, const KnownSurface& known, Finders& finders,
                         const RepairOptions& options, Context* context) {
  Context own;
  return Repair(surface, &known, &finders, nullptr, options, context ? *context : own).run();
}

}  // namespace unsnarl
