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
  std::function<bool()> stop;
  std::function<void(double share_done)> on_progress;  ///< a few times a second, from any thread; none: nobody is told
};

/// Recovers every region (free vertices, ascending; no two regions share one) with all around it held, those that do
/// not disturb each other in parallel; as one after the other. Returns the least gap that was reached, or infinity.
double recover_regions(Scene& scene, SceneIndex& index, const std::vector<std::vector<Index>>& regions,
                       const RecoverRegionsOptions& options, Recorder& recorder);

}  // namespace unsnarl
