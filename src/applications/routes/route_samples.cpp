#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "geometry/portable_math.h"
#include "geometry/types.h"
#include "unsnarl/routes.h"

namespace unsnarl {
namespace {

constexpr std::array<RoutePlanSample, 6> samples = {{
    {"star_6", "six agents that change sides through one centre, in a plane"},
    {"star_20", "twenty agents that change sides through one centre"},
    {"star_50", "fifty agents that change sides through one centre"},
    {"ring", "nineteen agents that go through a ring and come out mirrored"},
    {"maze", "eight agents in a closed room, past three walls with a gap each"},
    {"door", "six agents that change sides at different times through one gap, in which there is room for one"},
}};

RouteAgent agent(std::size_t number, double radius, const Vec3& start, const Vec3& goal) {
  return {
      fmt::format("agent_{}", number), radius, {start.x(), start.y(), start.z()}, {goal.x(), goal.y(), goal.z()}, {}};
}

/// From evenly spread places on a sphere of radius 10 to the places opposite.
RoutePlan star(int count, double radius) {
  RoutePlan plan;
  for (int k = 0; k < count; ++k) {
    // Half of a spherical Fibonacci lattice: with those opposite, places keep away from each other.
    const double height = (k + 0.5) / count, angle = 2 * std::numbers::pi * std::numbers::phi * k;
    const double across = std::sqrt(1 - height * height);
    const Vec3 start = 10 * Vec3(across * portable::cos(angle), height, across * portable::sin(angle));
    plan.agents.push_back(agent(plan.agents.size(), radius, start, -start));
  }
  return plan;
}

RoutePlan flat_star(int count, double radius) {
  RoutePlan plan;
  for (int k = 0; k < count; ++k) {
    const double angle = std::numbers::pi * k / count;
    const Vec3 start = 10 * Vec3(portable::cos(angle), 0, portable::sin(angle));
    plan.agents.push_back(agent(plan.agents.size(), radius, start, -start));
  }
  return plan;
}

/// A torus around the y axis.
RouteObstacle torus(double large, double small) {
  RouteObstacle made;
  made.name = "ring";
  constexpr int around = 64, across = 24;
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      const double a = 2 * std::numbers::pi * i / around, b = 2 * std::numbers::pi * j / across;
      const double r = large + small * portable::cos(b);
      made.surface.positions.insert(made.surface.positions.end(),
                                    {r * portable::cos(a), small * portable::sin(b), r * portable::sin(a)});
      const auto at = [](int k, int l) { return (k % around) * across + l % across; };
      made.surface.corners.insert(made.surface.corners.end(), {at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)});
      made.surface.offsets.push_back(4 * (i * across + j));
    }
  made.surface.offsets.push_back(static_cast<std::int32_t>(made.surface.corners.size()));
  return made;
}

RoutePlan ring() {
  RoutePlan plan;
  // A hexagon of starts above; each goes to the place below that lies across.
  for (int i = -2; i <= 2; ++i)
    for (int j = -2; j <= 2; ++j) {
      if (std::abs(i + j) > 2) continue;
      const double x = 2 * (i + 0.5 * j), z = 2 * std::sqrt(0.75) * j;
      plan.agents.push_back(agent(plan.agents.size(), 0.3, {x, 10, z}, {-x, -10, -z}));
    }
  plan.obstacles.push_back(torus(3, 0.6));
  return plan;
}

RouteObstacle block(const std::string& name, const Vec3& low, const Vec3& high) {
  RouteObstacle made;
  made.name = name;
  for (int k = 0; k < 8; ++k)
    made.surface.positions.insert(made.surface.positions.end(),
                                  {(k & 1 ? high : low).x(), (k & 2 ? high : low).y(), (k & 4 ? high : low).z()});
  made.surface.corners = {0, 4, 6, 2, 1, 3, 7, 5, 0, 1, 5, 4, 2, 6, 7, 3, 0, 2, 3, 1, 4, 5, 7, 6};
  for (int k = 0; k <= 24; k += 4) made.surface.offsets.push_back(k);
  return made;
}

