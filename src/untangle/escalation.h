#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "scene/recorder.h"
#include "scene/scene.h"
#include "unsnarl/intersections.h"
#include "unsnarl/report.h"
#include "untangle/attempt_log.h"
#include "untangle/strategy.h"
#include "untangle/trial.h"

namespace unsnarl {

struct EscalationProgress {
  std::span<const IntersectingPair> left;  ///< pairs of triangles that are left by what is kept
  double pairs_now = 0;                    ///< how many there are with the candidates as they are now
  double work_left = 0;                    ///< how many these pairs are less the share that is done of each candidate
};

struct EscalationOptions : TrialOptions {
  /// The strategies that are tried, in this order.
  std::span<const Tier> tiers;
  /// Names of those that are not, here and on coarse meshes.
  std::vector<std::string> left_out;
  /// Told what is kept, and a few times a second, from any thread, how far the candidates are that are made now; may be
  /// empty.
  std::function<void(const EscalationProgress& progress)> on_progress;
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
/// until a candidate leaves so few pairs that it is kept, or to the end of a tier, whose best candidate is kept if it
/// leaves few enough; what is left of it is segmented anew and starts from the first strategy. A candidate that
/// resolves its region but goes far waits until all have been tried but the last resorts; then the nearest is kept. A
/// candidate is kept only if it has fewer pairs, and no more disjoint ones, so this ends. Regions that lie apart do not
/// influence each other. Pairs in `ignored` (sorted, of triangles) are tolerated.
EscalationResult escalate(Scene& scene, SceneIndex& index, std::span<const IntersectingPair> ignored,
                          const EscalationOptions& options);

/// escalate() as strategies call it for scenes of their own. `left_out` (EscalationOptions) must outlive the result.
Untangler make_untangler(std::function<bool()> stop, std::span<const std::string> left_out);

}  // namespace unsnarl
