#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "scene/patch.h"
#include "scene/recorder.h"
#include "scene/scene.h"
#include "unsnarl/intersections.h"
#include "unsnarl/report.h"
#include "untangle/attempt_log.h"
#include "untangle/strategy.h"

namespace unsnarl {

struct EscalationProgress {
  std::span<const IntersectingPair> left;  ///< pairs of triangles that are left by what is kept
  double pairs_now = 0;                    ///< how many there are with the candidates as they are now
  double work_left = 0;                    ///< how many these pairs are less the share that is done of each candidate
};

struct EscalationOptions {
  /// The strategies that are tried, in this order.
  std::span<const Tier> tiers;
  /// Names of those that are not, here and on coarse meshes.
  std::vector<std::string> left_out;
  std::function<bool()> stop;
  /// Told what is kept, and a few times a second, from any thread, how far the candidates are that are made now; none:
  /// nobody is.
  std::function<void(const EscalationProgress& progress)> on_progress;
  /// Distance that faces have to have in the end (RecoverOptions::min_gap) around these vertices; none: any.
  std::function<double(std::span<const Index> vertices)> min_gap;
  /// Asked about a candidate without pairs (from any thread); may improve it. False: the region goes on with the next
  /// strategy. Regions that are not resolved then stay where they are.
  std::function<bool(Patch& patch)> accept;
  /// Recovers a candidate that went far (from any thread), so that candidates are compared by where they end; none:
  /// they are compared as they are.
  std::function<void(Patch& patch)> recover;
  Recorder* recorder = nullptr;    ///< notes how regions were resolved; none: nobody does
  AttemptLog* attempts = nullptr;  ///< notes what was tried; none: nobody does
  std::size_t first_region = 0;    ///< number that the recorder is given for the first region
};

struct EscalationResult {
  std::vector<RegionReport> regions;      ///< what was kept of each strategy, and last the regions that none resolved
  std::vector<std::vector<Index>> moved;  ///< vertices freed for each of the former, for recovery
  std::vector<double> depths;             ///< how far from rest each of these has a vertex, at most: a length
  std::vector<IntersectingPair> left;     ///< pairs of triangles that remain
};

/// Untangles the scene region by region, everything outside the region held. A region goes from strategy to strategy
/// until a candidate has so few pairs that it is kept, or to the end of a tier, whose best candidate is kept where it
/// is worth while; what is left of it is segmented anew and starts from the first strategy. A candidate that resolves
/// its region but goes far waits until all have been tried but the last resorts; then the nearest is kept. Only
/// candidates with fewer pairs, and no more disjoint ones, are ever kept, so this ends. Regions that lie apart do not
/// influence each other. Pairs in `ignored` (sorted, of triangles) are tolerated.
EscalationResult escalate(Scene& scene, SceneIndex& index, std::span<const IntersectingPair> ignored,
                          const EscalationOptions& options);

}  // namespace unsnarl
