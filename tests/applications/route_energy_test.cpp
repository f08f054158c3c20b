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
    plan.agents = {{"a", 0.5, {-2, 0, 0}, {2, 0, 0}, {}}, {"b", 0.4, {0, -2, height}, {0, 2, height}, {}}};
    plan.obstacles = {{"floor", {{-5, -5, -0.53, 5, -5, -0.55, 0, 7, -0.51}, {0, 1, 2}, {}}, false}};
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
        energy.settings.strict = strict;
        energy.settings.turn_from = turn_from;
        energy.settings.cushion = 0.3;
        energy.forget_neighbours();
        expect_gradient_of(energy, scene, 2e-4);
      }
}

TEST(RouteChains, in_time_all_have_equally_many_vertices) {
  RoutePlan plan;
  plan.agents = {{"a", 1, {0, 0, 0}, {9, 0, 0}, {{3, 3, 0}}}, {"b", 0.5, {0, 0, 5}, {30, 0, 5}, {}}};
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
  plan.agents = {{"a", 1, {0, 0, 0}, {3.3, 3.3, 0}, {}}};
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
