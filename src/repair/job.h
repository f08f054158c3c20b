#pragma once

#include <vector>

#include "repair/diagnose.h"
#include "repair/limits.h"
#include "repair/phases.h"
#include "repair/prepared_surface.h"
#include "repair/recorder.h"
#include "repair/tried.h"
#include "unsnarl/repair.h"

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
  Tried& tried;
  std::vector<RegionReport>& regions;
};

}  // namespace unsnarl
