#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>

#include "applications/routes/moving_obstacles.h"
#include "applications/routes/proven_bounds.h"
#include "applications/routes/segments.h"
#include "geometry/portable_math.h"

namespace unsnarl {
namespace {

/// Larger coordinates and radii are refused, so that their sixth power is finite (unit: length)
constexpr double largest_coordinate = 1e70;
/// Smaller radii are refused, so that their square, and that of what rounding leaves of them, is not zero (unit:
/// length)
constexpr double least_radius = 1e-70;
/// Smaller radii are refused: rings would lose their shape to rounding, of which this is a thousand times (unit:
/// largest coordinate)
constexpr double least_radius_rel = 1e-12;

/// Shorter durations are refused, so that their square is not zero (unit: time)
constexpr double least_time = 1e-70;
/// Longer durations are refused, so that their square is finite (unit: time)
constexpr double largest_time = 1e70;
/// Slower agents are refused, so that the square of their speed is not zero (unit: length / time)
constexpr double least_speed = 1e-70;
/// Faster agents are refused, so that the square of their speed is finite (unit: length / time)
constexpr double largest_speed = 1e70;

/// Boxes are enlarged by this, twice what rounding could take away from a sum of two radii (unit: radius)
constexpr double radius_reserve = 1e-12;
/// Boxes are enlarged by this, a few roundings of a point (unit: coordinate)
constexpr double coordinate_reserve = 1e-15;

void check_point(const RoutePoint& p, const std::string& place) {
  for (const double c : p)
    if (!(std::abs(c) <= largest_coordinate))
      throw std::invalid_argument(
          fmt::format("{}: the coordinate {} is not a number up to {}", place, c, largest_coordinate));
}

void check_name(const std::string& name, const std::string& place) {
  if (name.empty()) throw std::invalid_argument(place + ".name is empty");
  if (std::any_of(name.begin(), name.end(), [](unsigned char c) { return c < ' '; }))
    throw std::invalid_argument(place + ".name has a line break or another control character");
}

void check_agent(const RouteAgent& agent, const std::string& place) {
  check_name(agent.name, place);
  if (!(agent.radius > 0))
    throw std::invalid_argument(fmt::format("{}.radius is {}; give a number above 0", place, agent.radius));
  if (!(agent.radius <= largest_coordinate))
    throw std::invalid_argument(
        fmt::format("{}.radius is {}; give {} at most, in another unit", place, agent.radius, largest_coordinate));
  if (agent.radius < least_radius)
    throw std::invalid_argument(fmt::format("{}.radius is {}, which is too small: give {} at least, in another unit",
                                            place, agent.radius, least_radius));
  check_point(agent.start, place + ".start");
  check_point(agent.goal, place + ".goal");
  for (std::size_t k = 0; k < agent.waypoints.size(); ++k)
    check_point(agent.waypoints[k], fmt::format("{}.waypoints[{}]", place, k));
  const std::vector<Vec3> places = places_of(agent);
  for (std::size_t k = 0; k + 1 < places.size(); ++k)
    if (places[k] == places[k + 1])
      throw std::invalid_argument(fmt::format("{}: agent '{}' goes from ({}, {}, {}) to the same place", place,
                                              agent.name, places[k][0], places[k][1], places[k][2]));
  for (const Vec3& p : places)
    if (agent.planar && p.z() != agent.start[2])
      throw std::invalid_argument(fmt::format("{}: agent '{}' is planar, but its places have different z: {} and {}",
                                              place, agent.name, agent.start[2], p.z()));
}

/// What only a plan in time has is refused without, since it would be ignored.
void check_time(const RoutePlan& plan) {
  const auto refuse_untimed = [&](const std::string& place) {
    if (!plan.timed) throw std::invalid_argument(place + ": give the plan \"timed\": true too");
  };
  if (!(plan.duration >= least_time && plan.duration <= largest_time))
    throw std::invalid_argument(
        fmt::format("duration is {}; give a number from {} to {}", plan.duration, least_time, largest_time));
  for (std::size_t i = 0; i < plan.agents.size(); ++i) {
    const RouteAgent& agent = plan.agents[i];
    const std::string place = fmt::format("agents[{}]", i);
    if (!std::isfinite(agent.priority)) throw std::invalid_argument(place + ".priority is not a number");
    if (agent.window != RouteAgent().window) {
      refuse_untimed(place + ".window");
      const auto [from, to] = agent.window;
      if (!(from >= 0 && from < to && from < plan.duration && (to <= plan.duration || std::isinf(to))))
        throw std::invalid_argument(
            fmt::format("{}.window is [{}, {}]; give two times that ascend, from 0 to the "
                        "plan's duration of {}",
                        place, from, to, plan.duration));
    }
    if (agent.speed != RouteAgent().speed) {
      refuse_untimed(place + ".speed");
      if (!(agent.speed >= least_speed && agent.speed <= largest_speed))
        throw std::invalid_argument(
            fmt::format("{}.speed is {}; give a number from {} to {}", place, agent.speed, least_speed, largest_speed));
    }
  }
  for (std::size_t o = 0; o < plan.obstacles.size(); ++o)
    for (std::size_t k = 0; k < plan.obstacles[o].motion.size(); ++k) {
      const std::string place = fmt::format("obstacles[{}].motion[{}]", o, k);
      refuse_untimed(place);
      const std::vector<RouteMove>& motion = plan.obstacles[o].motion;
      if (!(std::abs(motion[k].time) <= largest_time) || (k > 0 && !(motion[k - 1].time < motion[k].time)))
        throw std::invalid_argument(
            fmt::format("{}: the time {} is not a number after the one before", place, motion[k].time));
      check_point(motion[k].offset, place);
    }
}

void check_obstacle(const RouteObstacle& obstacle, const std::string& place) {
  check_name(obstacle.name, place);
  const SurfaceView surface = obstacle.surface;
  if (surface.positions.size() % 3 != 0)
    throw std::invalid_argument(place + ": its positions are not three numbers a vertex");
  for (std::size_t v = 0; v < surface.vertex_count(); ++v)
    check_point({surface.positions[3 * v], surface.positions[3 * v + 1], surface.positions[3 * v + 2]},
                fmt::format("{}.vertices[{}]", place, v));
  for (std::size_t f = 0; f < surface.face_count(); ++f)
    for (const std::int32_t v : surface.face(f))
      if (v < 0 || static_cast<std::size_t>(v) >= surface.vertex_count())
        throw std::invalid_argument(
            fmt::format("{}.faces[{}] uses vertex {}, but it has {} vertices", place, f, v, surface.vertex_count()));
}

double largest_coordinate_of(const RoutePlan& plan) {
  double largest = 0;
  for (const RouteAgent& agent : plan.agents)
    for (const Vec3& p : places_of(agent)) largest = std::max(largest, p.cwiseAbs().maxCoeff());
  for (const RouteObstacle& obstacle : plan.obstacles)
    for (const double c : obstacle.surface.positions) largest = std::max(largest, std::abs(c));
  for (const RouteObstacle& obstacle : plan.obstacles)
    for (const RouteMove& move : obstacle.motion)
      for (const double c : move.offset) largest = std::max(largest, std::abs(c));
  return largest;
}

void check_radii_beside_coordinates(const RoutePlan& plan) {
  const double largest = largest_coordinate_of(plan), least = least_radius_rel * largest;
  for (std::size_t i = 0; i < plan.agents.size(); ++i)
    if (plan.agents[i].radius < least)
      throw std::invalid_argument(fmt::format(
          "agents[{}].radius is {}, which is too small beside coordinates up to {}: double precision cannot "
          "say where such a tube is; give {:.3g} at least, or move the plan nearer to the origin",
          i, plan.agents[i].radius, largest, least));
}

/// Whether every edge, by the positions of its ends, has an even number of faces.
bool is_closed(const ObstacleTriangles& triangles, int obstacle) {
  using Place = std::array<double, 3>;
  std::map<std::pair<Place, Place>, bool> open;
  const auto place = [](const Vec3& p) { return Place{p[0], p[1], p[2]}; };
  for (Index t = 0; t < triangles.size(); ++t) {
    if (triangles.obstacle(t) != obstacle) continue;
    for (int k = 0; k < 3; ++k) {
      const Place from = place(triangles.corners(t)[k]), to = place(triangles.corners(t)[(k + 1) % 3]);
      bool& is_open = open[std::minmax(from, to)];
      is_open = !is_open;
    }
  }
  return !open.empty() && std::none_of(open.begin(), open.end(), [](const auto& edge) { return edge.second; });
}

/// How often the obstacle winds around a point (A. van Oosterom, J. Strackee: "The Solid Angle of a Plane Triangle",
/// 1983).
double winding_number(const ObstacleTriangles& triangles, int obstacle, const Vec3& p) {
  double sum = 0;
  for (Index t = 0; t < triangles.size(); ++t) {
    if (triangles.obstacle(t) != obstacle) continue;
    const std::array<Vec3, 3>& corners = triangles.corners(t);
    const Vec3 a = corners[0] - p, b = corners[1] - p, c = corners[2] - p;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    sum += 2 * portable::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return sum / (4 * std::numbers::pi);
}

struct Place {
  std::string name;
  Vec3 at;
};
std::vector<Place> named_places(const RouteAgent& agent) {
  std::vector<Place> places{{fmt::format("the start of '{}'", agent.name), vec(agent.start)}};
  for (std::size_t k = 0; k < agent.waypoints.size(); ++k)
    places.push_back({fmt::format("way-point {} of '{}'", k, agent.name), vec(agent.waypoints[k])});
  places.push_back({fmt::format("the goal of '{}'", agent.name), vec(agent.goal)});
  return places;
}

void add_obstructions_of_agents(const RoutePlan& plan, std::vector<std::string>& found) {
  std::vector<Box> boxes;
  std::vector<Place> places;
  std::vector<int> agent;
  for (std::size_t i = 0; i < plan.agents.size(); ++i)
    for (Place& place : named_places(plan.agents[i])) {
      const Vec3 reach =
          Vec3::Constant(plan.agents[i].radius * (1 + radius_reserve)) + coordinate_reserve * place.at.cwiseAbs();
      boxes.push_back({place.at - reach, place.at + reach});
      places.push_back(std::move(place));
      agent.push_back(static_cast<int>(i));
    }
  const auto is_start = [&](Index p) { return p == 0 || agent[p - 1] != agent[p]; };
  const auto is_goal = [&](Index p) { return p + 1 == static_cast<Index>(agent.size()) || agent[p + 1] != agent[p]; };
  Bvh bvh;
  bvh.build(boxes);
  std::vector<std::array<Index, 2>> near;
  bvh.self_pairs([&](Index a, Index b) {
    if (agent[a] == agent[b]) return;
    // In time, of two agents only both starts count, and both goals: where the others are then.
    if (plan.timed && !(is_start(a) && is_start(b)) && !(is_goal(a) && is_goal(b))) return;
    near.push_back({std::min(a, b), std::max(a, b)});
  });
  std::sort(near.begin(), near.end());
  for (const auto& [a, b] : near) {
    const double r = plan.agents[agent[a]].radius, s = plan.agents[agent[b]].radius;
    if (!is_as_far(places[a].at, places[b].at, r, s))
      found.push_back(fmt::format("{} and {} are {:.6g} apart, less than the {:.6g} of both radii", places[a].name,
                                  places[b].name, (places[a].at - places[b].at).norm(), r + s));
  }
}

/// Windows too short for straight lines at full speed.
void add_obstructions_in_time(const RoutePlan& plan, std::vector<std::string>& found) {
  for (const RouteAgent& agent : plan.agents) {
    const std::vector<Vec3> places = places_of(agent);
    double straight = 0;
    for (std::size_t k = 0; k + 1 < places.size(); ++k) straight += (places[k + 1] - places[k]).norm();
    const double left = std::min(agent.window[1], plan.duration) - agent.window[0];
    if (straight * (1 - radius_reserve) > agent.speed * left)
      found.push_back(
          fmt::format("'{}' needs {:.6g} of time for its {:.6g} of straight lines at a speed of {:.6g}, but "
                      "its window has {:.6g}",
                      agent.name, straight / agent.speed, straight, agent.speed, left));
  }
}

/// Obstacles that move to where an agent has to stand: at its start before its window, at its goal after it.
void add_obstructions_of_moving_obstacles(const RoutePlan& plan, std::vector<std::string>& found) {
  for (const MovingObstacle& obstacle : moving_obstacles(plan, 1))
    for (const RouteAgent& agent : plan.agents) {
      const auto comes_to = [&](const RoutePoint& place, double from, double to) {
        const auto at = [&](double time) { return std::clamp(time / plan.duration, 0.0, 1.0); };
        for (const MovingObstacle::Piece& piece : obstacle.pieces(0)) {
          const double lo = std::max(at(from), piece.from), hi = std::min(at(to), piece.to);
          if (lo > hi) continue;
          const auto seen = [&](double share) {
            const double part = (share - piece.from) / (piece.to - piece.from);
            return Vec3(vec(place) - piece.offset_from - part * (piece.offset_to - piece.offset_from));
          };
          if (!obstacle.triangles().is_clear(seen(lo), seen(hi), agent.radius * (1 - radius_reserve))) return true;
        }
        return false;
      };
      const auto add = [&](const char* place) {
        found.push_back(fmt::format("the obstacle '{}' comes to the {} of '{}' when the agent has to be there",
                                    plan.obstacles[obstacle.triangles().obstacle(0)].name, place, agent.name));
      };
      if (comes_to(agent.start, 0, agent.window[0])) add("start");
      if (comes_to(agent.goal, agent.window[1], plan.duration)) add("goal");
    }
}

void add_obstructions_of_obstacles(const RoutePlan& plan, std::vector<std::string>& found) {
  const ObstacleTriangles triangles(plan);
  if (triangles.empty()) return;
  std::vector<int> solid;
  for (std::size_t o = 0; o < plan.obstacles.size(); ++o)
    if (!plan.obstacles[o].hollow && is_closed(triangles, static_cast<int>(o))) solid.push_back(static_cast<int>(o));
  for (const RouteAgent& agent : plan.agents)
    for (const Place& place : named_places(agent)) {
      int nearest = -1;
      double distance = agent.radius;
      Box box;
      box.extend(place.at);
      triangles.near(
          box.inflated(agent.radius * (1 + radius_reserve) + coordinate_reserve * place.at.cwiseAbs().maxCoeff()),
          [&](Index t) {
            const std::array<Vec3, 3>& c = triangles.corners(t);
            const Closest closest = closest_vertex_face(place.at, c[0], c[1], c[2]);
            const std::array<Vec3, 1> point{place.at};
            if (closest.distance <= distance && proven_clearance(point, c, closest.direction, agent.radius, 0) < 1) {
              distance = closest.distance;
              nearest = triangles.obstacle(t);
            }
          });
      if (nearest >= 0) {
        found.push_back(fmt::format("{} is {:.6g} from the obstacle '{}', nearer than its radius of {:.6g}", place.name,
                                    distance, plan.obstacles[nearest].name, agent.radius));
        continue;
      }
      for (const int o : solid)
        if (std::abs(winding_number(triangles, o, place.at)) > 0.5)
          found.push_back(fmt::format("{} is inside the obstacle '{}'; if that is a room, give it \"hollow\": true",
                                      place.name, plan.obstacles[o].name));
    }
}

}  // namespace

void check_plan(const RoutePlan& plan) {
  if (plan.agents.empty()) throw std::invalid_argument("agents: there are none");
  std::map<std::string, std::size_t> names;
  for (std::size_t i = 0; i < plan.agents.size(); ++i) {
    const std::string place = fmt::format("agents[{}]", i);
    check_agent(plan.agents[i], place);
    const auto [at, is_new] = names.emplace(plan.agents[i].name, i);
    if (!is_new)
      throw std::invalid_argument(
          fmt::format("{}.name: '{}' is the name of agents[{}] too", place, plan.agents[i].name, at->second));
  }
  names.clear();
  for (std::size_t o = 0; o < plan.obstacles.size(); ++o) {
    const std::string place = fmt::format("obstacles[{}]", o);
    check_obstacle(plan.obstacles[o], place);
    const auto [at, is_new] = names.emplace(plan.obstacles[o].name, o);
    if (!is_new)
      throw std::invalid_argument(
          fmt::format("{}.name: '{}' is the name of obstacles[{}] too", place, plan.obstacles[o].name, at->second));
  }
  check_time(plan);
  check_radii_beside_coordinates(plan);
}

std::vector<std::string> route_obstructions(const RoutePlan& plan) {
  check_plan(plan);
  std::vector<std::string> found;
  add_obstructions_of_agents(plan, found);
  if (plan.timed) add_obstructions_in_time(plan, found);
  add_obstructions_of_obstacles(plan, found);
  add_obstructions_of_moving_obstacles(plan, found);
  return found;
}

}  // namespace unsnarl
