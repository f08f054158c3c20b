#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "scene/patch.h"
#include "unsnarl/intersections.h"
#include "untangle/conflict_regions.h"
#include "untangle/shared_constants.h"

namespace unsnarl {

/// The input of a strategy besides the patch.
struct Task {
  std::span<const IntersectingPair> tolerated = {};  ///< pairs of patch triangles, sorted, that it need not resolve
  std::size_t few_enough = 0;                        ///< pairs: a candidate that leaves no more is kept
  int depth = 0;                                     ///< edges: of the tangle, for Extent::depth
  double min_gap = 0;                                ///< length: how far apart faces will have to be
  std::span<const std::string> left_out = {};        ///< strategies that coarse meshes do without, by name
  const std::function<bool()>& stop;                 ///< true: give up; may be empty
};

/// Which vertices of a conflict region a strategy moves.
enum class Extent : std::uint8_t {
  rings,             ///< those at most Strategy::rings edges from the intersecting faces
  depth,             ///< a multiple of the depth of the tangle around them (see tangle depth)
  tied_components,   ///< all of the components that are tied together by pairs, now or at first
  whole_components,  ///< all that is connected to the intersecting faces
};

/// One way to resolve a conflict region: region in, candidate out.
struct Strategy {
  std::string name;
  Extent extent = Extent::rings;
  int rings = 0;               ///< edges, for Extent::rings
  double rings_per_depth = 0;  ///< edges for each edge of the tangle's depth, for Extent::depth
  /// Bound of the motion, in h (times the depth of the tangle, for Extent::depth): obstacles are taken in this far
  /// around, and a candidate that moves a vertex farther, even after recovery, waits for a nearer one
  /// where it leaves no pair, and is dropped where it does.
  double reach = 4;
  bool is_last_resort = false;  ///< it is tried only where nothing before it has resolved the region, however far away
  std::size_t most_valence = any_valence;
  int least_depth = 0;  ///< edges: tangles less deep are left to other strategies
  /// Tangles are taken to be so many times as deep as they are. Where more than once, none is left to others: those
  /// less deep than `least_depth` count as that deep.
  int depth_factor = 1;
  /// A region of which it would free half of the connected vertices or more is left to the next strategies, which free
  /// all of them.
  bool leaves_most = false;
  /// A candidate that squeezes a face to less than this share of its area before is worthless.
  double area_floor = squeezed_area;
  /// Moves the free vertices of patch.x, from where they are, to a state with fewer intersecting pairs, if it finds
  /// one. Returns the number of its iterations. What the candidate is worth is decided by the escalation.
  std::function<int(Patch& patch, const Task& task)> solve;
};

/// Strategies that are tried in this order; the best candidate of a tier is kept if it is worth while.
using Tier = std::vector<Strategy>;

}  // namespace unsnarl
