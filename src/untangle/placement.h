#pragma once

#include <functional>
#include <span>
#include <vector>

#include "scene/patch.h"
#include "scene/scene.h"
#include "unsnarl/intersections.h"
#include "untangle/conflict_regions.h"
#include "untangle/tangle_depth.h"

namespace unsnarl {

struct PlacementOptions {
  /// Share of a component's diagonal by which the first try of a motion goes; the next ones go `growth` times as far.
  double first_step = 1e-3;
  double growth = 1.6;
  /// Between the last motion that is not free and the first that is. With 5, two wigs end a fourth farther.
  int bisections = 6;
  double margin = 0.05;           ///< of the motion: so much farther than the first free place
  std::size_t most_faces = 4000;  ///< of a component that is moved: every place tried takes an exact test of them all
  double most_shrink = 0.95;      ///< share of its distance from the point that a vertex goes, at most
  /// Intersecting pairs of which normals are tried as directions, and own vertices toward which it is tried to shrink a
  /// component. With 24 vertices a wig ends 6 % farther, all others of 66 meshes as close.
  std::size_t most_tries = 16;
};

/// Components are put at the cheapest free place instead of being repelled. Every component of the patch that is free
/// as a whole goes back to patch.rest, unless it intersects itself there, and from there, the largest first, to the
/// nearest place where it intersects nothing outside itself but those still to be placed: by a translation (26
/// directions and the normals of its contacts) or by shrinking toward its middle or one of its own vertices, cheapest
/// by the root mean square of the displacement. One without a free place within its own diagonal stays where it was.
/// Returns the number of components that were placed.
int place(Patch& patch, std::span<const IntersectingPair> tolerated, const PlacementOptions& options,
          const std::function<bool()>& stop);

/// All vertices of the components that a region ties together, by its pairs and through those that intersected at first
/// (`initial_pairs`), ascending. Components with a fixed vertex are left out; none where the region lies within one.
std::vector<Index> vertices_of_tied_components(const Scene& scene, const ConnectedParts& parts,
                                               const ConflictRegion& region,
                                               std::span<const IntersectingPair> initial_pairs);

}  // namespace unsnarl
