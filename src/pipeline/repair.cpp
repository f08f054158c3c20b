#include "unsnarl/repair.h"

#include <fmt/core.h>

#include <new>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "contact/stop_check.h"
#include "geometry/parallel.h"
#include "mesh/areas.h"
#include "pipeline/conclude.h"
#include "pipeline/dihedral_stage.h"
#include "pipeline/gap_stage.h"
#include "pipeline/nesting_stage.h"
#include "pipeline/repair_from.h"
#include "pipeline/repair_state.h"
#include "pipeline/repair_task.h"
#include "pipeline/rigid_stage.h"
#include "pipeline/triangulation_stage.h"
#include "pipeline/untangle_stage.h"
#include "run/calling_thread.h"
#include "run/limits.h"
#include "run/phases.h"
#include "scene/pair_census.h"
#include "unsnarl/limit_reached.h"

namespace unsnarl {
namespace {

/// The widest gap that may be asked for: the pairs of faces that have to keep it, and with them memory, grow with its
/// square (unit: mean_equilateral_side of the faces)
constexpr double widest_gap_in_sides = 8;

/// Throws GapTooWide where a gap is to be opened that is too wide for the faces.
void check_gap(const RepairTask& task, const RepairState& state) {
  if (task.options.gap_near_conflicts && state.pairs_at_rest.empty() && !(task.options.min_dihedral_deg > 0))
    return;  // no gap is opened
  const double gap = task.options.min_gap_rel * task.diagonal;
  const double side = mean_equilateral_side(task.prepared.rest, task.prepared.triangles());
  if (gap > widest_gap_in_sides * side)
    throw GapTooWide(
        fmt::format("a gap of {:.3g} ({:.3g} % of the diagonal) is {:.3g} times as wide as the faces; {:.3g} is the "
                    "most. Gaps are "
                    "shares of the diagonal unless said to be absolute",
                    gap, 100 * task.options.min_gap_rel, gap / side, widest_gap_in_sides * side));
}

void diagnose_within_limits(RepairTask& task, const RepairControl& control, Finders& finders) {
  try {
    task.diagnose(finders.as_is, control.limits.stopper_but_for_cancellation());
  } catch (const WorkStopped&) {
    throw LimitReached(control.limits.status_or(Status::time_limit));
  }
}

/// Repairs what is not held, from state.scene.rest on.
void repair_shapes(const RepairTask& task, const RepairControl& control, Finders& finders, RepairState& state) {
  leave_what_may_stay(task, finders, state);
  if (has_work(task, finders, state) || !task.prepared.other_diagonals.triangles.empty()) {
    start_stage(task, control, finders, state);
    nesting_stage(task, control, finders, state);
    untangle_stage(task, control, finders, state);
    triangulation_stage(task, control, finders, state);
  }
  gap_stage(task, control, state);
  dihedral_stage(task, control, state);
}

/// All stages, in order. Where memory runs out, the state is what was reached. `finders`: of the scene's triangles.
void run_stages(const RepairTask& task, const RepairControl& control, std::span<const Index> clear_of_soft,
                Finders& finders, RepairState& state) {
  try {
    rigid_stage(task, control, clear_of_soft, finders, state);
    check_gap(task, state);
    state.format.choose(state.scene, state.pairs_at_rest);
    repair_shapes(task, control, finders, state);
  } catch (const std::bad_alloc&) {
    control.limits.run_out_of_memory();
    state.scene.x = state.format.as_written(state.scene.x);
  }
  keep_within_displacement(task, finders.as_is, state);
}

/// What all stages reach from the input on. Rigid parts that what is soft could not be repaired around give way to it
/// in a second attempt; the better one counts.
RepairState repaired(const RepairTask& task, const RepairControl& control, Finders& finders, PairCensus& census) {
  RepairState best(task);
  run_stages(task, control, {}, finders, best);
  if (task.policy.rigid_parts().count == 0 || control.limits.reached()) return best;
  try {
    const std::vector<Index> in_soft = parts_in_soft(task, finders, best);
    if (in_soft.empty()) return best;
    RepairState other(task);
    run_stages(task, control, in_soft, finders, other);
    if (census.at(other.scene.x).faces.total() < census.at(best.scene.x).faces.total()) return other;
  } catch (const std::bad_alloc&) {
    control.limits.run_out_of_memory();
  }
  return best;
}

RepairResult run(RepairTask& task, const RepairControl& control, Finders& finders) {
  diagnose_within_limits(task, control, finders);
  PairCensus census(task.surface, task.prepared, task.options.find, finders, task.diagnosis.pairs);
  try {
    std::optional<Finders> of_scene;  // triangles of two groups pass through each other
    if (task.options.each_component)
      of_scene.emplace(task.prepared.triangles(), task.prepared.scale,
                       task.prepared.passing(task.diagnosis.components.component_of_vertex));
    return conclude(task, control, census, repaired(task, control, of_scene ? *of_scene : finders, census));
  } catch (const std::bad_alloc&) {  // the result cannot be examined, so it is none
    control.limits.run_out_of_memory();
    return unchanged(task, census, Status::memory_limit);
  }
}

/// Runs work(control) under the limits that the options set, and notes how long its phases take.
template <class Work>
RepairResult run_under_control(const RepairOptions& options, Context& context, const Work& work) {
  Limits limits(options, context);
  const ThreadLimit threads(options.find.threads);
  std::vector<StageReport> stages;
  Phases phases(context, stages);
  phases.start("diagnose");
  RepairResult result = work(RepairControl{limits, phases});
  phases.end();
  result.report.stages = std::move(stages);
  return result;
}

RepairResult repair_surface(const SurfaceView& surface, const Nesting* nesting, const RepairOptions& options,
                            Context* context) {
  return work_reporting_here(context, [&](Context& own) {
    return run_under_control(options, own, [&](const RepairControl& control) {
      RepairTask task(surface, options, nesting);
      Finders finders(task.prepared.triangles(), task.prepared.scale, task.prepared.passing());
      return run(task, control, finders);
    });
  });
}

}  // namespace

RepairResult repair(const SurfaceView& surface, const RepairOptions& options, Context* context) {
  return repair_surface(surface, nullptr, options, context);
}

RepairResult repair_nested(const SurfaceView& surface, const Nesting& nesting, const RepairOptions& options,
                           Context* context) {
  return repair_surface(surface, &nesting, options, context);
}

RepairResult repair_from(const SurfaceView& surface, const KnownSurface& known, Finders& finders,
                         const RepairOptions& options, Context* context, std::optional<Positions> start) {
  Context own;
  return run_under_control(options, context ? *context : own, [&](const RepairControl& control) {
    RepairTask task(surface, options, known.prepared, known.topology, std::move(start));
    return run(task, control, finders);
  });
}

}  // namespace unsnarl
