#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "applications/routes/proven_bounds.h"
#include "applications/routes/segments.h"
#include "unsnarl/visible_text.h"

namespace unsnarl {
namespace {

/// Larger coordinates are refused, so that products of three are finite (unit: length)
constexpr double largest_finite = 1e90;
/// Boxes are enlarged by this, so that what is left out is apart whatever was rounded (unit: reach of the box, and its
/// largest coordinate)
constexpr double rounding_room = 1e-12;
/// Taken off the arc from which segments of one route count, so that rounding leaves none out (unit: radian)
constexpr double arc_rounding = 1e-9;

struct Segments {
  std::vector<std::array<Vec3, 2>> ends;
  std::vector<int> agent;
  std::vector<double> from, to;  // arc length along the route

  Segments(std::span<const Route> routes) {
    for (std::size_t i = 0; i < routes.size(); ++i) {
      double arc = 0;
      for (std::size_t k = 0; k + 1 < routes[i].points.size(); ++k) {
        ends.push_back({vec(routes[i].points[k]), vec(routes[i].points[k + 1])});
        agent.push_back(static_cast<int>(i));
        from.push_back(arc);
        arc += (ends.back()[1] - ends.back()[0]).norm();
        to.push_back(arc);
      }
    }
  }
  Index size() const { return static_cast<Index>(ends.size()); }
  Box box(Index s, double reach) const {
    Box box;
    box.extend(ends[s][0]);
    box.extend(ends[s][1]);
    const double size = std::max(ends[s][0].cwiseAbs().maxCoeff(), ends[s][1].cwiseAbs().maxCoeff());
    return box.inflated(reach * (1 + rounding_room) + rounding_room * size);
  }
};

void check_distances(const RoutePlan& plan, const Segments& segments, RouteFindings& found) {
  std::vector<Box> boxes;
  for (Index s = 0; s < segments.size(); ++s)
    boxes.push_back(segments.box(s, RouteFindings::measured_up_to * plan.agents[segments.agent[s]].radius));
  Bvh bvh;
  bvh.build(boxes);
  bvh.self_pairs([&](Index a, Index b) {
    if (a > b) std::swap(a, b);
    const int i = segments.agent[a], j = segments.agent[b];
    const double r = plan.agents[i].radius, s = plan.agents[j].radius;
    // The route's own segments count from half a turn of the smallest circle on that it may run along.
    if (i == j && segments.from[b] - segments.to[a] < (std::numbers::pi - arc_rounding) * r) return;
    const auto &p = segments.ends[a], &q = segments.ends[b];
    const Closest closest = closest_edge_edge(p[0], p[1], q[0], q[1]);
    const double bound = proven_clearance(p, q, closest.direction, r, s);
    if (i == j && bound < found.self_clearance) {
      found.self_clearance = bound;
      found.self = i;
    }
    if (i != j && bound < found.clearance) {
      found.clearance = bound;
      found.agents = {std::min(i, j), std::max(i, j)};
    }
  });
}

/// In time only the segments that two agents move along at the same time count.
void check_distances_in_time(const RoutePlan& plan, const Segments& segments, RouteFindings& found) {
  const Index a_route = segments.size() / static_cast<Index>(plan.agents.size());
  for (Index a = 0; a < segments.size(); ++a)
    for (Index b = a + a_route; b < segments.size(); b += a_route) {
      const auto &p = segments.ends[a], &q = segments.ends[b];
      const int i = segments.agent[a], j = segments.agent[b];
      const double r = plan.agents[i].radius, s = plan.agents[j].radius;
      const Closest closest = closest_in_time(p[0], p[1], q[0], q[1]);
      if (closest.distance > RouteFindings::measured_up_to * (1 + rounding_room) * (r + s)) continue;
      if (const double bound = proven_clearance_in_time(p, q, closest.direction, r, s); bound < found.clearance) {
        found.clearance = bound;
        found.agents = {i, j};
      }
    }
}

void check_obstacles(const RoutePlan& plan, const Segments& segments, RouteFindings& found) {
  const ObstacleTriangles triangles(plan);
  for (Index s = 0; s < segments.size(); ++s) {
    const int i = segments.agent[s];
    const double r = plan.agents[i].radius;
    const auto& p = segments.ends[s];
    triangles.near(segments.box(s, RouteFindings::measured_up_to * r), [&](Index t) {
      const std::array<Vec3, 3>& corners = triangles.corners(t);
      const Vec3 direction = closest_segment_triangle(p[0], p[1], corners).direction;
      const double bound = proven_clearance(p, corners, direction, r, 0);
      if (bound < found.obstacle_clearance) {
        found.obstacle_clearance = bound;
        found.obstacle = {i, triangles.obstacle(t)};
      }
    });
  }
}

/// From which point on the agent stands at its goal.
std::size_t arrival_of(const Route& route) {
  std::size_t k = route.points.size() - 1;
  while (k > 0 && route.points[k - 1] == route.points.back()) --k;
  return k;
}

/// Whether the agent stands at its start until its window begins, and at its goal from where it ends.
bool keeps_window(const RoutePlan& plan, const RouteAgent& agent, const Route& route) {
  const std::size_t steps = route.points.size() - 1;
  std::size_t leaves = 0;
  while (leaves < steps && route.points[leaves + 1] == route.points.front()) ++leaves;
  return is_at_or_after(leaves, steps, plan.duration, agent.window[0]) &&
         is_at_or_before(arrival_of(route), steps, plan.duration, std::min(agent.window[1], plan.duration));
}

/// In time, obstacles that move count where they are.
void check_moving_obstacles(const RoutePlan& plan, std::span<const Route> routes, RouteFindings& found) {
  for (std::size_t o = 0; o < plan.obstacles.size(); ++o) {
    const std::vector<RouteMove>& motion = plan.obstacles[o].motion;
    if (motion.empty()) continue;
    const ObstacleTriangles triangles(plan, static_cast<int>(o));
    if (triangles.empty()) continue;
    Box reach;  // of the obstacle, wherever it is
    for (const RouteMove& move : motion)
      for (const Vec3& end : {triangles.bounds().lo, triangles.bounds().hi}) reach.extend(Vec3(end + vec(move.offset)));
    const double size = std::max(reach.lo.cwiseAbs().maxCoeff(), reach.hi.cwiseAbs().maxCoeff());
    for (std::size_t i = 0; i < routes.size(); ++i) {
      const std::vector<RoutePoint>& points = routes[i].points;
      const double r = plan.agents[i].radius, near = RouteFindings::measured_up_to * r;
      const Box around = reach.inflated(near * (1 + rounding_room) + rounding_room * size);
      for (std::size_t k = 0; k + 1 < points.size(); ++k) {
        const Vec3 p = vec(points[k]), q = vec(points[k + 1]);
        Box box;
        box.extend(p);
        box.extend(q);
        if (!box.overlaps(around)) continue;
        const std::vector<Vec3> seen = seen_from(motion, p, q, k, points.size() - 1, plan.duration);
        for (std::size_t m = 0; m + 1 < seen.size(); ++m) {
          const std::span<const Vec3> segment(&seen[m], 2);
          Box own;
          own.extend(segment[0]);
          own.extend(segment[1]);
          const double room = std::max(segment[0].cwiseAbs().maxCoeff(), segment[1].cwiseAbs().maxCoeff());
          triangles.near(own.inflated(near * (1 + rounding_room) + rounding_room * (room + size)), [&](Index t) {
            const std::array<Vec3, 3>& corners = triangles.corners(t);
            const Vec3 direction = closest_segment_triangle(segment[0], segment[1], corners).direction;
            const double bound = proven_clearance_of_rounded(segment, corners, direction, r);
            if (bound < found.obstacle_clearance) {
              found.obstacle_clearance = bound;
              found.obstacle = {static_cast<int>(i), static_cast<int>(o)};
            }
          });
        }
      }
    }
  }
}

bool goes_through_places(const RouteAgent& agent, const Route& route) {
  if (route.points.front() != agent.start || route.points.back() != agent.goal) return false;
  auto at = route.points.begin() + 1;
  for (const RoutePoint& p : agent.waypoints) {
    at = std::find(at, route.points.end(), p);
    if (at == route.points.end()) return false;
    ++at;
  }
  return at != route.points.end();
}

}  // namespace

double RouteFindings::mean_ratio() const {
  double sum = 0;
  for (std::size_t i = 0; i < length.size(); ++i) sum += length[i] / straight[i];
  return length.empty() ? 1 : sum / static_cast<double>(length.size());
}

double RouteFindings::max_ratio() const {
  double most = 1;
  for (std::size_t i = 0; i < length.size(); ++i) most = std::max(most, length[i] / straight[i]);
  return most;
}

RouteFindings check_routes(const RoutePlan& plan, std::span<const Route> routes) {
  check_plan(plan);
  if (routes.size() != plan.agents.size())
    throw std::invalid_argument(fmt::format("there are {} routes, but {} agents", routes.size(), plan.agents.size()));
  RouteFindings found;
  for (std::size_t i = 0; i < routes.size(); ++i) {
    const RouteAgent& agent = plan.agents[i];
    const std::vector<RoutePoint>& points = routes[i].points;
    if (points.size() < 2)
      throw std::invalid_argument(fmt::format("the route of '{}' has fewer than two points", agent.name));
    if (plan.timed && points.size() != routes[0].points.size())
      throw std::invalid_argument(
          fmt::format("the route of '{}' has {} points, that of '{}' {}; in time, both are due "
                      "to have equally many",
                      agent.name, points.size(), plan.agents[0].name, routes[0].points.size()));
    for (std::size_t k = 0; k < points.size(); ++k)
      for (const double c : points[k])
        if (!(std::abs(c) <= largest_finite))
          throw std::invalid_argument(fmt::format("point {} of the route of '{}' is not finite", k, agent.name));
    found.places_kept = found.places_kept && goes_through_places(agent, routes[i]);
    for (std::size_t k = 1; k + 1 < points.size(); ++k) {
      if (plan.timed && (points[k - 1] == points[k] || points[k] == points[k + 1])) continue;
      const double turn = proven_turn(vec(points[k - 1]), vec(points[k]), vec(points[k + 1]), agent.radius);
      if (turn > found.turn) {
        found.turn = turn;
        found.turn_agent = static_cast<int>(i);
      }
    }
    for (std::size_t k = 0; k + 1 < points.size() && agent.speed < std::numeric_limits<double>::infinity(); ++k) {
      const double speed =
          proven_speed(vec(points[k]), vec(points[k + 1]), points.size() - 1, plan.duration, agent.speed);
      if (speed > found.speed) {
        found.speed = speed;
        found.speed_agent = static_cast<int>(i);
      }
    }
    if (plan.timed) {
      const double step = plan.duration / static_cast<double>(points.size() - 1);
      found.arrival.push_back(static_cast<double>(arrival_of(routes[i])) * step);
      if (!keeps_window(plan, agent, routes[i])) found.late = static_cast<int>(i);
    }
    if (agent.planar &&
        std::any_of(points.begin(), points.end(), [&](const RoutePoint& p) { return p[2] != agent.start[2]; }))
      found.off_plane = static_cast<int>(i);
    double length = 0, straight = 0;
    for (std::size_t k = 0; k + 1 < points.size(); ++k) length += (vec(points[k + 1]) - vec(points[k])).norm();
    const std::vector<Vec3> places = places_of(agent);
    for (std::size_t k = 0; k + 1 < places.size(); ++k) straight += (places[k + 1] - places[k]).norm();
    found.length.push_back(length);
    found.straight.push_back(straight);
  }
  const Segments segments(routes);
  if (plan.timed)
    check_distances_in_time(plan, segments, found);
  else
    check_distances(plan, segments, found);
  check_obstacles(plan, segments, found);
  check_moving_obstacles(plan, routes, found);
  return found;
}

std::string route_faults(const RoutePlan& plan, const RouteFindings& f) {
  const auto name = [&](int agent) { return visible_text(plan.agents[agent].name); };
  std::string text;
  if (!f.places_kept) text += "a route does not go through the places of its agent\n";
  if (f.clearance < 1)
    text +=
        fmt::format("{} '{}' and '{}' have {:.6g} of the distance that they need\n",
                    plan.timed ? "at some time" : "the routes of", name(f.agents[0]), name(f.agents[1]), f.clearance);
  if (f.obstacle_clearance < 1)
    text += fmt::format("the route of '{}' has {:.6g} of the distance from the obstacle '{}' that it needs\n",
                        name(f.obstacle[0]), f.obstacle_clearance, visible_text(plan.obstacles[f.obstacle[1]].name));
  if (f.self_clearance < 1)
    text += fmt::format("the route of '{}' has {:.6g} of the distance from itself that it needs\n", name(f.self),
                        f.self_clearance);
  if (!(f.turn <= 1))
    text += fmt::format("the route of '{}' turns {:.6g} times as tight as its radius\n", name(f.turn_agent), f.turn);
  if (!(f.speed <= 1))
    text += fmt::format("'{}' moves {:.6g} times as fast as its speed\n", name(f.speed_agent), f.speed);
  if (f.late >= 0) text += fmt::format("'{}' does not leave and arrive within its window\n", name(f.late));
  if (f.off_plane >= 0) text += fmt::format("the route of '{}' leaves its height, z\n", name(f.off_plane));
  return text;
}

}  // namespace unsnarl
