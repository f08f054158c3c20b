#include "applications/routes/route_chains.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace unsnarl {
namespace {

/// Segments of a route, at most; a long thin one has wider spacing (unit: segments)
constexpr double most_segments = 3000;
/// Segments of all routes together, at most (unit: segments)
constexpr double most_segments_of_all = 2e5;
/// Segments of a leg, at least: fewer could not bend (unit: segments)
constexpr double least_segments_a_leg = 4;

/// Time that routes in time have after the last agent has arrived, for stops (unit: time until then)
constexpr double spare_time = 0.1;

double length_of(std::span<const Vec3> polyline) {
  double length = 0;
  for (std::size_t k = 0; k + 1 < polyline.size(); ++k) length += (polyline[k + 1] - polyline[k]).norm();
  return length;
}

/// Points at equal distances along a polyline, the first and last exactly its ends.
std::vector<Vec3> evenly(std::span<const Vec3> polyline, Index segments) {
  std::vector<Vec3> points{polyline.front()};
  const double step = length_of(polyline) / segments;
  double before = 0;
  std::size_t k = 0;
  for (Index i = 1; i < segments; ++i) {
    double along = (polyline[k + 1] - polyline[k]).norm();
    while (before + along < step * i && k + 2 < polyline.size()) {
      before += along;
      ++k;
      along = (polyline[k + 1] - polyline[k]).norm();
    }
    const double t = along > 0 ? std::clamp((step * i - before) / along, 0.0, 1.0) : 0;
    points.push_back((1 - t) * polyline[k] + t * polyline[k + 1]);
  }
  points.push_back(polyline.back());
  return points;
}

/// A piece of a route that is cut into equal segments: a leg, or one edge of a leg whose corners are kept.
struct Piece {
  std::vector<Vec3> points;
  double length = 0;
  Index segments = 0;
  bool ends_leg = false;
};

std::vector<Piece> pieces_of(const Legs& legs, double most, bool keep_corners) {
  std::vector<Piece> pieces;
  for (const std::vector<Vec3>& leg : legs) {
    const std::size_t edges = keep_corners ? leg.size() - 1 : 1;
    for (std::size_t k = 0; k < edges; ++k) {
      Piece& piece = pieces.emplace_back();
      piece.points = keep_corners ? std::vector<Vec3>{leg[k], leg[k + 1]} : leg;
      piece.length = length_of(piece.points);
      piece.segments = static_cast<Index>(
          std::max(std::ceil(least_segments_a_leg / static_cast<double>(edges)), std::ceil(piece.length / most)));
    }
    pieces.back().ends_leg = true;
  }
  return pieces;
}

Index segments_of(const std::vector<Piece>& pieces) {
  Index sum = 0;
  for (const Piece& piece : pieces) sum += piece.segments;
  return sum;
}

/// More segments, always where they are longest.
void refine(std::vector<Piece>& pieces, Index segments) {
  for (Index k = segments_of(pieces); k < segments; ++k)
    ++std::max_element(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) {
        return a.length * b.segments < b.length * a.segments;
      })->segments;
}

/// Adds the segments of the last chain and what its agent is held to; step: time between two vertices.
void finish_chain(const RoutePlan& plan, double step, RouteChains& chains) {
  const std::size_t agent = chains.chains.size() - 1;
  RouteChains::Chain& chain = chains.chains.back();
  chain.radius = plan.agents[agent].radius;
  chain.planar = plan.agents[agent].planar;
  if (plan.timed) chain.longest = plan.agents[agent].speed * step;
  chains.least_radius = agent == 0 ? chain.radius : std::min(chains.least_radius, chain.radius);
  for (Index v = chain.first; v < chain.last(); ++v) {
    chains.segment_vertex.push_back(v);
    chains.segment_chain.push_back(static_cast<Index>(agent));
  }
}

}  // namespace

std::vector<Route> RouteChains::routes(const Positions& at) const {
  std::vector<Route> routes;
  for (const Chain& chain : chains) {
    Route& route = routes.emplace_back();
    for (Index v = chain.first; v <= chain.last(); ++v) route.points.push_back({at(0, v), at(1, v), at(2, v)});
  }
  return routes;
}

std::vector<Legs> RouteChains::legs(const Positions& at) const {
  std::vector<Legs> all;
  for (const Chain& chain : chains) {
    Legs& legs = all.emplace_back();
    for (Index v = chain.first; v <= chain.last(); ++v) {
      if (!legs.empty()) legs.back().push_back(at.col(v));
      if (pinned[v] && v < chain.last()) legs.push_back({at.col(v)});
    }
  }
  return all;
}

