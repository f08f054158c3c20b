#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "pipeline/repair_control.h"
#include "pipeline/repair_task.h"
#include "scene/finders.h"
#include "scene/output_format.h"
#include "scene/pair_policy.h"
#include "scene/recorder.h"
#include "scene/scene.h"
#include "unsnarl/report.h"
#include "untangle/attempt_log.h"

namespace unsnarl {

/// What a repair has reached: the stages take it and leave it further on.
struct RepairState {
  /// At rest.
  explicit RepairState(const RepairTask& task);

  /// rest: the input, but for rigid parts in their places. Triangles: of the cuts that are worked on.
  Scene scene;
  OutputFormat format;
  PairPolicy policy;  ///< that of the task around rigid parts in their places; given up: components left as they are

  std::vector<IntersectingPair> pairs_at_rest;  ///< of the scene at rest, by the input's cut; sorted
  /// Pairs of triangles of one polygon that no cut holds both, sorted.
  std::vector<IntersectingPair> exclusive;
  /// Those of the scene's pairs that may stay, exclusive ones among them, sorted.
  std::vector<IntersectingPair> ignored;

  /// A set of vertices that a region freed, and the region's number.
  struct Moved {
    std::vector<Index> vertices;  ///< ascending
    double depth = 0;             ///< how far from rest one of them was before recovery, at most: a length
    std::size_t region = 0;
  };
  std::vector<Moved> moved;
  std::size_t recovered = 0;  ///< so many of these, from the first on, have been recovered
  std::vector<RegionReport> regions;
  std::optional<PaperUntangling> before_recovery;  ///< with RepairOptions::paper
  AttemptLog attempts;
  Recorder recorder;
  double smallest_gap = std::numeric_limits<double>::infinity();  ///< met while contacts were listed
  bool displacement_is_exceeded = false;  ///< something could not be resolved within the displacement that is allowed

  Index component_of(const RepairTask& task, Index t) const {
    return task.diagnosis.components.component_of_vertex[scene.triangles[t][0]];
  }
  void restore_to_rest(std::span<const Index> vertices) {
    for (const Index v : vertices) scene.x.col(v) = scene.rest.col(v);
  }

  /// What to go back to, whatever the triangles are then.
  struct Checkpoint {
    Positions x;
    std::size_t regions;
    Recorder::Stages recorded;
    double smallest_gap;
  };
  Checkpoint checkpoint() const { return {scene.x, regions.size(), recorder.stages(), smallest_gap}; }
  void restore(const Checkpoint& checkpoint);
};

/// Finders of the scene's triangles; they refer to the state.
Finders make_finders(const RepairTask& task, const RepairState& state);

/// Lets all pairs of the scene be that may stay. `finders`: of its triangles. Returns all its pairs but those of
/// components that are given up.
std::vector<IntersectingPair> leave_what_may_stay(const RepairTask& task, Finders& finders, RepairState& state);

/// Components on which pairs intersect that may not stay, or a face has lost its area; ascending.
std::vector<Index> components_with_work(const RepairTask& task, Finders& finders, const RepairState& state);
/// There are none but what is given up.
bool is_resolved(const RepairTask& task, Finders& finders, const RepairState& state);

}  // namespace unsnarl
