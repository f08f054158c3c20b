#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "unsnarl/repair.h"
#include "unsnarl/scene_document.h"
#include "unsnarl/surface.h"

namespace unsnarl {

using RoutePoint = std::array<double, 3>;

/// A ball that is to get from one place to another. Lengths are in the units of the coordinates.
struct RouteAgent {
  std::string name;   ///< for messages and files; no two agents have the same
  double radius = 0;  ///< [1e-70, 1e70], and 1e-12 of the largest coordinate of the plan at least
  RoutePoint start{}, goal{};
  std::vector<RoutePoint> waypoints;  ///< places that the route goes through, in this order
  /// The route keeps the height (z) of the start. Goal and way-points are due to have it too.
  bool planar = false;
  /// Agents with a higher number choose their ways before others.
  double priority = 0;

  /// In time only. When the agent may leave its start, and when it has to be at its goal; it stands at its start
  /// before and at its goal afterwards. An end of infinity is that of all time. 0 <= first < second <= duration.
  std::array<double, 2> window = {0, std::numeric_limits<double>::infinity()};
  /// In time only. The fastest that the agent may move (length / time), above 0; infinity: any.
  double speed = std::numeric_limits<double>::infinity();
};

/// The place of an obstacle at a time, compared with the positions of its surface.
struct RouteMove {
  double time = 0;
  RoutePoint offset{};
};

/// Something that routes keep clear of.
struct RouteObstacle {
  std::string name;
  Surface surface;  ///< faces of any size; they may intersect
  /// The inside of a closed surface is free too: a room, say. Otherwise it is solid, and no agent can be there.
  bool hollow = false;
  /// In time only: the obstacle moves straight and evenly from each of these to the next, and stands before the first
  /// and after the last. Times ascend. Empty: it stands where its surface is.
  std::vector<RouteMove> motion;
};

struct RoutePlan {
  std::vector<RouteAgent> agents;
  std::vector<RouteObstacle> obstacles;
  /// Time is a coordinate too: agents only have to keep clear of where the others are at the same time, and may wait.
  /// Between two points of a route they move straight and evenly, each by the same part of all time, so that routes
  /// have equally many points. Otherwise routes keep clear of each other for all times.
  bool timed = false;
  /// In time: when the last point of all routes is reached; the first one is at 0. Above 0.
  double duration = 1;
};

/// A plan from JSON: {"agents": [{"name": "a", "radius": 1, "start": [x, y, z], "goal": [x, y, z], "waypoints":
/// [...]}], "obstacles": [{"name": "wall", "file": "wall.obj", "hollow": false}]}; a name, way-points, obstacles and
/// "hollow" may be missing; instead of a file, an obstacle may have "vertices" ([[x, y, z], ...]) and "faces" ([[0, 1,
/// 2], ...]). Agents may have "planar" and "priority". With "timed": true it is a plan in time, which may have a
/// "duration", its agents a "speed" and a "window" ([from, to]), its obstacles a "motion" ([[time, x, y, z], ...]).
/// `folder`: the one that files are named relative to.
/// Throws FileError, naming the place as in "agents[2].radius", for anything that is not such a plan or check_plan()
/// refuses.
RoutePlan parse_route_plan(std::string_view text, const std::filesystem::path& folder = {});
/// The plan as JSON with all digits, surfaces in place of files.
std::string route_plan_json(const RoutePlan& plan);
/// Throws std::invalid_argument, naming the place, for a plan without agents, names that are empty or stand twice,
/// radii that are not within 1e-70 and 1e70 or below 1e-12 of the largest coordinate, coordinates that are not finite
/// or beyond 1e70, two places of a route in a row that are the same, faces of vertices that do not exist, planar agents
/// whose places differ in z; in time, for a duration, speed, window or motion out of range, and without, for any of
/// them.
void check_plan(const RoutePlan& plan);

/// Lists what no routes can mend, one sentence each: a start, goal or way-point within the reach of one of another
/// agent (in time: a start of another's start, a goal of another's goal), or nearer to an obstacle than the radius, or
/// inside a solid one; a window too short for straight lines at full speed; a moving obstacle that comes to an agent
/// which has to stand. Decided exactly, but for the inside and for moving obstacles. Empty: nothing.
std::vector<std::string> route_obstructions(const RoutePlan& plan);

/// A polyline from start to goal; way-points are among its points.
struct Route {
  std::vector<RoutePoint> points;
};

/// The properties of routes that are certified. Distances are relative to those that are needed: 1 is just enough.
struct RouteFindings {
  /// Proven lower bounds, up to `measured_up_to`: of segments of two agents / the sum of their radii; of segments and
  /// faces of obstacles / the radius; of segments of one route that are pi radii apart along it / twice the radius.
  /// In time, the first is of two agents at the same time, and the last one is not asked for.
  double clearance = measured_up_to, obstacle_clearance = measured_up_to, self_clearance = measured_up_to;
  std::array<int, 2> agents = {-1, -1};    ///< those nearest to each other; -1: none is near another
  std::array<int, 2> obstacle = {-1, -1};  ///< agent and obstacle that are nearest
  int self = -1;                           ///< agent whose route is nearest to itself
  /// Proven upper bound of radius * curvature, 2 tan(a / 2) / min(|e|, |f|) where edges e, f meet at an angle a
  /// (E. Rawdon's MinRad): arcs of circles that are no smaller fit into all corners. In time, agents may turn on the
  /// spot where they stand, which is at points that stand twice in a row; such corners do not count.
  double turn = 0;
  int turn_agent = -1;         ///< the one whose route turns most
  double speed = 0;            ///< proven upper bound of speed / the one allowed; 0: none has a limit
  int speed_agent = -1;        ///< the fastest, so measured
  int late = -1;               ///< an agent that leaves or arrives out of its window; -1: none
  int off_plane = -1;          ///< a planar agent whose route leaves its height; -1: none
  bool places_kept = true;     ///< starts, goals and way-points are points of their routes, bit for bit, in order
  std::vector<double> length;  ///< of each route
  /// The length of straight lines from place to place, for each agent. No route is shorter.
  std::vector<double> straight;
  std::vector<double> arrival;  ///< in time: from when on each agent stands at its goal

