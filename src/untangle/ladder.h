#pragma once

#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "scene/patch.h"
#include "scene/recorder.h"
#include "scene/scene.h"
#include "unsnarl/intersections.h"
#include "unsnarl/repair.h"
#include "untangle/attempt_log.h"

namespace unsnarl {

struct LadderOptions {
  std::function<bool()> stop;
  std::function<void(std::size_t pairs_left)> on_progress;
  /// Distance that faces have to have in the end (RecoverOptions::min_gap) around these vertices; none: any.
  std::function<double(std::span<const Index> vertices)> min_gap;
  /// Asked about a patch that a strategy resolved (from any thread); may improve it. False: the region climbs on.
  /// Regions that are not resolved then stay where they are.
  std::function<bool(Patch& patch)> accept;
  enum class Strategies {
    all,
    of_coarser_mesh,  ///< see strategies.h
    gentle,           ///< those that move only what lies close to the conflict, once
    second_way,  ///< the first flows of whole components, once: for what gentler strategies have resolved by going far
  };
  Strategies strategies = Strategies::all;
  std::size_t good_enough = 0;   ///< pairs left by gentle strategies for which wild ones are not worth while
  Recorder* recorder = nullptr;  ///< notes how regions were resolved; none: nobody does
  AttemptLog* tried = nullptr;   ///< notes what was tried; none: nobody does
  std::size_t first_region = 0;  ///< number that the recorder is given for the first region
};

struct LadderResult {
  std::vector<RegionReport> regions;      ///< resolved ones, and last the ones that no strategy resolved
  std::vector<std::vector<Index>> moved;  ///< vertices freed for each resolved region, for recovery
  std::vector<IntersectingPair> left;     ///< pairs of triangles that remain
};

/// Untangles the scene region by region: every conflict region climbs from gentle local strategies to the flow of its
/// whole component, everything outside it held. Pairs in `ignored` (sorted, of triangles) cannot be resolved and are
/// let be.
LadderResult climb_ladder(Scene& scene, SceneIndex& index, std::span<const IntersectingPair> ignored,
                          const LadderOptions& options);

}  // namespace unsnarl
