#pragma once

#include <functional>
#include <vector>

#include "recover/recover.h"
#include "scene/recorder.h"
#include "scene/scene.h"
#include "scene/scene_index.h"

namespace unsnarl {

struct RecoverRegionsOptions {
  RecoverOptions recover;  ///< all but min_gap
  std::function<double(std::span<const Index> vertices)> min_gap;
  double least_reach = 0;  ///< faces this near to a region are its obstacles, others only a few edges away: a length
  std::function<bool()> stop;
  std::function<void(double share_done)> on_progress;  ///< a few times a second, from any thread; may be empty
};

/// Recovers every region (its free vertices, ascending; no two regions share one) while everything around it is held.
/// Regions that do not disturb each other run in parallel; the result is that of one after the other. Returns the least
/// gap that was reached, or infinity.
double recover_regions(Scene& scene, SceneIndex& index, const std::vector<std::vector<Index>>& regions,
                       const RecoverRegionsOptions& options, Recorder& recorder);

}  // namespace unsnarl