  static constexpr double measured_up_to = 1.5;

  bool hold() const {
    return clearance >= 1 && obstacle_clearance >= 1 && self_clearance >= 1 && turn <= 1 && speed <= 1 && places_kept &&
           late < 0 && off_plane < 0;
  }
  double mean_ratio() const;  ///< of length / straight
  double max_ratio() const;
};

/// Certifies routes as they are: whatever is said to hold is proven by exact arithmetic. One route an agent.
/// Throws std::invalid_argument as check_plan does, for another number of routes, for routes of fewer than two points
/// or with coordinates that are not finite, and, in time, for other numbers of points than that of the first route.
RouteFindings check_routes(const RoutePlan& plan, std::span<const Route> routes);
/// What does not hold, one line each; empty: all holds.
std::string route_faults(const RoutePlan& plan, const RouteFindings& findings);

struct RouteOptions {
  /// Distance of the points of a route / its radius, (0, 2].
  double spacing = 0.5;
  double time_limit_s = 0;  ///< wall-clock seconds; 0: none
  /// Stop once the ways are known where the work begins (RoutesResult::asked), with Status::no_progress.
  bool ways_only = false;
};

struct RoutesResult {
  /// embedded: `found` holds. obstructed: `messages` says by what, nothing was tried. no_progress: no routes were found
  /// that hold; `routes` are the best. time_limit, cancelled: stopped; `routes` are as far as they got, or empty.
  Status status = Status::no_progress;
  std::vector<Route> routes;
  RouteFindings found;
  std::vector<std::string> messages;  ///< obstructions; agents without any way past the obstacles
  std::vector<Route> asked;           ///< where the work began: straight ways, or past obstacles, with corners
  /// Length of the route that each agent gets alone, with the obstacles but without the other agents: its shortest way
  /// on the grid, pulled tight. Good, but not proven to be the shortest.
  std::vector<double> alone_length;
  double seconds = 0;

  double mean_alone_ratio() const;  ///< of length / alone_length; 1 where nothing was measured
};

/// Routes whose tubes keep clear of each other and of obstacles (paper §4.3), short and smooth: straight ways, or the
/// shortest on a grid where obstacles are in the way, become elastic curves; tubes around them swell until none is in
/// another's way, then they are pulled tight. docs/routes.md explains how. The same input gives the same routes at any
/// number of threads (time limits and cancellation aside).
/// Throws std::invalid_argument as check_plan does, and for options out of range.
RoutesResult plan_routes(const RoutePlan& plan, const RouteOptions& options = {}, Context* context = nullptr);

/// Routes as JSON with all digits, with radii and what was found; and back. parse_routes takes the agents by name.
/// Throws FileError, naming the place.
std::string routes_json(const RoutePlan& plan, const RoutesResult& result);
std::vector<Route> parse_routes(std::string_view text, const RoutePlan& plan);

/// The tubes of all routes, closed, a component each: rings around the points, half balls at the ends. They lie within
/// the tubes that are certified. sides: of a ring, [3, 256]. parts: where each agent's vertices and faces are.
/// Throws std::invalid_argument.
Surface route_tubes(const RoutePlan& plan, std::span<const Route> routes, int sides = 16,
                    std::vector<SceneFile>* parts = nullptr);
/// The surface with the obstacles behind it, a part each.
Surface with_obstacles(const RoutePlan& plan, Surface surface, std::vector<SceneFile>* parts = nullptr);

/// An SVG file in which all agents move along their routes at the same time, evenly or as time says, seen from above at
/// an angle; frames: [2, 1000] keyframes.
std::string routes_animation_svg(const RoutePlan& plan, std::span<const Route> routes, int frames = 60);

/// Plans to try: "star_6", "star_20", "star_50" (agents change sides through one centre), "ring" (a bundle through a
/// ring), "maze" (agents through walls with gaps), "door" (in time: agents change sides through one gap for one).
/// Throws std::invalid_argument, naming them, for another one.
RoutePlan sample_route_plan(std::string_view name);
struct RoutePlanSample {
  std::string_view name, description;
};
std::span<const RoutePlanSample> route_plan_samples();

}  // namespace unsnarl
