#pragma once

#include <utility>
#include <vector>

#include "pipeline/repair_state.h"
#include "pipeline/repair_task.h"
#include "run/limits.h"
#include "run/phases.h"
#include "scene/finders.h"
#include "unsnarl/repair.h"

namespace unsnarl {

/// A repair whose stages a test calls one by one.
struct StagedRepair {
  explicit StagedRepair(Surface given, RepairOptions asked = {})
      : surface(std::move(given)),
        options(std::move(asked)),
        limits(options, context),
        phases(context, stages),
        control{limits, phases},
        task(surface, options, nullptr),
        finders(task.prepared.triangles(), task.prepared.scale),
        state(diagnosed()) {}

  std::size_t pairs() { return finders.as_is.find(state.scene.x).size(); }

  const Surface surface;
  const RepairOptions options;
  Context context;
  Limits limits;
  std::vector<StageReport> stages;
  Phases phases;
  RepairControl control;
  RepairTask task;
  Finders finders;  ///< of the input's cut
  RepairState state;

 private:
  RepairState diagnosed() {
    task.diagnose(finders.as_is, {});
    RepairState at_rest(task);
    at_rest.format.choose(at_rest.scene, at_rest.pairs_at_rest);
    leave_what_may_stay(task, finders, at_rest);
    return at_rest;
  }
};

}  // namespace unsnarl
