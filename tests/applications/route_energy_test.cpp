#include "applications/routes/route_energy.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "energy/finite_differences.h"

namespace unsnarl {
namespace {

/// Two bent routes that nearly touch, and a triangle below them.
struct Scene {
  RoutePlan plan;
  RouteChains chains;
  Positions x;

  explicit Scene(double height, bool timed = false) {
    plan.timed = timed;
    plan.agents.resize(2);
    plan.agents[0] = {.name = "a", .radius = 0.5, .start = {-2, 0, 0}, .goal = {2, 0, 0}, .waypoints = {}};
    plan.agents[1] = {.name = "b", .radius = 0.4, .start = {0, -2, height}, .goal = {0, 2, height}, .waypoints = {}};
    plan.obstacles = {{"floor", {{-5, -5, -0.53, 5, -5, -0.55, 0, 7, -0.51}, {0, 1, 2}, {}}, false, {}}};
    std::vector<Legs> legs;
    for (const RouteAgent& agent : plan.agents) {
      const std::vector<Vec3> places = places_of(agent);
      legs.push_back({{places[0], places[1]}});
    }
    chains = sample_chains(plan, legs, 0.9, false);
    x = chains.x + 0.02 * random_positions(3, static_cast<Index>(chains.x.cols()));
    for (Index v = 0; v < x.cols(); ++v)
      if (chains.pinned[v]) x.col(v) = chains.x.col(v);
  }
};

void expect_gradient_of(RouteEnergy& energy, const Scene& scene, double tolerance) {
  const auto value = [&](const Positions& at) {
    Positions kept = at;
    for (Index v = 0; v < at.cols(); ++v)
      if (scene.chains.pinned[v]) kept.col(v) = scene.x.col(v);
    Eigen::VectorXd gradient;
    return energy(Eigen::Map<const Eigen::VectorXd>(kept.data(), kept.size()), gradient);
  };
  Eigen::VectorXd gradient;
  const double at = energy(Eigen::Map<const Eigen::VectorXd>(scene.x.data(), scene.x.size()), gradient);
  ASSERT_LT(at, 1e10);
  expect_gradient(value, scene.x, Eigen::Map<const Positions>(gradient.data(), 3, scene.x.cols()), 1e-7, tolerance);
}

TEST(RouteEnergy, gradients_are_differences_of_the_value) {
  for (const bool timed : {false, true})
    for (const bool strict : {false, true})
      for (const double turn_from : {0.0, 0.85}) {
        const Scene scene(0.95, timed);
        const ObstacleTriangles triangles(scene.plan);
        RouteEnergy energy(scene.chains, triangles);
        energy.settings.contact = 1;
        energy.settings.strict = energy.settings.strict_turns = strict;
        energy.settings.turn_from = turn_from;
        energy.settings.cushion = 0.3;
        energy.forget_neighbours();
        expect_gradient_of(energy, scene, 2e-4);
      }
}

/// Two agents in time, one of which stands for some steps, with a limited speed, past an obstacle that moves.
TEST(RouteEnergy, gradients_in_time_are_differences_of_the_value) {
  RoutePlan plan;
  plan.timed = true;
  plan.agents.resize(2);
  plan.agents[0] = {.name = "a", .radius = 0.5, .start = {-2, 0, 0}, .goal = {2, 0, 0}, .waypoints = {}};
  plan.agents[1] = {
      .name = "b", .radius = 0.4, .start = {0, -2, 0}, .goal = {0, 2, 0}, .waypoints = {}, .planar = true};
  plan.agents[0].speed = 5.4;
  plan.obstacles = {{"plate", {{-5, -5, -2, 5, -5, -2, 0, 7, -2}, {0, 1, 2}, {}}, false, {}}};
  plan.obstacles[0].motion = {{0, {0, 0, 0.9}}, {0.33, {0, 0, 1.45}}, {1, {0.5, 0, 1.38}}};
  std::vector<TimedWay> ways(2);
  for (int k = 0; k <= 8; ++k) {
    ways[0].points.emplace_back(-2 + 0.5 * k, 0, 0);
    const int moves = k <= 3 ? k : std::max(3, k - 2);  // stands from 3 to 5
    ways[1].points.emplace_back(0.3, -2 + 4.0 / 6 * moves - 1.1, 0);
    for (TimedWay& way : ways) way.pinned.push_back(k == 0 || k == 8);
  }
  const RouteChains chains = chains_in_time(plan, ways);
  EXPECT_TRUE(chains.stands(9 + 3) && chains.stands(9 + 5) && !chains.stands(9 + 2) && !chains.stands(9 + 6));
  Positions x = chains.x + 0.02 * random_positions(3, static_cast<Index>(chains.x.cols()));
  for (Index v = 0; v < x.cols(); ++v) {
    if (chains.pinned[v]) x.col(v) = chains.x.col(v);
    if (v > 8) x(2, v) = 0;
    x.col(v) = Vec3(x.col(chains.stand[v]));
  }
  const ObstacleTriangles none(plan);
  EXPECT_TRUE(none.empty());
  const std::vector<MovingObstacle> moving = moving_obstacles(plan, 8);
  RouteEnergy energy(chains, none, moving);
  energy.settings.contact = 1;
  energy.settings.cushion = 0.3;
  Eigen::VectorXd gradient;
  const auto value = [&](const Positions& at) {
    Positions held = at;
    for (Index v = 0; v < at.cols(); ++v) held.col(v) = Vec3(at.col(chains.stand[v]));
    return energy(Eigen::Map<const Eigen::VectorXd>(held.data(), held.size()), gradient);
  };
  ASSERT_LT(value(x), 1e10);
  const Positions at_x = Eigen::Map<const Positions>(gradient.data(), 3, x.cols());
  const double step = 1e-6;
  for (Index v = 0; v < x.cols(); ++v)
    for (int d = 0; d < 3; ++d) {
      if (chains.pinned[v] || (v > 8 && d == 2)) {
        EXPECT_EQ(at_x(d, v), 0);
        continue;
      }
      if (chains.stand[v] != v) continue;
      Positions moved = x;
      moved(d, v) += step;
      const double above = value(moved);
      moved(d, v) -= 2 * step;
      const auto together = std::count(chains.stand.begin(), chains.stand.end(), v);
      EXPECT_NEAR((above - value(moved)) / (2 * step), together * at_x(d, v), 2e-4 * (1 + std::abs(at_x(d, v))))
          << v << " " << d;
    }
}

TEST(RouteChains, in_time_all_have_equally_many_vertices) {
  RoutePlan plan;
  plan.agents.resize(2);
  plan.agents[0] = {.name = "a", .radius = 1, .start = {0, 0, 0}, .goal = {9, 0, 0}, .waypoints = {{3, 3, 0}}};
  plan.agents[1] = {.name = "b", .radius = 0.5, .start = {0, 0, 5}, .goal = {30, 0, 5}, .waypoints = {}};
  const std::vector<Legs> ways = {{{Vec3(0, 0, 0), Vec3(3, 3, 0)}, {Vec3(3, 3, 0), Vec3(5, 3, 0), Vec3(9, 0, 0)}},
                                  {{Vec3(0, 0, 5), Vec3(30, 0, 5)}}};
  for (const bool keep_corners : {true, false}) {
    EXPECT_LT(sample_chains(plan, ways, 0.5, keep_corners).chains[0].count, 40);
    RoutePlan timed = plan;
    timed.timed = true;
    const RouteChains chains = sample_chains(timed, ways, 0.5, keep_corners);
    EXPECT_EQ(chains.chains[0].count, 121);
    EXPECT_EQ(chains.chains[1].count, 121);
    EXPECT_EQ(std::count(chains.pinned.begin(), chains.pinned.end(), 1), 5);
    // Evenly over both legs, by their lengths.
    for (Index v = 1; v < 121; ++v)
      EXPECT_NEAR((chains.x.col(v) - chains.x.col(v - 1)).norm(), chains.chains[0].edge, 0.02);
  }
}

TEST(RouteChains, corners_of_a_way_are_vertices) {
  RoutePlan plan;
  plan.agents = {{.name = "a", .radius = 1, .start = {0, 0, 0}, .goal = {3.3, 3.3, 0}, .waypoints = {}}};
  const std::vector<Legs> ways = {{{Vec3(0, 0, 0), Vec3(3.3, 0, 0), Vec3(3.3, 3.3, 0)}}};
  const auto has_corner = [&](bool keep_corners) {
    const RouteChains chains = sample_chains(plan, ways, 0.47, keep_corners);
    bool found = false;
    for (Index v = 0; v < chains.x.cols(); ++v) found = found || chains.x.col(v) == Vec3(3.3, 0, 0);
    EXPECT_TRUE(chains.pinned.front() && chains.pinned.back());
    return found;
  };
  EXPECT_TRUE(has_corner(true));
  EXPECT_FALSE(has_corner(false));
}

TEST(RouteEnergy, overlaps_cost_or_are_infinite) {
  const Scene scene(0.5);
  const ObstacleTriangles none((RoutePlan()));
  RouteEnergy energy(scene.chains, none);
  energy.settings.contact = 1;
  Eigen::VectorXd gradient;
  const Eigen::VectorXd x = Eigen::Map<const Eigen::VectorXd>(scene.x.data(), scene.x.size());
  const double soft = energy(x, gradient);
  EXPECT_LT(soft, 1e10);
  EXPECT_LT(energy.margins(x).contact, 1);
  energy.settings.strict = true;
  EXPECT_GT(energy(x, gradient), 1e300);
}

}  // namespace
}  // namespace unsnarl
