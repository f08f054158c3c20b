#include "applications/routes/way_finder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include "geometry/portable_math.h"
#include "geometry/sort_unique.h"

namespace unsnarl {
namespace {

/// Width of a cell, at least: two cells fit into what the smallest agent passes (unit: radius of the smallest agent)
constexpr double cell_of_radius = 1;
/// Nodes of the grid, at most; beyond, cells are larger (unit: nodes)
constexpr double most_nodes = 4e6;
constexpr double cell_growth = 1.1;  ///< Cells grow by this factor until there are few enough (no unit)
/// Reserve for the rounding of distances that are kept as floats (unit: distance)
constexpr double distance_reserve = 1e-6;
constexpr double room_in_radii = 8;  ///< Room around everything (unit: radius of the largest agent)
/// Each earlier way nearby makes a step longer by this share: a free gap beside is worth a detour (no unit)
constexpr double crowding = 1;
/// A place is joined to the grid within this many cells to each side (unit: cells)
constexpr int nodes_around_a_place = 3;

/// Marks a node without a step; steps to its neighbours have numbers below (fixed by three dimensions)
constexpr std::uint8_t no_step = 27;

std::array<Index, 3> direction_of(std::uint8_t step) {
  return {step % 3 - 1, step / 3 % 3 - 1, step / 9 - 1};
}

}  // namespace

WayFinder::WayFinder(const RoutePlan& plan, const ObstacleTriangles& triangles, std::optional<double> plane)
    : triangles_(triangles) {
  Box box = triangles.bounds();
  double least = plan.agents[0].radius, most = 0;
  for (const RouteAgent& agent : plan.agents) {
    for (const Vec3& p : places_of(agent)) box.extend(p);
    least = std::min(least, agent.radius);
    most = std::max(most, agent.radius);
  }
  box = box.inflated(room_in_radii * most);
  corner_ = box.lo;
  const int dimensions = plane ? 2 : 3;
  const Vec3 extent = box.hi - box.lo;
  const double size = plane ? extent.x() * extent.y() : extent.prod();
  cell_ = std::max(cell_of_radius * least, portable::pow(size / most_nodes, 1.0 / dimensions));
  const auto count = [&] {
    double nodes = 1;
    for (int k = 0; k < dimensions; ++k) nodes *= std::floor(extent[k] / cell_) + 2;
    return nodes;
  };
  while (count() > most_nodes) cell_ *= cell_growth;
  size_ = {1, 1, 1};
  for (int k = 0; k < dimensions; ++k) size_[k] = static_cast<Index>(extent[k] / cell_) + 2;
  if (plane) corner_[2] = *plane;
  far_ = 2 * most + 2 * cell_;
  const auto nodes = static_cast<std::size_t>(count());
  distance_.assign(nodes, -1.0F);
  crowd_.assign(nodes, 0);
  cost_.assign(nodes, 0);
  step_.assign(nodes, 0);
}

std::array<Index, 3> WayFinder::place_of(Node node) const {
  const Node row = node / size_[0];
  return {static_cast<Index>(node % size_[0]), static_cast<Index>(row % size_[1]), static_cast<Index>(row / size_[1])};
}

WayFinder::Node WayFinder::node_at(const std::array<Index, 3>& p) const {
  return (static_cast<Node>(p[2]) * size_[1] + p[1]) * size_[0] + p[0];
}

WayFinder::Node WayFinder::offset_of(std::uint8_t step) const {
  const std::array<Index, 3> d = direction_of(step);
  return (static_cast<Node>(d[2]) * size_[1] + d[1]) * size_[0] + d[0];
}

Vec3 WayFinder::position(Node node) const {
  const std::array<Index, 3> p = place_of(node);
  return corner_ + cell_ * Vec3(p[0], p[1], p[2]);
}

double WayFinder::distance_of(Node node) {
  float& known = distance_[static_cast<std::size_t>(node)];
  if (known < 0) known = static_cast<float>(triangles_.distance(position(node), far_));
  return known;
}

bool WayFinder::is_clear(Node a, Node b, double distance) {
  const double da = distance_of(a), db = distance_of(b);
  if (std::min(da, db) < distance) return false;
  // The distance changes by no more than the length of the way.
  const double length = (position(a) - position(b)).norm();
  return 0.5 * (da + db - length) >= distance * (1 + distance_reserve) ||
         triangles_.is_clear(position(a), position(b), distance);
}

std::vector<WayFinder::Node> WayFinder::nodes_around(const Vec3& p, double distance) {
  std::vector<Node> nodes;
  std::array<Index, 3> lo{}, hi{};
  for (int k = 0; k < 3; ++k) {
    const auto at = static_cast<Index>((p[k] - corner_[k]) / cell_);
    lo[k] = std::max(0, at + 1 - nodes_around_a_place);
    hi[k] = std::min(size_[k] - 1, at + nodes_around_a_place);
  }
  for (Index z = lo[2]; z <= hi[2]; ++z)
    for (Index y = lo[1]; y <= hi[1]; ++y)
      for (Index x = lo[0]; x <= hi[0]; ++x) {
        const Node node = node_at({x, y, z});
        if (distance_of(node) >= distance && triangles_.is_clear(p, position(node), distance)) nodes.push_back(node);
      }
  return nodes;
}

void WayFinder::avoid(std::span<const Vec3> way, double distance) {
  std::vector<Node> touched;
  for (std::size_t k = 0; k + 1 < way.size(); ++k) {
    Box box;
    box.extend(way[k]);
    box.extend(way[k + 1]);
    box = box.inflated(distance);
    std::array<Index, 3> lo{}, hi{};
    for (int i = 0; i < 3; ++i) {
      lo[i] = std::clamp(static_cast<Index>((box.lo[i] - corner_[i]) / cell_), 0, size_[i] - 1);
      hi[i] = std::clamp(static_cast<Index>((box.hi[i] - corner_[i]) / cell_) + 1, 0, size_[i] - 1);
    }
    for (Index z = lo[2]; z <= hi[2]; ++z)
      for (Index y = lo[1]; y <= hi[1]; ++y)
        for (Index x = lo[0]; x <= hi[0]; ++x) {
          const Node node = node_at({x, y, z});
          if (closest_vertex_edge(position(node), way[k], way[k + 1]).distance < distance) touched.push_back(node);
        }
  }
  sort_unique(touched);
  for (const Node node : touched) {
    std::uint8_t& crowd = crowd_[static_cast<std::size_t>(node)];
    if (crowd < 255) ++crowd;
  }
}

std::vector<Vec3> WayFinder::pulled(const std::vector<Vec3>& way, double distance) const {
  std::vector<Vec3> result{way.front()};
  std::size_t at = 0;
  while (at + 1 < way.size()) {
    std::size_t next = way.size() - 1;
    while (next > at + 1 && !triangles_.is_clear(way[at], way[next], distance)) --next;
    result.push_back(way[next]);
    at = next;
  }
  return result;
}

std::optional<std::vector<Vec3>> WayFinder::find(const Vec3& from, const Vec3& to, double distance) {
  if (triangles_.is_clear(from, to, distance)) return std::vector<Vec3>{from, to};
  std::fill(cost_.begin(), cost_.end(), std::numeric_limits<float>::infinity());
  using Entry = std::pair<float, Node>;  // cost and the way that is left, at least
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  const auto reach = [&](Node node, double cost, std::uint8_t step) {
    const auto at = static_cast<std::size_t>(node);
    const auto rounded = static_cast<float>(cost);
    if (rounded >= cost_[at]) return;
    cost_[at] = rounded;
    step_[at] = step;
    open.emplace(rounded + static_cast<float>((position(node) - to).norm()), node);
  };
  const std::vector<Node> ends = nodes_around(to, distance);
  for (const Node node : nodes_around(from, distance)) reach(node, (position(node) - from).norm(), no_step);
  while (!open.empty()) {
    const auto [bound, node] = open.top();
    open.pop();
    const float cost = cost_[static_cast<std::size_t>(node)];
    if (bound > cost + static_cast<float>((position(node) - to).norm())) continue;  // a shorter way was found since
    if (std::binary_search(ends.begin(), ends.end(), node)) {
      std::vector<Vec3> way{to};
      for (Node at = node;;) {
        way.push_back(position(at));
        const std::uint8_t step = step_[static_cast<std::size_t>(at)];
        if (step == no_step) break;
        at -= offset_of(step);
      }
      way.push_back(from);
      std::reverse(way.begin(), way.end());
      return pulled(way, distance);
    }
    const std::array<Index, 3> place = place_of(node);
    for (std::uint8_t step = 0; step < no_step; ++step) {
      const std::array<Index, 3> d = direction_of(step);
      bool is_inside = true;
      for (int k = 0; k < 3; ++k) is_inside = is_inside && place[k] + d[k] >= 0 && place[k] + d[k] < size_[k];
      if (!is_inside) continue;
      const Node next = node + offset_of(step);
      const double crowd = 1 + crowding * crowd_[static_cast<std::size_t>(next)];
      const double there =
          cost + crowd * cell_ * std::sqrt(static_cast<double>(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]));
      if (static_cast<float>(there) < cost_[static_cast<std::size_t>(next)] && is_clear(node, next, distance))
        reach(next, there, step);
    }
  }
  return std::nullopt;
}

}  // namespace unsnarl
