#pragma once

#include <span>
#include <vector>

#include "geometry/types.h"
#include "unsnarl/routes.h"

namespace unsnarl {

/// A way from place to place, one polyline a leg; the last point of each is the first of the next.
using Legs = std::vector<std::vector<Vec3>>;

/// Routes as the solver sees them: vertices of all one after the other, evenly spaced between places, which are pinned.
struct RouteChains {
  struct Chain {
    Index first = 0, count = 0;  // vertices
    double radius = 0;
    double edge = 0;  // mean length when it was sampled
    Index last() const { return first + count - 1; }
  };
  std::vector<Chain> chains;
  std::vector<std::uint8_t> pinned;   // one a vertex
  std::vector<Index> segment_vertex;  // where each segment starts; it ends at the next vertex
  std::vector<Index> segment_chain;
  Positions x;
  double least_radius = 0;
  bool timed = false;  ///< equally many vertices a chain: vertices of one number are of one time

  Index segments() const { return static_cast<Index>(segment_vertex.size()); }
  std::vector<Route> routes(const Positions& at) const;
  /// The legs between pinned vertices.
  std::vector<Legs> legs(const Positions& at) const;
};

/// One route for each agent, through its legs. spacing: of vertices, in radii; wider where a route would have too many.
/// keep_corners: the points of the legs are vertices, so that no corner is cut; else all vertices are evenly spaced.
/// Timed routes all have as many vertices as the one that needs most.
RouteChains sample_chains(const RoutePlan& plan, std::span<const Legs> routes, double spacing, bool keep_corners);

/// Other routes through the same places, with as many points on each leg.
std::vector<Route> sampled_alike(const RouteChains& chains, std::span<const Legs> routes);

}  // namespace unsnarl
