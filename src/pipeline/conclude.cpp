#include "pipeline/conclude.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "mesh/areas.h"
#include "pipeline/gap_stage.h"
#include "report/changed_components.h"
#include "report/left_pairs.h"
#include "report/measure.h"
#include "report/recorded_frames.h"
#include "report/rigid_report.h"
#include "scene/overlapping_components.h"

namespace unsnarl {
namespace {

/// Positions, and the pairs at them.
struct Reached {
  Positions x;
  PairCensus::Pairs left;
};

/// Components that were repaired as if alone may run into each other: takes them over one by one, without those that
/// make it worse.
Reached what_makes_nothing_worse(const RepairTask& task, const RepairControl& control, PairCensus& census,
                                 const Positions& wanted) {
  const Positions& rest = task.prepared.rest;
  const Components& components = task.diagnosis.components;
  std::vector<std::vector<Index>> vertices(components.count());
  for (Index v = 0; v < wanted.cols(); ++v) {
    const Index component = components.component_of_vertex[v];
    if (component >= 0 && wanted.col(v) != rest.col(v)) vertices[component].push_back(v);
  }
  Positions x = rest;
  for (const std::vector<Index>& component : vertices) {
    if (component.empty() || control.limits.reached()) continue;
    for (const Index v : component) x.col(v) = wanted.col(v);
    if (!census.at(x).are_more_than(census.before())) continue;
    for (const Index v : component) x.col(v) = rest.col(v);
  }
  PairCensus::Pairs left = census.at(x);
  return {std::move(x), std::move(left)};
}

/// What was reached, or so much of it as has no more pairs than before.
Reached taken_back(const RepairTask& task, const RepairControl& control, PairCensus& census, const RepairState& state) {
  Reached reached = {state.scene.x, census.at(state.scene.x)};
  // Rigid parts in their places come before, where that is no worse than the input.
  const bool has_places = state.scene.rest != task.prepared.rest;
  if (has_places && reached.x != state.scene.rest) {
    const PairCensus::Pairs at_places = census.at(state.scene.rest);
    if (reached.left.are_more_than(at_places)) reached = {state.scene.rest, at_places};
  }
  if (!reached.left.are_more_than(census.before())) return reached;
  if (task.options.each_component) return what_makes_nothing_worse(task, control, census, reached.x);
  return {task.prepared.rest, census.before()};
}

/// The status of a result that has this one by its pairs and is otherwise as the report says.
Status final_status(const RepairTask& task, const RepairControl& control, Status by_pairs,
                    bool displacement_is_exceeded, const RepairReport& report) {
  const double limit = task.options.max_displacement_rel;
  if (limit > 0 && report.displacement_max_rel > limit) return Status::displacement_exceeded;
  Status status = by_pairs;
  if (status == Status::reduced || status == Status::no_progress)
    status = control.limits.status_or(displacement_is_exceeded ? Status::displacement_exceeded : status);
  const PairCounts& allowed = report.allowed_after;
  const bool is_any_allowed = (task.options.goal == Goal::all ? allowed.total() : allowed[PairClass::disjoint]) > 0;
  if (status == Status::embedded && report.gap && !report.gap->is_met())
    status = control.limits.status_or(Status::gap_not_met);
  if (is_resolved(status) && is_any_allowed) status = Status::allowed;
  return control.limits.status_of_result(status);
}

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

std::vector<RegionHistory> history_of(const RepairTask& task, const RepairState& state) {
  std::vector<RegionHistory> history = state.recorder.history();
  for (RegionHistory& region : history) put_into_units_of_file(task.prepared, region);
  return history;
}

/// What is known of the input.
RepairReport report_of_input(const RepairTask& task, const PairCensus& census) {
  RepairReport report;
  report.topology = task.diagnosis.topology;
  report.triangulation = task.prepared.triangulation.statistics.describe();
  report.obstructions = task.diagnosis.obstructions;
  report.before = report.after = census.before().faces;
  report.allowed_before = report.allowed_after = census.allowed_at(task.prepared.rest);
  return report;
}

/// Components that overlapped in the input, and those that are no longer what they were.
void describe_parts(const RepairTask& task, const Positions& x, RepairReport& report) {
  const Components& components = task.diagnosis.components;
  report.overlapping_components =
      overlapping_components(task.prepared, components, meeting_components(components, task.diagnosis.pairs));
  report.changed_components =
      changed_components(task.prepared, task.diagnosis, x, task.options.min_gap_rel * task.diagonal, task.diagonal);
}

void list_left_pairs(const RepairTask& task, const RepairControl& control, const RepairState& state,
                     const Reached& reached, RepairReport& report) {
  const Ending ending = {task.policy,
                         task.diagnosis.components,
                         state.attempts,
                         state.scene.fixed,
                         control.limits.status_or(Status::reduced),
                         reached.x};
  explain_left_pairs(task.surface, task.prepared, ending, reached.left, report);
  name_duplicates_by_other_cuts(reached.left.by_other_cuts, report);
  if (task.options.each_component)
    name_pairs_between_components(task.prepared, task.diagnosis, reached.left.triangles, report);
}

}  // namespace

Status status_at(const RepairTask& task, PairCensus& census, const PairCensus::Pairs& left, const Positions& x) {
  const auto may_stay = [&](const IntersectingPair& pair) {
    const std::span<const Triangle> triangles = task.prepared.triangles();
    return task.policy.reason_to_leave(triangles[pair.a], triangles[pair.b], pair.kind).has_value();
  };
  const auto may_faces_stay = [&](const IntersectingPair& pair) {
    return reason_to_leave_faces(task.surface, task.prepared, task.diagnosis.components, task.policy, pair).has_value();
  };
  const bool is_done = std::all_of(left.triangles.begin(), left.triangles.end(), may_stay) &&
                       std::all_of(left.by_other_cuts.begin(), left.by_other_cuts.end(), may_faces_stay) &&
                       count_lost_areas(task.prepared.rest, x, task.prepared.triangles()) == 0;
  const auto is_reached = [&](const PairCounts& pairs) {
    return task.options.goal == Goal::all ? pairs.total() == 0 : pairs[PairClass::disjoint] == 0;
  };
  const auto holds_in_float32 = [&] {
    return fits_float32(x, task.prepared.scale) && is_reached(count_by_class(census.in_float32(x)));
  };
  if (is_done && !is_reached(left.faces)) return Status::obstructed;
  if (is_done && (task.options.precision != Precision::float32 || holds_in_float32())) return Status::embedded;
  return left.faces.total() < census.before().faces.total() ? Status::reduced : Status::no_progress;
}

RepairResult conclude(const RepairTask& task, const RepairControl& control, PairCensus& census,
                      const RepairState& state) {
  control.phases.start("certify");
  const Reached reached = taken_back(task, control, census, state);
  RepairResult result;
  result.positions = task.prepared.scatter(task.surface.positions, reached.x);
  RepairReport& report = result.report = report_of_input(task, census);
  report.after = reached.left.faces;
  if (reached.x != task.prepared.rest) report.allowed_after = census.allowed_at(reached.x);
  report.precision = state.format.float32() ? Precision::float32 : Precision::float64;
  report.float32_embedded = census.is_embedded_in_float32(reached.x);
  report.regions = state.regions;
  report.before_recovery = state.before_recovery;
  measure_change(task.surface, task.prepared, task.diagnosis, result.positions, report);
  report.min_gap_rel = std::isfinite(state.smallest_gap) && task.diagonal > 0 ? state.smallest_gap / task.diagonal : 0;
  report.gap = measured_gap(task, state, reached.x, reached.left.triangles);
  result.status = final_status(task, control, status_at(task, census, reached.left, reached.x),
                               state.displacement_is_exceeded, report);
  measure_components(task.prepared, task.diagnosis, reached.left.triangles, report);
  describe_parts(task, reached.x, report);
  list_left_pairs(task, control, state, reached, report);
  measure_rigid_parts(task.surface, task.options, task.policy.rigid_parts(), result.positions, report);
  report.history = history_of(task, state);
  result.frames = recorded_frames(state.recorder, task.surface, task.prepared, result.positions, census);
  control.phases.report(1, reached.left.of_faces.size(), reached.x, task.prepared.rest, task.diagonal);
  return result;
}

RepairResult unchanged(const RepairTask& task, const PairCensus& census, Status status) {
  RepairResult result;
  result.positions.assign(task.surface.positions.begin(), task.surface.positions.end());
  result.report = report_of_input(task, census);
  result.status = status;
  return result;
}

}  // namespace unsnarl
