#pragma once

#include <functional>
#include <span>

#include "scene/patch.h"
#include "unsnarl/intersections.h"

namespace unsnarl {

struct CoarseResult {
  bool clean = false;
  int iterations = 0;  ///< of the strategies that resolved something on the coarse mesh
  std::size_t pairs_left = 0;
};

/// Untangles a patch on a mesh with edges twice as long: there it climbs the ladder, up to the strategies that free
/// whole components, and recovers; that mesh carries the patch along. What is left is shallow. Where conflicts are many
/// edges deep this takes fewer and cheaper iterations, and since the ladder does the same on the coarse mesh the cost
/// follows the number of faces however deep they are. A patch that cannot be simplified stays where it is. Pairs of
/// active triangles count, but the `tolerated` ones (of patch triangles, sorted).
CoarseResult solve_on_coarser_mesh(Patch& patch, std::span<const IntersectingPair> tolerated,
                                   const std::function<bool()>& stop);

}  // namespace unsnarl
