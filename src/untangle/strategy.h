#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "scene/patch.h"
#include "scene/scene_index.h"
#include "unsnarl/intersections.h"
#include "untangle/selection.h"

namespace unsnarl {

struct Task;

/// One way to resolve conflict regions: what it frees and how far that may go, and how it moves it.
struct Strategy {
  std::string name;  ///< in reports
  /// Selects regions that are due, each with its free vertices (selection.h has the usual ways).
  std::function<std::vector<Selection>(const Conflicts& conflicts)> select;
  /// Moves the free vertices of patch.x, from where they are, to a state with fewer intersecting pairs if it finds one.
  /// Returns its number of iterations. The escalation counts the pairs that are left, and decides what that is worth.
  std::function<int(Patch& patch, const Task& task)> solve;
};

/// Strategies that are tried one after the other; after the last one, the candidate that resolves most is kept.
struct Tier {
  std::vector<Strategy> strategies;
  bool is_last_resort = false;  ///< it is tried only where nothing before it has resolved a region, however far away
};

/// What is left of a scene that was untangled.
struct Untangled {
  std::vector<IntersectingPair> left;  ///< of triangles, sorted
  int iterations = 0;                  ///< of the strategies whose candidates were kept
};

/// How far a scene has been untangled: how many pairs it has now, and how many that is less the share that is done of
/// each candidate.
using UntanglingProgress = std::function<void(double pairs_now, double work_left)>;

/// Untangles a scene by these tiers. `tolerated`: pairs of triangles, sorted, that may stay; `tell` may be empty.
using Untangler = std::function<Untangled(Scene& scene, SceneIndex& index, std::span<const IntersectingPair> tolerated,
                                          std::span<const Tier> tiers, const UntanglingProgress& tell)>;

/// The input of a strategy besides the patch.
struct Task {
  std::span<const IntersectingPair> tolerated = {};  ///< pairs of patch triangles, sorted, that it need not resolve
  std::size_t few_enough = 0;                        ///< pairs: a candidate that leaves no more is kept
  int depth = 0;                                     ///< edges: Selection::depth
  double min_gap = 0;                                ///< length: how far apart faces will have to be
  Untangler untangle = {};                           ///< for strategies that make a scene of their own
  std::function<bool()> stop = {};                   ///< true: give up; may be empty
};

}  // namespace unsnarl
