#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <span>

#include "scene/patch.h"
#include "unsnarl/intersections.h"
#include "untangle/local/sheet_motion.h"
#include "untangle/squeezed_faces.h"

namespace unsnarl {

/// How a local strategy finds its direction.
enum class LocalMethod {
  contour,  ///< it pushes the two sheets of every intersection curve apart
  shallow,  ///< the Minkowski penalty (paper §3.2) and that in turn, steps and margin as small as the overlaps
};

/// One way to untangle a small patch. Lengths in units of the patch's h.
struct LocalSettings {
  LocalMethod method;
  SheetMotion motion;  ///< of the two sheets of a curve; `free` is slow, but gets through what hems them in
  double step;         ///< largest vertex motion of an iteration, h
  double locality;     ///< range of the direction's smoothing, h
  /// Iterations after which a solve goes on only while it makes progress (LocalOptions::patience). With `free`: a solve
  /// ends after so many iterations without progress. [E136]
  int max_iterations;
};

/// Whether faces that intersect nothing at the start are kept from flipping (FlipGuard).
enum class KeepOrientation {
  yes,
  at_first,  ///< where that fails, no longer: the solve goes on from where the guard first moved a vertex
};

/// h: the patch's edge length. Numbers in brackets: docs/experiments.md.
struct LocalOptions {
  /// The penalty acts until faces are this far apart [E137] (unit: h)
  double margin = 0.03;
  /// Random motion of a vertex at the start, which breaks the symmetry of coincident sheets and exact folds: share of
  /// the shortest edge at the vertex, or of h if that is shorter [E36] (no unit)
  double jitter = 1e-3;
  /// `shallow` takes faces that do no more than touch to overlap by this [E138] (unit: h)
  double least_overlap = 1e-3;
  /// Vertices of a zero-length edge first move this share of the way to their neighbours' mean
  /// (open_zero_length_edges) [E17] (no unit)
  double opening = 0.01;
  double area_floor = squeezed_area;  ///< share of its area at the start that each face keeps, without unit
  /// Margin of `shallow`: share of the deepest overlap at the start [E123] (no unit)
  double shallow_margin = 0.5;
  double min_gap = 0;  ///< length: `shallow` takes faces to overlap by this at least
  KeepOrientation orientation = KeepOrientation::at_first;
  std::size_t few_enough = 0;  ///< pairs: a guarded solve that leaves no more does not go on without its guard
  /// Share by which the number of pairs falls where there is progress (no unit)
  double progress = 0.1;
  /// Past `max_iterations`, a solve without progress in so many ends [E139] (unit: iterations)
  int patience = 12;
  /// A solve without progress in so many ends even before that [E37, E140] (unit: iterations)
  int give_up_after = 30;
  /// From here on pairs are counted only after each `recount_distance` (unit: iterations)
  int follow_after = 30;
  /// Motion after which pairs are counted again; `shallow` always counts [E29, E141] (unit: h)
  double recount_distance = 0.3;
  /// Bisections of the displacement of a solution, whose smallest clean share is kept [E126] (unit: steps)
  int bisections = 5;
};

/// A number of pairs that the solver did not get to count.
constexpr std::size_t not_counted = std::numeric_limits<std::size_t>::max();

struct LocalResult {
  bool clean = false;
  int iterations = 0;
  std::size_t pairs_left = not_counted;  ///< in patch.x
  double displacement = 0;               ///< largest vertex motion, length
};

/// Moves the patch's free vertices, from patch.x on, until no active triangle intersects another one, except in the
/// `tolerated` pairs (of patch triangles, sorted). If it fails, patch.x is the state with the fewest pairs that
/// squeezes no face.
LocalResult solve_locally(Patch& patch, const LocalSettings& strategy, std::span<const IntersectingPair> tolerated = {},
                          const LocalOptions& options = {}, const std::function<bool()>& stop = {});

/// Bisects the displacement from `start` to patch.x, keeping the smallest clean one in patch.x.
void shrink_displacement(Patch& patch, const Positions& start, int bisections,
                         const std::function<bool(const Positions&)>& is_clean);

}  // namespace unsnarl
