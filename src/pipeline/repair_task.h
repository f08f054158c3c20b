#pragma once

#include <functional>
#include <optional>

#include "scene/diagnose.h"
#include "scene/nested_surfaces.h"
#include "scene/pair_policy.h"
#include "scene/prepared_surface.h"
#include "unsnarl/nesting.h"
#include "unsnarl/repair.h"

namespace unsnarl {

/// What a repair is asked for, and what is known of its surface before any work. Nothing of it changes afterwards.
struct RepairTask {
  /// Prepares the surface; nothing that intersects is known yet. `nesting`: null for none. Throws std::invalid_argument
  /// where the surface or the options make no sense. The arguments must outlive it.
  RepairTask(const SurfaceView& surface, const RepairOptions& options, const Nesting* nesting);
  /// The same of a surface that is prepared already, whose vertices have moved since. `start`: see repair_from().
  RepairTask(const SurfaceView& surface, const RepairOptions& options, const PreparedSurface& prepared,
             const Diagnosis& topology, std::optional<Positions> start);
  RepairTask(const RepairTask&) = delete;  // the policy refers to the diagnosis
  RepairTask& operator=(const RepairTask&) = delete;

  /// Finds what intersects in the input. `finder`: of the prepared triangles. Throws WorkStopped soon after `stop` says
  /// so.
  void diagnose(IntersectionFinder& finder, const std::function<bool()>& stop);

  /// How far a vertex may end from rest, a length; 0: any.
  double most_motion() const { return options.max_displacement_rel * diagonal; }

  const SurfaceView surface;
  const RepairOptions& options;
  const PreparedSurface prepared;
  Diagnosis diagnosis;
  const double diagonal;  ///< of the input's bounding box, at the scale of the prepared positions
  PairPolicy policy;
  std::optional<NestedSurfaces> nested;  ///< none: it does not matter which surface is inside which
  std::optional<Positions> start;        ///< where the work begins; none: at rest
};

}  // namespace unsnarl
