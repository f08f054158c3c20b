#pragma once

#include <vector>

#include "run/limits.h"
#include "run/phases.h"
#include "scene/diagnose.h"
#include "scene/nested_surfaces.h"
#include "scene/prepared_surface.h"
#include "scene/recorder.h"
#include "unsnarl/repair.h"
#include "untangle/attempt_log.h"

namespace unsnarl {

/// What all work on one surface shares: what is asked for, what was found out about it, and whom it reports to.
struct Job {
  const SurfaceView& surface;
  const RepairOptions& options;
  const PreparedSurface& prepared;
  const Diagnosis& diagnosis;
  double diagonal;
  Limits& limits;
  Recorder& recorder;
  Phases& phases;
  AttemptLog& attempts;
  std::vector<RegionReport>& regions;
  const NestedSurfaces* nested;  ///< null: it does not matter which surface is inside which
};

}  // namespace unsnarl
