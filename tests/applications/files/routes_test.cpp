#include "unsnarl/routes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "geometry/parallel.h"
#include "unsnarl/document.h"
#include "unsnarl/intersections.h"

namespace unsnarl {
namespace {

RouteAgent agent(const std::string& name, double radius, const RoutePoint& start, const RoutePoint& goal) {
  RouteAgent made;
  made.name = name;
  made.radius = radius;
  made.start = start;
  made.goal = goal;
  return made;
}

RouteObstacle box(const std::string& name, const RoutePoint& low, const RoutePoint& high) {
  RouteObstacle made;
  made.name = name;
  for (int k = 0; k < 8; ++k)
    for (int axis = 0; axis < 3; ++axis) made.surface.positions.push_back((k >> axis & 1 ? high : low)[axis]);
  made.surface.corners = {0, 4, 6, 2, 1, 3, 7, 5, 0, 1, 5, 4, 2, 6, 7, 3, 0, 2, 3, 1, 4, 5, 7, 6};
  made.surface.offsets = {0, 4, 8, 12, 16, 20, 24};
  return made;
}

Route straight(const RouteAgent& a, int segments = 20) {
  Route route;
  for (int k = 0; k < segments; ++k) {
    RoutePoint p{};
    for (int i = 0; i < 3; ++i) p[i] = a.start[i] + (a.goal[i] - a.start[i]) * k / segments;
    route.points.push_back(p);
  }
  route.points.push_back(a.goal);
  return route;
}

/// Distance of two segments by golden-section search in both parameters: slow, and shares no code with the library.
double distance_by_search(const RoutePoint& a, const RoutePoint& b, const RoutePoint& c, const RoutePoint& d) {
  const auto least = [](auto&& f) {
    double lo = 0, hi = 1;
    for (int k = 0; k < 50; ++k) {
      const double s = lo + 0.382 * (hi - lo), t = lo + 0.618 * (hi - lo);
      (f(s) < f(t) ? hi : lo) = f(s) < f(t) ? t : s;
    }
    return f(0.5 * (lo + hi));
  };
  return least([&](double s) {
    return least([&](double t) {
      double sum = 0;
      for (int i = 0; i < 3; ++i) {
        const double along = a[i] + s * (b[i] - a[i]) - c[i] - t * (d[i] - c[i]);
        sum += along * along;
      }
      return std::sqrt(sum);
    });
  });
}

/// Looks at the routes again, in another way.
void expect_routes(const RoutePlan& plan, const RoutesResult& made) {
  ASSERT_EQ(made.status, Status::embedded) << route_faults(plan, made.found);
  EXPECT_TRUE(made.found.hold());
  for (std::size_t i = 0; i < plan.agents.size(); ++i) {
    EXPECT_EQ(made.routes[i].points.front(), plan.agents[i].start);
    EXPECT_EQ(made.routes[i].points.back(), plan.agents[i].goal);
    EXPECT_GE(made.found.length[i], made.found.straight[i] * (1 - 1e-12));
  }
  double least = 10;
  for (std::size_t i = 0; i < plan.agents.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      for (std::size_t k = 0; k + 1 < made.routes[i].points.size(); k += 3)
        for (std::size_t l = 0; l + 1 < made.routes[j].points.size(); l += 3) {
          const auto &p = made.routes[i].points, &q = made.routes[j].points;
          least = std::min(least, distance_by_search(p[k], p[k + 1], q[l], q[l + 1]) /
                                      (plan.agents[i].radius + plan.agents[j].radius));
        }
  EXPECT_GE(least, made.found.clearance * (1 - 1e-6));
  std::vector<SceneFile> parts;
  const Surface tubes = route_tubes(plan, made.routes, 8, &parts);
  EXPECT_EQ(parts.size(), plan.agents.size());
  EXPECT_TRUE(find_intersections(tubes).empty());
}

RoutePlan three_crossing() {
  RoutePlan plan;
  plan.agents = {agent("a", 0.5, {-5, 0, 0}, {5, 0, 0}), agent("b", 0.5, {0, -5, 0}, {0, 5, 0}),
                 agent("c", 0.3, {0, 0, -5}, {0, 0, 5})};
  return plan;
}

TEST(PlanRoutes, agents_that_meet_in_one_point_go_around_each_other) {
  const RoutePlan plan = three_crossing();
  const RoutesResult made = plan_routes(plan);
  expect_routes(plan, made);
  EXPECT_LT(made.found.max_ratio(), 1.1);
  EXPECT_LT(check_routes(plan, made.asked).clearance, 1);
}

TEST(PlanRoutes, six_agents_in_a_plane_leave_it) {
  const RoutePlan plan = sample_route_plan("star_6");
  const RoutesResult made = plan_routes(plan);
  expect_routes(plan, made);
  EXPECT_LT(made.found.mean_ratio(), 1.1);
}

TEST(PlanRoutes, a_wall_is_gone_around_and_a_round_turn_made) {
  RoutePlan plan;
  plan.agents = {agent("a", 0.3, {-4, 0, 0}, {4, 0, 0}), agent("b", 0.3, {-4, 1, 0}, {4, -1, 0})};
  plan.obstacles = {box("wall", {-0.2, -2, -2}, {0.2, 2, 2})};
  const RoutesResult made = plan_routes(plan);
  expect_routes(plan, made);
  EXPECT_LT(made.found.obstacle_clearance, 1.2);
  ASSERT_EQ(made.alone_length.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_LT(made.found.length[i], 1.1 * made.alone_length[i]);
  EXPECT_LT(made.mean_alone_ratio(), 1.1);
}

TEST(PlanRoutes, alone_an_agent_goes_through_the_nearest_hole) {
  // A hole for one in the middle of a wall, and another one beside it.
  RoutePlan plan;
  plan.agents = {agent("a", 0.3, {-4, 0, 0.5}, {4, 0, 0.5}), agent("b", 0.3, {-4, 0, -0.5}, {4, 0, -0.5})};
  plan.obstacles = {box("below", {-0.2, -9, -9}, {0.2, 9, -0.4}), box("above", {-0.2, -9, 0.4}, {0.2, 9, 9}),
                    box("left", {-0.2, -9, -0.4}, {0.2, -0.4, 0.4}), box("between", {-0.2, 0.4, -0.4}, {0.2, 1.1, 0.4}),
                    box("right", {-0.2, 1.9, -0.4}, {0.2, 9, 0.4})};
  const RoutesResult made = plan_routes(plan);
  expect_routes(plan, made);
  ASSERT_EQ(made.alone_length.size(), 2U);
  for (const double length : made.alone_length) EXPECT_LT(length, 8.2);
  EXPECT_GT(std::max(made.found.length[0], made.found.length[1]), 8.4);
}

TEST(PlanRoutes, a_way_there_and_back_turns_no_tighter_than_the_radius) {
  RoutePlan plan;
  plan.agents = {agent("a", 0.5, {0, 0, 0}, {0, 2, 0})};
  plan.agents[0].waypoints = {{6, 0, 0}};
  const RoutesResult made = plan_routes(plan);
  expect_routes(plan, made);
  EXPECT_GT(made.found.turn, 0.5);
}

TEST(PlanRoutes, the_same_at_any_number_of_threads) {
  const RoutePlan plan = three_crossing();
  std::vector<std::string> made;
  for (const std::size_t threads : {1, 4}) {
    const ThreadLimit limit(threads);
    RoutesResult result = plan_routes(plan);
    result.seconds = 0;
    made.push_back(routes_json(plan, result));
  }
  EXPECT_EQ(made[0], made[1]);
}

TEST(PlanRoutes, obstructions_are_named_before_anything_runs) {
  RoutePlan plan = three_crossing();
  plan.agents[1].start = {-5, 0.9, 0};
  plan.agents[2].goal = {3, 3, 3};
  plan.obstacles = {box("block", {2, 2, 2}, {4, 4, 4}), box("plate", {-6, -1, -1}, {-5.25, 1, 1})};
  const RoutesResult made = plan_routes(plan);
  EXPECT_EQ(made.status, Status::obstructed);
  EXPECT_TRUE(made.routes.empty());
  ASSERT_EQ(made.messages.size(), 4U);
  EXPECT_EQ(made.messages[0], "the start of 'a' and the start of 'b' are 0.9 apart, less than the 1 of both radii");
  EXPECT_EQ(made.messages[1], "the start of 'a' is 0.25 from the obstacle 'plate', nearer than its radius of 0.5");
  EXPECT_NE(made.messages[3].find("the goal of 'c' is inside the obstacle 'block'"), std::string::npos);
}

TEST(PlanRoutes, what_just_touches_is_no_obstruction) {
  RoutePlan plan;
  plan.agents = {agent("a", 0.5, {0, 0, 0}, {9, 0, 0}), agent("b", 0.5, {0, 1, 0}, {9, 1, 0})};
  EXPECT_TRUE(route_obstructions(plan).empty());
  plan.agents[1].start[1] = std::nextafter(1.0, 0.0);
  EXPECT_EQ(route_obstructions(plan).size(), 1U);
}

TEST(PlanRoutes, a_room_is_hollow_only_where_the_plan_says_so) {
  RoutePlan plan;
  plan.agents = {agent("a", 0.5, {-2, 0, 0}, {2, 0, 0})};
  plan.obstacles = {box("room", {-4, -4, -4}, {4, 4, 4})};
  EXPECT_EQ(route_obstructions(plan).size(), 2U);
  plan.obstacles[0].hollow = true;
  expect_routes(plan, plan_routes(plan));
}

TEST(PlanRoutes, agents_that_are_shut_in_are_named) {
  RoutePlan plan;
  plan.agents = {agent("a", 0.5, {0, 0, 0}, {9, 0, 0})};
  plan.obstacles = {box("cell", {-2, -2, -2}, {2, 2, 2})};
  plan.obstacles[0].hollow = true;
  const RoutesResult made = plan_routes(plan);
  EXPECT_EQ(made.status, Status::no_progress);
  ASSERT_EQ(made.messages.size(), 1U);
  EXPECT_NE(made.messages[0].find("no way was found for 'a'"), std::string::npos);
}

/// The smallest distance of two agents / that needed, at many times between two points of their routes.
double clearance_at_times(const RoutePlan& plan, const std::vector<Route>& routes) {
  double least = 10;
  for (std::size_t i = 0; i < routes.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      for (std::size_t k = 0; k + 1 < routes[i].points.size(); ++k)
        for (int part = 0; part <= 16; ++part) {
          double sum = 0;
          for (int d = 0; d < 3; ++d) {
            const auto at = [&](const Route& r) {
              return (1 - part / 16.0) * r.points[k][d] + part / 16.0 * r.points[k + 1][d];
            };
            sum += (at(routes[i]) - at(routes[j])) * (at(routes[i]) - at(routes[j]));
          }
          least = std::min(least, std::sqrt(sum) / (plan.agents[i].radius + plan.agents[j].radius));
        }
  return least;
}

TEST(PlanRoutes, in_time_agents_change_places) {
  RoutePlan plan;
  plan.agents = {agent("a", 0.5, {-5, 0, 0}, {5, 0, 0}), agent("b", 0.4, {5, 0, 0}, {-5, 0, 0}),
                 agent("c", 0.3, {0, 0, 2}, {0, 0, 1})};
  EXPECT_EQ(plan_routes(plan).status, Status::obstructed);  // where one starts another one is to end
  plan.timed = true;
  const RoutesResult made = plan_routes(plan);
  ASSERT_EQ(made.status, Status::embedded) << route_faults(plan, made.found);
  EXPECT_GE(clearance_at_times(plan, made.routes), 1);
  EXPECT_LT(made.found.max_ratio(), 1.2);
  for (const Route& route : made.routes) EXPECT_EQ(route.points.size(), made.routes[0].points.size());
  plan.agents[2].start = {-5, 0.5, 0};
  EXPECT_EQ(route_obstructions(plan).size(), 1U);
}

TEST(PlanRoutes, in_time_one_after_the_other_goes_through_a_door) {
  const RoutePlan plan = sample_route_plan("door");
  const RoutesResult made = plan_routes(plan);
  ASSERT_EQ(made.status, Status::embedded) << route_faults(plan, made.found);
  EXPECT_GE(clearance_at_times(plan, made.routes), 1);
  RoutePlan for_all_times = plan;
  for_all_times.timed = false;
  EXPECT_LT(check_routes(for_all_times, made.routes).clearance, 1);
  // All go through the door, in whose plane they are no farther from its middle than it lets them.
  for (const Route& route : made.routes)
    for (std::size_t k = 0; k + 1 < route.points.size(); ++k)
      if (route.points[k][0] * route.points[k + 1][0] <= 0) {
        EXPECT_LT(std::max(std::abs(route.points[k][1]), std::abs(route.points[k][2])), 0.5);
      }
  EXPECT_EQ(parse_route_plan(route_plan_json(plan)).timed, true);
}

/// A corridor with room for one, 12 long, and a bay in its middle; flat agents of radius 0.5 pass each other there
/// only.
RoutePlan corridor_with_bay() {
  RoutePlan plan;
  plan.timed = true;
  plan.agents = {agent("a", 0.5, {-5, 0, 0}, {5, 0, 0}), agent("b", 0.5, {5, 0, 0}, {-5, 0, 0})};
  for (RouteAgent& a : plan.agents) a.planar = true;
  plan.obstacles = {box("south", {-6, -1, -1}, {6, -0.6, 1}),    box("west", {-6, 0.6, -1}, {-1, 1, 1}),
                    box("east", {1, 0.6, -1}, {6, 1, 1}),        box("bay_west", {-1.4, 1, -1}, {-1, 2.5, 1}),
                    box("bay_east", {1, 1, -1}, {1.4, 2.5, 1}),  box("bay_end", {-1.4, 2.5, -1}, {1.4, 3, 1}),
                    box("west_end", {-6.4, -1, -1}, {-6, 1, 1}), box("east_end", {6, -1, -1}, {6.4, 1, 1})};
  return plan;
}

TEST(PlanRoutes, in_a_corridor_one_waits_in_the_bay) {
  const RoutePlan plan = corridor_with_bay();
  const RoutesResult made = plan_routes(plan);
  ASSERT_EQ(made.status, Status::embedded) << route_faults(plan, made.found);
  EXPECT_GE(clearance_at_times(plan, made.routes), 1);
  int in_the_bay = 0;
  for (const Route& route : made.routes) {
    bool was_there = false;
    for (const RoutePoint& p : route.points) {
      was_there = was_there || p[1] > 0.6;
      EXPECT_EQ(p[2], 0);
    }
    in_the_bay += was_there ? 1 : 0;
  }
  EXPECT_EQ(in_the_bay, 1);
}

TEST(PlanRoutes, who_has_a_short_way_arrives_soon) {
  RoutePlan plan;
  plan.timed = true;
  plan.duration = 100;
  plan.agents = {agent("far", 0.5, {-10, 0, 0}, {10, 0, 0}), agent("near", 0.5, {0, -3, 0}, {0, -5, 0})};
  for (RouteAgent& a : plan.agents) a.speed = 1;
  const RoutesResult made = plan_routes(plan);
  ASSERT_EQ(made.status, Status::embedded) << route_faults(plan, made.found);
  EXPECT_LT(made.found.arrival[0], 25);
  EXPECT_LT(made.found.arrival[1], 4);
}

TEST(PlanRoutes, who_has_priority_does_not_wait) {
  RoutePlan plan = corridor_with_bay();
  plan.duration = 60;
  plan.agents[1].start = {3, 0, 0};  // nearer to the bay
  for (RouteAgent& a : plan.agents) a.speed = 1;
  plan.agents[0].priority = 1;
  RoutesResult made = plan_routes(plan);
  ASSERT_EQ(made.status, Status::embedded) << route_faults(plan, made.found);
  EXPECT_LT(made.found.arrival[0], 12);
  EXPECT_GT(made.found.arrival[1], 12);
  EXPECT_LE(made.found.speed, 1);
  EXPECT_GT(made.found.speed, 0.5);
  // The other way round, the first one is in the bay's mouth before 'a' could be in the bay.
  plan.agents[1].priority = 2;
  made = plan_routes(plan);
  EXPECT_EQ(made.status, Status::no_progress);
  ASSERT_EQ(made.messages.size(), 1U);
  EXPECT_NE(made.messages[0].find("no way in time was found for 'a'"), std::string::npos) << made.messages[0];
}

TEST(PlanRoutes, agents_leave_and_arrive_within_their_windows) {
  RoutePlan plan;
  plan.timed = true;
  plan.duration = 30;
  plan.agents = {agent("a", 0.5, {-5, 0, 0}, {5, 0, 0}), agent("b", 0.5, {0, -5, 0}, {0, 5, 0})};
  plan.agents[0].window = {2, 14};
  plan.agents[1].window = {10, 30};
  for (RouteAgent& a : plan.agents) a.speed = 1;
  const RoutesResult made = plan_routes(plan);
  ASSERT_EQ(made.status, Status::embedded) << route_faults(plan, made.found);
  const auto at = [&](std::size_t i, double time) {
    return made.routes[i].points[static_cast<std::size_t>(time / 30 * (made.routes[i].points.size() - 1))];
  };
  EXPECT_EQ(at(0, 2), plan.agents[0].start);
  EXPECT_NE(at(0, 5), plan.agents[0].start);
  EXPECT_EQ(at(0, 14.1), plan.agents[0].goal);
  EXPECT_EQ(at(1, 10), plan.agents[1].start);
  plan.agents[1].window = {10, 19.9};  // 10 at a speed of 1
  const std::vector<std::string> named = route_obstructions(plan);
  ASSERT_EQ(named.size(), 1U);
  EXPECT_NE(named[0].find("'b' needs 10 of time for its 10 of straight lines"), std::string::npos) << named[0];
  EXPECT_EQ(plan_routes(plan).status, Status::obstructed);
}

TEST(PlanRoutes, an_obstacle_that_moves_is_let_pass) {
  // A gate slides over the only gap in a wall, and opens it again.
  RoutePlan plan;
  plan.timed = true;
  plan.duration = 40;
  plan.agents = {agent("a", 0.4, {-4, 0, 0}, {4, 0, 0})};
  plan.agents[0].planar = true;
  plan.agents[0].speed = 1;
  plan.obstacles = {box("north", {-0.2, 0.6, -1}, {0.2, 20, 1}), box("south", {-0.2, -20, -1}, {0.2, -0.6, 1}),
                    box("gate", {-0.2, -0.6, -1}, {0.2, 0.6, 1})};
  plan.obstacles[2].motion = {{0, {0, 0, 0}}, {15.3, {0, 0, 0}}, {17, {0, 0, 3}}};
  const RoutesResult made = plan_routes(plan);
  ASSERT_EQ(made.status, Status::embedded) << route_faults(plan, made.found);
  EXPECT_GT(made.found.arrival[0], 16);
  const std::vector<Route> early = {straight(plan.agents[0], 80)};  // at the gate after 20
  plan.duration = 30;                                               // after 15
  const RouteFindings found = check_routes(plan, early);
  EXPECT_EQ(found.obstacle_clearance, 0);
  EXPECT_EQ(found.obstacle, (std::array<int, 2>{0, 2}));
  plan.obstacles[2].motion = {{0, {0, 0, 0}}, {1, {0, 0, 3}}};
  EXPECT_GE(check_routes(plan, early).obstacle_clearance, 1);
  plan.obstacles[2].motion = {{0, {9, 0, 0}}, {1, {-4, 0, 0}}, {2, {-4, 0, 3}}};
  plan.agents[0].window = {5, 30};
  ASSERT_EQ(route_obstructions(plan).size(), 1U);
  EXPECT_NE(route_obstructions(plan)[0].find("comes to the start of 'a'"), std::string::npos);
}

TEST(PlanRoutes, planar_agents_keep_their_height_without_time_too) {
  RoutePlan plan;
  plan.agents = {agent("a", 0.5, {-4, 0, 0.3}, {4, 0, 0.3}), agent("b", 0.5, {-3, 1.5, 0.3}, {3, 2, 0.3})};
  plan.obstacles = {box("block", {-1, -3, -1}, {1, 0.5, 1})};
  for (RouteAgent& a : plan.agents) a.planar = true;
  RoutesResult made = plan_routes(plan);
  expect_routes(plan, made);
  for (const Route& route : made.routes)
    for (const RoutePoint& p : route.points) EXPECT_EQ(p[2], 0.3);
  made.routes[1].points[3][2] = 0.31;
  EXPECT_EQ(check_routes(plan, made.routes).off_plane, 1);
}

TEST(PlanRoutes, stops_when_it_is_cancelled) {
  Context context;
  context.on_progress = [&](const Context::Progress& progress) {
    EXPECT_LE(progress.fraction, 1);
    if (progress.phase == "swell") context.cancel();
  };
  EXPECT_EQ(plan_routes(three_crossing(), {}, &context).status, Status::cancelled);
}

TEST(PlanRoutes, options_out_of_range_are_refused) {
  EXPECT_THROW(plan_routes(three_crossing(), {.spacing = 0}), std::invalid_argument);
  EXPECT_THROW(plan_routes(three_crossing(), {.time_limit_s = -1}), std::invalid_argument);
  EXPECT_THROW(sample_route_plan("stars"), std::invalid_argument);
}

TEST(CheckRoutes, in_time_only_meeting_at_one_time_counts) {
  RoutePlan plan;
  plan.timed = true;
  plan.agents = {agent("a", 0.5, {-2, 0, 0}, {4, 0, 0}), agent("b", 0.5, {0, -4, 0}, {0, 2, 0})};
  std::vector<Route> routes{straight(plan.agents[0]), straight(plan.agents[1])};
  // One is at the crossing after a third of the time, the other after two; they are 2 sqrt(1/2) apart between.
  EXPECT_NEAR(check_routes(plan, routes).clearance, std::sqrt(2), 1e-9);
  plan.timed = false;
  EXPECT_EQ(check_routes(plan, routes).clearance, 0);
  plan.timed = true;
  routes[1] = straight(plan.agents[1], 21);
  EXPECT_THROW(check_routes(plan, routes), std::invalid_argument);
}

TEST(CheckRoutes, in_time_speeds_windows_and_turns_on_the_spot_are_looked_at) {
  RoutePlan plan;
  plan.timed = true;
  plan.duration = 10;
  plan.agents = {agent("a", 0.5, {0, 0, 0}, {10, 0, 0})};
  plan.agents[0].speed = 1;
  std::vector<Route> routes{straight(plan.agents[0], 10)};
  EXPECT_EQ(check_routes(plan, routes).speed, 1);
  EXPECT_TRUE(check_routes(plan, routes).hold());
  plan.agents[0].speed = std::nextafter(1.0, 0.0);
  EXPECT_GT(check_routes(plan, routes).speed, 1);
  EXPECT_NE(route_faults(plan, check_routes(plan, routes)).find("'a' moves"), std::string::npos);
  plan.agents[0].speed = 2;
  plan.agents[0].window = {0, 9.5};
  EXPECT_EQ(check_routes(plan, routes).late, 0);
  routes[0].points[9] = routes[0].points[10];
  EXPECT_EQ(check_routes(plan, routes).late, -1);
  EXPECT_EQ(check_routes(plan, routes).arrival[0], 9);
  plan.agents[0].window = {1.5, 9.5};
  EXPECT_EQ(check_routes(plan, routes).late, 0);
  // There, back, and there again: only after standing for a step.
  plan.agents[0].window = RouteAgent().window;
  plan.agents[0].speed = RouteAgent().speed;
  routes[0].points = {{0, 0, 0}, {2, 0, 0}, {4, 0, 0}, {4, 0, 0}, {1, 0, 0}, {1, 0, 0}, {6, 0, 0}, {10, 0, 0}};
  EXPECT_TRUE(check_routes(plan, routes).hold());
  routes[0].points[3] = {5, 0, 0};
  EXPECT_GT(check_routes(plan, routes).turn, 1);
}

TEST(CheckRoutes, finds_what_is_wrong) {
  RoutePlan plan;
  plan.agents = {agent("a", 0.5, {0, 0, 0}, {10, 0, 0}), agent("b", 0.5, {0, 1, 0}, {10, 1, 0})};
  plan.obstacles = {box("wall", {4, -2, 0.5}, {5, 2, 1})};
  std::vector<Route> routes = {straight(plan.agents[0]), straight(plan.agents[1])};
  const RouteFindings good = check_routes(plan, routes);
  EXPECT_TRUE(good.hold()) << route_faults(plan, good);
  EXPECT_EQ(good.clearance, 1);  // they touch, exactly
  EXPECT_EQ(good.obstacle_clearance, 1);
  EXPECT_EQ(good.agents, (std::array<int, 2>{0, 1}));

  std::vector<Route> bad = routes;
  bad[1].points[7][1] = std::nextafter(1.0, 0.0);
  EXPECT_LT(check_routes(plan, bad).clearance, 1);
  bad = routes;
  bad[0].points[9][2] = 1e-12;
  EXPECT_LT(check_routes(plan, bad).obstacle_clearance, 1);
  bad[0].points[9][2] = 3;
  EXPECT_EQ(check_routes(plan, bad).obstacle_clearance, 0);  // through the wall
  bad = routes;
  bad[0].points.back()[0] += 1e-9;
  EXPECT_FALSE(check_routes(plan, bad).places_kept);
  bad = routes;
  bad[1].points[3][1] = 1.3;
  EXPECT_GT(check_routes(plan, bad).turn, 1);
  EXPECT_NE(route_faults(plan, check_routes(plan, bad)).find("turns"), std::string::npos);
  plan.agents[0].waypoints = {{5, 0, 0}, {2, 0, 0}};  // in the other order
  EXPECT_FALSE(check_routes(plan, routes).places_kept);
}

TEST(CheckRoutes, a_circle_turns_as_tight_as_its_radius_and_meets_itself) {
  RoutePlan plan;
  plan.agents = {agent("a", 1, {3, 0, 0}, {3, 0, 0.5})};
  const auto helix = [&](double turns) {
    Route route;
    const int n = 400;
    for (int k = 0; k <= n; ++k) {
      const double angle = 2 * std::numbers::pi * turns * k / n;
      route.points.push_back({3 * std::cos(angle), 3 * std::sin(angle), 0.5 * k / n});
    }
    route.points.back() = plan.agents[0].goal;
    return route;
  };
  const std::vector<Route> once = {helix(1)};
  const RouteFindings found = check_routes(plan, once);
  EXPECT_NEAR(found.turn, 1.0 / 3, 1e-3);
  EXPECT_LT(found.self_clearance, 0.26);  // 0.5 of the 2 needed
  EXPECT_EQ(found.self, 0);
}

TEST(RouteTubes, lie_within_what_is_certified) {
  RoutePlan plan;
  plan.agents = {agent("a", 0.7, {0, 0, 0}, {3, 1, 0})};
  const std::vector<Route> routes = {{{{0, 0, 0}, {1, 0.2, 0.1}, {2, 0.1, 0.4}, {3, 1, 0}}}};
  const Surface tube = route_tubes(plan, routes, 12);
  EXPECT_EQ(tube.positions.size() / 3 + tube.corners.size() / 3 - tube.corners.size() / 2, 2U);  // a sphere
  for (std::size_t v = 0; v < tube.positions.size(); v += 3) {
    const RoutePoint p = {tube.positions[v], tube.positions[v + 1], tube.positions[v + 2]};
    double least = 10;
    for (std::size_t k = 0; k + 1 < 4; ++k)
      least = std::min(least, distance_by_search(routes[0].points[k], routes[0].points[k + 1], p, p));
    EXPECT_LT(least, 0.7);
    EXPECT_GT(least, 0.6);
  }
  EXPECT_THROW(route_tubes(plan, routes, 2), std::invalid_argument);
}

std::string refusal(const std::string& text) {
  try {
    parse_route_plan(text);
  } catch (const FileError& e) {
    return e.what();
  }
  return "taken";
}

TEST(CheckPlan, radii_that_double_precision_does_not_tell_from_none_are_refused) {
  const auto refusal = [](double radius, double place) {
    RoutePlan plan;
    plan.agents = {agent("a", radius, {place, 0, 0}, {place, place, 0})};
    try {
      check_plan(plan);
    } catch (const std::invalid_argument& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  for (const double radius : {5e-324, 1e-300, 1e-100, 1e-71})
    EXPECT_NE(refusal(radius, 1).find("agents[0].radius"), std::string::npos) << radius;
  EXPECT_NE(refusal(1e-300, 1e-300).find("too small"), std::string::npos);
  EXPECT_NE(refusal(1e-14, 1).find("too small beside coordinates up to 1"), std::string::npos);
  EXPECT_NE(refusal(0.3, 1e16).find("too small beside coordinates"), std::string::npos);
  EXPECT_EQ(refusal(1e-11, 1), "");
  EXPECT_EQ(refusal(1e-60, 1e-55), "");
  EXPECT_EQ(refusal(1e60, 1e65), "");
}

TEST(RoutePlanFile, what_is_wrong_is_named_with_its_place) {
  const auto one = [](const std::string& members) { return "{\"agents\": [{" + members + "}]}"; };
  EXPECT_EQ(refusal("{\"agents\": ["), "byte 13: this is not JSON");
  EXPECT_EQ(refusal("{}"), "the plan: \"agents\" is missing");
  EXPECT_EQ(refusal("{\"agents\": []}"), "agents: there are none");
  EXPECT_EQ(refusal(one("\"start\": [0, 0, 0]")), "agents[0]: \"radius\" is missing");
  EXPECT_EQ(refusal(one("\"colour\": 1")),
            "agents[0]: there is no \"colour\" to give here; there are name, radius, start, goal, waypoints, planar, "
            "priority, window, speed");
  EXPECT_EQ(refusal(one("\"radius\": 1, \"start\": [0, 0], \"goal\": [1, 0, 0]")),
            "agents[0].start: [0,0] is not [x, y, z]");
  EXPECT_EQ(refusal(one("\"radius\": 0, \"start\": [0, 0, 0], \"goal\": [1, 0, 0]")),
            "agents[0].radius is 0; give a number above 0");
  EXPECT_EQ(refusal(one("\"radius\": 1e999")), "a number is too large for double precision");
  EXPECT_EQ(refusal(one("\"radius\": NaN")), "byte 24: this is not JSON");
  EXPECT_NE(refusal(one("\"radius\": 1, \"start\": [0, 0, 0], \"goal\": [0, 0, 0]")).find("to the same place"),
            std::string::npos);
  const std::string a = "{\"name\": \"a\", \"radius\": 1, \"start\": [0, 0, 0], \"goal\": [9, 0, 0]}";
  EXPECT_EQ(refusal("{\"agents\": [" + a + ", " + a + "]}"), "agents[1].name: 'a' is the name of agents[0] too");
  const auto with = [&](const std::string& obstacle) {
    return "{\"agents\": [" + a + "], \"obstacles\": [" + obstacle + "]}";
  };
  EXPECT_NE(refusal(with("{\"file\": \"none.obj\"}")).find("obstacles[0].file: "), std::string::npos);
  EXPECT_EQ(refusal(with("{}")), "obstacles[0]: \"file\" is missing, or \"vertices\" and \"faces\"");
  EXPECT_EQ(refusal(with("{\"vertices\": [[0, 0, 0]], \"faces\": [[0, 1, 2]]}")),
            "obstacles[0].faces[0]: there is no vertex 1; there are 1, counted from 0");
  EXPECT_EQ(refusal(with("{\"vertices\": [], \"faces\": [], \"hollow\": 1}")),
            "obstacles[0].hollow: give true or false");
}

TEST(RoutePlanFile, what_belongs_to_time_is_refused_without_or_out_of_range) {
  const auto plan = [](const std::string& agent, const std::string& more) {
    return "{\"agents\": [{\"radius\": 1, \"start\": [0, 0, 0], \"goal\": [9, 0, 0]" + agent + "}]" + more + "}";
  };
  const std::string timed = ", \"timed\": true, \"duration\": 20";
  const std::string without = ": give the plan \"timed\": true too";
  EXPECT_EQ(refusal(plan(", \"speed\": 1", "")), "agents[0].speed" + without);
  EXPECT_EQ(refusal(plan(", \"window\": [0, 0.5]", "")), "agents[0].window" + without);
  EXPECT_EQ(refusal(plan("", ", \"duration\": 2")), "duration" + without);
  EXPECT_EQ(refusal(plan(", \"speed\": 1, \"window\": [0, 15]", timed)), "taken");
  EXPECT_EQ(refusal(plan(", \"window\": [3]", timed)), "agents[0].window: [3] is not [from, to]");
  for (const char* const window : {"[-1, 5]", "[5, 5]", "[3, 21]", "[20, 21]"})
    EXPECT_NE(refusal(plan(", \"window\": " + std::string(window), timed)).find("agents[0].window is "),
              std::string::npos)
        << window;
  EXPECT_NE(refusal(plan(", \"speed\": 0", timed)).find("agents[0].speed is 0; give"), std::string::npos);
  EXPECT_NE(refusal(plan("", ", \"timed\": true, \"duration\": 0")).find("duration is 0; give"), std::string::npos);
  EXPECT_NE(refusal(plan(", \"planar\": true, \"waypoints\": [[5, 0, 1]]", "")).find("have different z: 0 and 1"),
            std::string::npos);
  const auto moving = [&](const std::string& motion) {
    return plan("", timed + ", \"obstacles\": [{\"vertices\": [], \"faces\": [], \"motion\": " + motion + "}]");
  };
  EXPECT_EQ(refusal(moving("[[0, 0, 0, 0], [5, 1, 0, 0]]")), "taken");
  EXPECT_EQ(refusal(moving("[[0, 0, 0]]")), "obstacles[0].motion[0]: [0,0,0] is not [time, x, y, z]");
  EXPECT_NE(refusal(moving("[[5, 0, 0, 0], [5, 1, 0, 0]]")).find("obstacles[0].motion[1]: the time 5"),
            std::string::npos);
}

TEST(RoutePlanFile, plans_and_routes_come_back_as_they_were) {
  for (const RoutePlanSample& sample : route_plan_samples()) {
    const RoutePlan plan = sample_route_plan(sample.name);
    EXPECT_TRUE(route_obstructions(plan).empty()) << sample.name;
    const std::string text = route_plan_json(plan);
    EXPECT_EQ(route_plan_json(parse_route_plan(text)), text);
  }
  const RoutePlan plan = three_crossing();
  RoutesResult result;
  for (const RouteAgent& a : plan.agents) result.routes.push_back(straight(a, 7));
  const std::vector<Route> back = parse_routes(routes_json(plan, result), plan);
  for (std::size_t i = 0; i < back.size(); ++i) EXPECT_EQ(back[i].points, result.routes[i].points);
  EXPECT_THROW(parse_routes("{\"routes\": []}", plan), FileError);
  EXPECT_THROW(parse_routes("{\"routes\": [{\"name\": \"d\", \"points\": []}]}", plan), FileError);
}

TEST(RoutesAnimation, has_a_circle_for_each_agent) {
  const RoutePlan plan = three_crossing();
  std::vector<Route> routes;
  for (const RouteAgent& a : plan.agents) routes.push_back(straight(a));
  const std::string svg = routes_animation_svg(plan, routes, 5);
  std::size_t circles = 0;
  for (std::size_t at = svg.find("<circle"); at != std::string::npos; at = svg.find("<circle", at + 1)) ++circles;
  EXPECT_EQ(circles, 3U);
  EXPECT_THROW(routes_animation_svg(plan, routes, 1), std::invalid_argument);
}

}  // namespace
}  // namespace unsnarl