RoutePlan maze() {
  RoutePlan plan;
  // Walls across x, from floor to ceiling, each with one gap; gaps take turns on both sides.
  constexpr double half_width = 6, height = 4, thickness = 0.5, gap = 3;
  for (int k = 0; k < 3; ++k) {
    const double x = 4.0 * (k - 1);
    const double opening = k % 2 == 0 ? half_width - gap : -half_width;  // where the gap begins along z
    if (opening > -half_width)
      plan.obstacles.push_back(block(fmt::format("wall_{}", k), {x, 0, -half_width}, {x + thickness, height, opening}));
    if (opening + gap < half_width)
      plan.obstacles.push_back(
          block(fmt::format("wall_{}", k), {x, 0, opening + gap}, {x + thickness, height, half_width}));
  }
  plan.obstacles.push_back(block("floor", {-9, -0.5, -half_width - 0.5}, {9.5, 0, half_width + 0.5}));
  plan.obstacles.push_back(block("ceiling", {-9, height, -half_width - 0.5}, {9.5, height + 0.5, half_width + 0.5}));
  plan.obstacles.push_back(block("left", {-9, 0, -half_width - 0.5}, {9.5, height, -half_width}));
  plan.obstacles.push_back(block("right", {-9, 0, half_width}, {9.5, height, half_width + 0.5}));
  plan.obstacles.push_back(block("front", {-9.5, -0.5, -half_width - 0.5}, {-9, height + 0.5, half_width + 0.5}));
  plan.obstacles.push_back(block("back", {9.5, -0.5, -half_width - 0.5}, {10, height + 0.5, half_width + 0.5}));
  for (int k = 0; k < 8; ++k) {
    const double z = -4.5 + 3 * (k / 2), y = k % 2 == 0 ? 1 : 3;
    const Vec3 start(-8, y, z), goal(8.5, height - y, -z);
    // Every second one goes the other way.
    plan.agents.push_back(k % 4 < 2 ? agent(k, 0.25, start, goal) : agent(k, 0.25, goal, start));
  }
  return plan;
}

RoutePlan door() {
  RoutePlan plan;
  plan.timed = true;
  // Four blocks around a hole of 1.5 in a wall across x; agents are 0.8 wide.
  constexpr double hole = 0.75, half_width = 5, thickness = 0.2;
  plan.obstacles.push_back(block("left", {-thickness, -half_width, -half_width}, {thickness, half_width, -hole}));
  plan.obstacles.push_back(block("right", {-thickness, -half_width, hole}, {thickness, half_width, half_width}));
  plan.obstacles.push_back(block("below", {-thickness, -half_width, -hole}, {thickness, -hole, hole}));
  plan.obstacles.push_back(block("above", {-thickness, hole, -hole}, {thickness, half_width, hole}));
  for (int k = 0; k < 6; ++k) {
    // Agents that start nearer to the door reach it earlier; every second agent comes from the other side.
    const double angle = 2 * std::numbers::pi * std::numbers::phi * k, side = k % 2 == 0 ? 1 : -1;
    const Vec3 across(0, 2 * portable::sin(angle), 2 * portable::cos(angle));
    const double near = 1.5 + 1.6 * k, far = 1.5 + 1.6 * (5 - k);
    plan.agents.push_back(agent(k, 0.4, Vec3(-side * near, 0, 0) + across, Vec3(side * far, 0, 0) - across));
  }
  return plan;
}

}  // namespace

std::span<const RoutePlanSample> route_plan_samples() {
  return samples;
}

RoutePlan sample_route_plan(std::string_view name) {
  if (name == "star_6") return flat_star(6, 0.8);
  if (name == "star_20") return star(20, 0.5);
  if (name == "star_50") return star(50, 0.3);
  if (name == "ring") return ring();
  if (name == "maze") return maze();
  if (name == "door") return door();
  std::string names;
  for (const RoutePlanSample& sample : samples) names += fmt::format("{}{}", names.empty() ? "" : ", ", sample.name);
  throw std::invalid_argument(fmt::format("there is no plan '{}'; there are {}", name, names));
}

}  // namespace unsnarl
