#pragma once

#include <functional>
#include <limits>

#include "scene/patch.h"
#include "unsnarl/intersections.h"
#include "untangle/shared_constants.h"
#include "untangle/sheet_motion.h"

namespace unsnarl {

/// How a local strategy finds its direction.
enum class LocalMethod {
  contour,  ///< it pushes the two sheets of every intersection curve apart
  shallow,  ///< the Minkowski penalty (paper §3.2) and that in turn, steps and margin as small as the overlaps
};

/// Largest LocalSettings::step of a strategy, and how far others go between two looks: a try that has gone on for
/// LocalOptions::despair iterations looks for intersecting pairs when its steps since add up to this, and follows those
/// that it knows in between (but `shallow`, which is over soon). On ten deep meshes 0.8 of the time with 0.3, 0.87 with
/// 0.4; displacements scatter around what they are without. For `shorten-4` and `contour-8`, which look at every step,
/// a layered cloth would take four times as long.
constexpr double longest_step = 0.3;  // h

/// One way to untangle a small patch. Lengths in units of the patch's h.
struct LocalSettings {
  LocalMethod method;
  SheetMotion motion;  ///< of the two sheets of a curve; `free` is slow, but gets through what hems them in
  double step;         ///< largest vertex motion of an iteration, h
  double locality;     ///< range of the direction's smoothing, h
  /// Beyond these it goes on only as long as it makes progress. With `free` it does so from the start, and waits for
  /// progress as many: with 30 a tangle of layered cloth keeps pairs; with 100 some sheets move a third farther.
  int max_iterations;
};

/// Whether faces that intersect nothing at the start are kept from flipping (FlipGuard).
enum class KeepOrientation {
  yes,
  at_first,  ///< where that fails, no longer, from where the first of them had to be kept on
};

struct LocalOptions {
  double margin = 0.03;  ///< h: the penalty acts until faces are this far apart. 28 iterations against 61 without
  /// Share of h, or of the shortest edge at a vertex, by which vertices are shifted at the start: it breaks the
  /// symmetry of coincident sheets and exact folds. With a tenth of it, 37 samples end 1.09 times as far, one 7 times.
  /// Faces are taken to overlap by this share of h at least, also where they do no more than touch: as little as there
  /// is would never end. A tenth of it is as good; where the margin counted as overlap, needles that ran into each
  /// other by 1e-5 h were thrown about by 0.02 h, and never came apart.
  double negligible = 1e-3;
  /// Edges of length zero are first opened to this share of the way to the neighbours (open_zero_length_edges).
  /// Without, rings of 64 vertices in one point take minutes; with a tenth or a third of it, an inverted cylinder ends
  /// ruined or not with whatever else changes.
  double opening = 0.01;
  double area_floor = squeezed_area;  ///< of its area at the start
  /// Share of the deepest overlap, now or at the start, that `shallow` parts faces by; at most `margin`. Its steps are
  /// as long as that overlap.
  double shallow_margin = 0.5;
  double min_gap = 0;  ///< length: the same, since they will have to be that far apart
  KeepOrientation orientation = KeepOrientation::at_first;
  std::size_t few_enough = 0;  ///< pairs; with KeepOrientation::at_first, a try that leaves no more is left at that
  /// Progress is when the number of pairs falls by this share ...
  double progress = 0.1;
  /// ... within so many iterations: what a strategy needs that to go on beyond its iterations. On the 22 of 61 meshes
  /// where some strategy fails, with 8: 10 % more time, and a curled body moves 15 % farther.
  int patience = 12;
  /// Or within so many: else it is left early. With 15: the same time, and two bodies move 10 and 35 % farther.
  int despair = 30;
  double look_distance = longest_step;  ///< h: the same, that this try goes between two looks
  /// Bisections of a solution's displacement back to where it began; the smallest clean one is kept. Without them, 98
  /// meshes end 2 % farther with 8 % more flipped faces, in 7 % less time; with 6, others as near, a creature a seventh
  /// farther.
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

/// Tries to move the patch's free vertices, from patch.x on, until no active triangle intersects another, except in the
/// `tolerated` pairs (of patch triangles, sorted): those of other regions nearby. Where it
/// fails, patch.x is the state with the fewest pairs.
LocalResult solve_locally(Patch& patch, const LocalSettings& strategy, std::span<const IntersectingPair> tolerated = {},
                          const LocalOptions& options = {}, const std::function<bool()>& stop = {});

/// True where some active triangle has less than `floor` times its area at `start` (and had any).
bool has_squeezed_face(const Patch& patch, const Positions& start, const Positions& x, double floor);

/// Bisects the displacement from `start` to patch.x, keeping the smallest clean one in patch.x.
void shrink_displacement(Patch& patch, const Positions& start, int bisections,
                         const std::function<bool(const Positions&)>& is_clean);

}  // namespace unsnarl
