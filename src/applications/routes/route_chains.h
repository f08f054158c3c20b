#pragma once

#include <limits>
#include <span>
#include <vector>

#include "applications/routes/time_search.h"
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
    double edge = 0;                                           // mean length when it was sampled, where it moves
    double longest = std::numeric_limits<double>::infinity();  // an edge is at most, for the agent's speed
    bool planar = false;
    Index last() const { return first + count - 1; }
  };
  std::vector<Chain> chains;
  std::vector<std::uint8_t> pinned;   // one a vertex
  std::vector<Index> stand;           // first of the vertices in a row where the agent stands, of each vertex
  std::vector<Index> segment_vertex;  // where each segment starts; it ends at the next vertex
  std::vector<Index> segment_chain;
  Positions x;
  double least_radius = 0;
  bool timed = false;  ///< equally many vertices a chain: vertices of one number are of one time

  /// Whether the agent stands still before or after this vertex, so that it may turn on the spot.
  bool stands(Index v) const {
    return stand[v] != v || (v + 1 < static_cast<Index>(stand.size()) && stand[v + 1] == v);
  }
  Index segments() const { return static_cast<Index>(segment_vertex.size()); }
  std::vector<Route> routes(const Positions& at) const;
  /// The legs between pinned vertices.
  std::vector<Legs> legs(const Positions& at) const;
};

/// One route for each agent, through its legs. spacing: of vertices, in radii; wider where a route would have too many.
/// keep_corners: the points of the legs are vertices, so that no corner is cut; else all vertices are evenly spaced.
/// Timed routes all have as many vertices as the one that needs most.
RouteChains sample_chains(const RoutePlan& plan, std::span<const Legs> routes, double spacing, bool keep_corners);

/// Routes in time with the vertices of these ways, up to some time after the last agent arrives. Where an agent stays
/// in one place, it stands.
RouteChains chains_in_time(const RoutePlan& plan, std::span<const TimedWay> ways);

/// Makes the agent stand for a step at vertex v, with a step of the nearest place in this direction (1 or -1) where it
/// stands; what is between is passed a step later, or earlier. False, and nothing is done: it stands nowhere there for
/// more than a step.
bool insert_stop(RouteChains& chains, const RouteChains::Chain& chain, Index v, Index direction);

/// Other routes through the same places, with as many points on each leg.
std::vector<Route> sampled_alike(const RouteChains& chains, std::span<const Legs> routes);

}  // namespace unsnarl