RouteChains sample_chains(const RoutePlan& plan, std::span<const Legs> routes, double spacing, bool keep_corners) {
  std::vector<double> edges;
  double total = 0;
  for (std::size_t i = 0; i < routes.size(); ++i) {
    double length = 0;
    for (const std::vector<Vec3>& leg : routes[i]) length += length_of(leg);
    edges.push_back(std::max(spacing * plan.agents[i].radius, length / most_segments));
    total += length / edges.back();
  }
  const double wider = std::max(1.0, total / most_segments_of_all);
  std::vector<std::vector<Piece>> pieces;
  Index most = 0;
  for (std::size_t i = 0; i < routes.size(); ++i) {
    pieces.push_back(pieces_of(routes[i], wider * edges[i], keep_corners));
    most = std::max(most, segments_of(pieces.back()));
  }
  RouteChains made;
  made.timed = plan.timed;
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < routes.size(); ++i) {
    if (plan.timed) refine(pieces[i], most);
    RouteChains::Chain& chain = made.chains.emplace_back();
    chain.first = static_cast<Index>(points.size());
    double length = 0;
    points.push_back(pieces[i].front().points.front());
    made.pinned.push_back(1);
    for (const Piece& piece : pieces[i]) {
      const std::vector<Vec3> even = evenly(piece.points, piece.segments);
      points.insert(points.end(), even.begin() + 1, even.end());
      made.pinned.resize(points.size(), 0);
      made.pinned.back() = piece.ends_leg;
      length += piece.length;
    }
    chain.count = static_cast<Index>(points.size()) - chain.first;
    chain.edge = length / (chain.count - 1);
    finish_chain(plan, plan.duration / (chain.count - 1), made);
  }
  made.stand.resize(points.size());
  std::iota(made.stand.begin(), made.stand.end(), 0);
  made.x.resize(3, static_cast<Index>(points.size()));
  for (std::size_t v = 0; v < points.size(); ++v) made.x.col(static_cast<Index>(v)) = points[v];
  // Rounding does not take planar agents off their height.
  for (const RouteChains::Chain& chain : made.chains)
    if (chain.planar) made.x.row(2).segment(chain.first, chain.count).setConstant(made.x(2, chain.first));
  return made;
}

RouteChains chains_in_time(const RoutePlan& plan, std::span<const TimedWay> ways) {
  RouteChains made;
  made.timed = true;
  std::size_t last = 1;
  for (const TimedWay& way : ways)
    for (std::size_t k = last; k < way.points.size(); ++k)
      if (way.points[k] != way.points.back()) last = k + 1;
  last += static_cast<std::size_t>(std::ceil(spare_time * static_cast<double>(last)));
  const auto count = static_cast<Index>(std::min(last + 1, ways[0].points.size()));
  made.x.resize(3, count * static_cast<Index>(ways.size()));
  for (const TimedWay& way : ways) {
    RouteChains::Chain& chain = made.chains.emplace_back();
    chain.first = static_cast<Index>(made.pinned.size());
    chain.count = count;
    Index moves = 0;
    for (Index k = 0; k < count; ++k) {
      const Index v = chain.first + k;
      made.x.col(v) = way.points[k];
      const bool is_same = k > 0 && way.points[k] == way.points[k - 1];
      made.stand.push_back(is_same ? made.stand[v - 1] : v);
      made.pinned.push_back(way.pinned[k]);
      if (!is_same && k > 0) ++moves;
    }
    chain.edge = length_of(way.points) / std::max<Index>(1, moves);
    finish_chain(plan, plan.duration / static_cast<double>(way.points.size() - 1), made);
  }
  return made;
}

bool insert_stop(RouteChains& chains, const RouteChains::Chain& chain, Index v, Index direction) {
  const auto is_in = [&](Index w) { return w >= chain.first && w <= chain.last(); };
  Index from = v + direction, to = from;  // of the stand
  for (;;) {
    for (to = from; is_in(to + direction) && chains.stand[to + direction] == chains.stand[from];) to += direction;
    if (std::abs(to - from) > 1) break;
    from = to + direction;
    if (!is_in(from)) return false;
  }
  for (Index w = from; w != v; w -= direction) {
    chains.x.col(w) = Vec3(chains.x.col(w - direction));
    chains.pinned[w] = chains.pinned[w - direction];
    chains.stand[w] = chains.stand[w - direction] + direction;
  }
  chains.stand[v + direction] = chains.stand[v] = std::min(v, v + direction);
  const Index first = std::min(from + direction, to), last = std::max(from + direction, to);
  for (Index w = first; w <= last; ++w) chains.stand[w] = first;
  return true;
}

std::vector<Route> sampled_alike(const RouteChains& chains, std::span<const Legs> routes) {
  std::vector<Route> all;
  for (std::size_t i = 0; i < routes.size(); ++i) {
    Route& route = all.emplace_back();
    const RouteChains::Chain& chain = chains.chains[i];
    Index first = chain.first;
    for (const std::vector<Vec3>& leg : routes[i]) {
      Index last = first + 1;
      while (!chains.pinned[last]) ++last;
      for (const Vec3& p : evenly(leg, last - first)) {
        const RoutePoint point = {p[0], p[1], p[2]};
        if (route.points.empty() || route.points.back() != point) route.points.push_back(point);
      }
      first = last;
    }
  }
  return all;
}

}  // namespace unsnarl
