#pragma once

#include <functional>
#include <span>
#include <vector>

#include "scene/recorder.h"
#include "scene/scene.h"
#include "scene/scene_index.h"
#include "unsnarl/intersections.h"
#include "untangle/ladder.h"

namespace unsnarl {

/// How another way is gone: untangled by LadderOptions::Strategies::second_way, with these pairs let be, and recovered.
struct SecondWay {
  std::function<LadderResult(std::span<const IntersectingPair> ignored)> untangle;
  std::function<double(const std::vector<std::vector<Index>>& regions)> recover;  ///< returns the least gap
  std::function<bool()> stop;
};

/// Contours may be driven a long way off a sheet where whole sheets that repel each other part at once: tries that on
/// the regions of `climbed` that have gone far, from rest, and keeps what lies closer. Those that went by whole
/// components before are left alone. `pairs`: those of the scene at rest; `ignored` (sorted) are let be. Returns the
/// least gap of what was kept, or infinity.
double take_closer_ways(Scene& scene, SceneIndex& index, LadderResult& climbed, std::span<const IntersectingPair> pairs,
                        std::span<const IntersectingPair> ignored, const SecondWay& way, Recorder& recorder);

}  // namespace unsnarl
