#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "scene/scene.h"
#include "unsnarl/intersections.h"
#include "untangle/conflict_regions.h"
#include "untangle/tangle_depth.h"

namespace unsnarl {

/// What a strategy sees of a scene when it selects the vertices that it frees.
struct Conflicts {
  const Scene& scene;
  std::span<const IntersectingPair> pairs;          ///< those that are there now, sorted
  std::span<const IntersectingPair> initial_pairs;  ///< those that were there at first, sorted
  std::span<const std::uint8_t> is_due;             ///< per vertex: it is in the core of a region that is tried now
  std::span<const std::uint8_t> is_rejected;        ///< per vertex: a solution of a region around it was not accepted
  std::function<const ConnectedParts&()> parts;     ///< of the scene, found when they are first asked for
};

/// A region, and what a strategy frees to resolve it.
struct Selection {
  ConflictRegion region;    ///< with all regions that the free vertices reach
  std::vector<Index> free;  ///< vertices, ascending, none of them fixed
  double edge_length = 0;   ///< h: mean edge of the region's faces at rest, a length
  int depth = 0;            ///< edges: how deep the strategy takes the tangle to be; 0: it does not ask
  /// Largest motion wanted, a length: obstacles are taken in this far around. A candidate that moves a vertex farther,
  /// even after recovery, waits for a nearer one if it leaves no pair, and is dropped if it leaves some.
  double bound = 0;
};

/// What a strategy frees around one region.
struct Extent {
  /// Returns the free vertices for the region with those that it has taken in, ascending; none: it is not tried.
  std::function<std::vector<Index>(const ConflictRegion& region)> free_vertices;
  /// False: this is left to the next strategies; may be empty.
  std::function<bool(const Selection& selection)> is_wanted = {};
  double reach = 0;  ///< Selection::bound in h
  int depth = 0;     ///< Selection::depth
};

/// Selects the regions that are due, ordered by their smallest vertices. One whose free vertices reach the core of
/// another one takes that in, and is asked for free vertices anew. Regions are cut at vertices with more neighbours
/// than `most_valence`. `extent_of`: for each region as it is at first; none: it is left to other strategies, and may
/// be taken in.
std::vector<Selection> select_regions(
    const Conflicts& conflicts, std::size_t most_valence,
    const std::function<std::optional<Extent>(const ConflictRegion& region)>& extent_of);

/// All free vertices of the components that have one of `vertices`, ascending.
std::vector<Index> free_vertices_of_components(const Scene& scene, const ConnectedParts& parts,
                                               std::span<const Index> vertices);

/// All vertices of the components that a region ties together, by its pairs and through those that intersected at first
/// (`initial_pairs`), ascending. Components with a fixed vertex are left out; none where the region lies within one.
std::vector<Index> vertices_of_tied_components(const Scene& scene, const ConnectedParts& parts,
                                               const ConflictRegion& region,
                                               std::span<const IntersectingPair> initial_pairs);

// The usual ways to select, as values of Strategy::select.
using Select = std::function<std::vector<Selection>(const Conflicts& conflicts)>;

struct RingsOptions {
  int rings = 0;  ///< edges from the intersecting faces
  /// Selection::bound in h (unit: h)
  double reach = 4;
  std::size_t most_valence = any_valence;  ///< neighbours: vertices that have more are held
};
/// The vertices within some rings of the intersecting faces.
Select select_rings(const RingsOptions& options);

struct DepthOptions {
  /// Rings freed for each edge of the depth (unit: rings / edge)
  double rings_per_edge = 1;
  /// Selection::bound in h for each edge of the depth (unit: h)
  double reach = 4;
  /// Regions less deep are left to other strategies (unit: edges)
  int least = 1;
  /// Regions are taken to be so many times as deep as they are. Where this is more than 1, none is left to others:
  /// those less deep than `least` count as that deep (no unit)
  int factor = 1;
  /// Regions are left to others where it would free fewer in every component (unit: vertices)
  std::size_t least_free = 0;
  bool leaves_most = false;  ///< regions of which it would free at least half of the components are left to others
};
/// The vertices within a multiple of the depth of the tangle (tangle_depth).
Select select_by_depth(const DepthOptions& options);

/// The components that a region ties together, now or at first (vertices_of_tied_components). `reach` in h.
Select select_tied_components(double reach);

/// The components that have intersecting faces, but those of rejected regions. `reach` in h.
Select select_whole_components(double reach);

}  // namespace unsnarl
