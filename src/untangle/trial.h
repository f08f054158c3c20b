#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "scene/patch.h"
#include "scene/patch_progress.h"
#include "scene/recorder.h"
#include "scene/scene.h"
#include "scene/scene_index.h"
#include "scene/trajectory.h"
#include "unsnarl/intersections.h"
#include "untangle/selection.h"
#include "untangle/strategy.h"

namespace unsnarl {

/// A candidate that leaves less than this share of its region's pairs is kept at once [E4] (no unit)
constexpr double kept_at_once = 0.1;

/// The counts that decide whether a candidate is kept.
struct TrialPairs {
  std::size_t disjoint = 0, total = 0;

  TrialPairs() = default;
  explicit TrialPairs(std::span<const IntersectingPair> pairs);
  /// Fewer pairs, and no more disjoint ones.
  bool fell_from(const TrialPairs& before) const { return total < before.total && disjoint <= before.disjoint; }
  bool is_below(double share, const TrialPairs& before) const {
    return static_cast<double>(total) < share * static_cast<double>(before.total);
  }
};

/// A strategy tried on a region, and its candidate: patch.x.
struct Trial {
  const Strategy* strategy = nullptr;
  Selection selection;
  double reach = 0;  ///< how far around the patch obstacles are taken in, a length
  Patch patch;
  Positions start;  ///< of the patch's vertices
  Trajectory trajectory;
  int iterations = 0;
  double seconds = 0;
  TrialPairs before, left;     ///< of the region, at the start and of the candidate
  bool is_rejected = false;    ///< it has no pairs, but was not accepted
  bool is_inside_out = false;  ///< it turns a closed component inside out
  double distance = 0;         ///< from rest after recovery: squared_motion(), summed; known after look_farther()

  bool is_clean() const { return left.total == 0; }
  std::size_t resolved() const { return before.total - left.total; }
};

/// What trials ask of their owner.
struct TrialOptions {
  std::function<bool()> stop;  ///< true: give up; may be empty
  /// Distance that faces have to have in the end (RecoverOptions::min_gap) around these vertices; none: any.
  std::function<double(std::span<const Index> vertices)> min_gap;
  /// Asked about a candidate without pairs (from any thread); may improve it. False: the region goes on with the next
  /// strategy. Regions that are not resolved then stay where they are.
  std::function<bool(Patch& patch)> accept;
  /// Recovers a candidate that went far (from any thread), so that candidates are compared by where they end; none:
  /// they are compared as they are.
  std::function<void(Patch& patch)> recover;
  Recorder* recorder = nullptr;  ///< notes how regions were resolved; none: nobody does
};

/// A trial that has not been run.
Trial make_trial(const Strategy& strategy, Selection selection);

/// Cuts the patch and lets the strategy solve it. `task`: what all trials share. A candidate that is not finite goes
/// back to the start.
void run_trial(Trial& trial, const Scene& scene, const SceneIndex& index, const TrialOptions& options, Task task,
               PatchProgress& progress);

/// Puts a candidate among the obstacles that are within its reach now, and counts its pairs there. Returns those that
/// it tolerates.
std::vector<IntersectingPair> put_among_obstacles(Trial& trial, const Scene& scene, const SceneIndex& index);

/// Puts a candidate among the obstacles within its reach, and recovers it there if it is clean.
void look_farther(Trial& trial, const Scene& scene, const SceneIndex& index,
                  const std::function<void(Patch& patch)>& recover);

/// True: nothing has moved there since the candidate was made.
bool is_current(const Trial& trial, const Scene& scene);

/// Largest motion of a vertex from the start; largest distance of a vertex to rest. Lengths.
double largest_motion(const Trial& trial);
double largest_distance(const Trial& trial);

/// Vertices to be recovered once the candidate is kept: all that were free; of those freed by depth, which mostly stay,
/// the ones that have moved and a few rings around them.
std::vector<Index> to_be_recovered(const Trial& trial, const Scene& scene);

}  // namespace unsnarl
