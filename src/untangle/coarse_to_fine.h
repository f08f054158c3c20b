#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "scene/patch.h"
#include "unsnarl/intersections.h"

namespace unsnarl {

/// Constants of solve_on_coarser_mesh(). h is the mean edge length of the level.
struct CoarseToFineOptions {
  /// The coarsest mesh has edges this many times longer than the patch, for each edge of the tangle's depth ...
  double factor_per_depth = 0.5;
  double least_factor = 2;  ///< ... but at least so many times
  /// The coarsest mesh has this many faces at least.
  std::size_t least_faces = 200;
  /// h: the gap that is kept on the coarsest mesh, where the removed vertices have to find room.
  double coarse_gap = 0.025;
  /// Faces between two levels that recover, as a ratio.
  double level_growth = 3;
  int level_steps = 12;            ///< of the recovery on a level between the coarsest and the finest
  double level_activation = 0.02;  ///< h: its activation distance
};

struct CoarseResult {
  bool clean = false;
  int iterations = 0;  ///< of the strategies that resolved something on the coarsest mesh
  std::size_t pairs_left = 0;
};

/// Untangles a patch from coarse to fine. It is simplified until the tangle (`depth` edges deep) is shallow, untangled
/// and recovered there, and then the removed vertices are put back round by round, each where the exact test finds no
/// new pair; in between, a few steps of recovery make room. The cost follows the number of faces, however deep the
/// tangle is. Pairs of active triangles count, but the `tolerated` ones (of patch triangles, sorted). A patch that cannot be
/// simplified stays where it is.
CoarseResult solve_on_coarser_mesh(Patch& patch, int depth, std::span<const IntersectingPair> tolerated,
                                   const std::function<bool()>& stop, const CoarseToFineOptions& options = {});

}  // namespace unsnarl
