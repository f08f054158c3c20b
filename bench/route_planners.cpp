// Two ways in which others plan for many flat agents, for bench/route_planners to run beside unsnarl routes; nothing of
// the product uses them. Agents are discs that start and end anywhere, obstacles are the bounding boxes of their
// vertices.
//
// cbs: conflict-based search (G. Sharon et al. 2015), greedy: of the open nodes, the one with the fewest conflicts (M.
//   Barer et al. 2014). Moves on a grid of two radii, a step of time each; discs that come too near within a step are a
//   conflict.
// orca: optimal reciprocal collision avoidance (J. van den Berg et al. 2011), steered to the farthest visible point of
//   each agent's own shortest way.
//
// usage: unsnarl_route_planners cbs|orca PLAN.json ROUTES.json CPU_SECONDS; exit code 0: found, 1: not.
#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <fstream>
#include <iostream>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <queue>
#include <set>
#include <string>
#include <tuple>
#include <vector>

namespace {

struct Vec {
  double x = 0, y = 0;
};
Vec operator+(Vec a, Vec b) {
  return {a.x + b.x, a.y + b.y};
}
Vec operator-(Vec a, Vec b) {
  return {a.x - b.x, a.y - b.y};
}
Vec operator*(double s, Vec a) {
  return {s * a.x, s * a.y};
}
double dot(Vec a, Vec b) {
  return a.x * b.x + a.y * b.y;
}
double det(Vec a, Vec b) {
  return a.x * b.y - a.y * b.x;
}
double norm(Vec a) {
  return std::sqrt(dot(a, a));
}

struct Box {
  Vec lo, hi;
  Vec nearest(Vec p) const { return {std::clamp(p.x, lo.x, hi.x), std::clamp(p.y, lo.y, hi.y)}; }
};

struct Agent {
  std::string name;
  double radius = 0, speed = 0;
  Vec start, goal;
};

struct Plan {
  std::vector<Agent> agents;
  std::vector<Box> boxes;
  double duration = 0, z = 0;
  Box room;
};

using Paths = std::vector<std::vector<Vec>>;  // one an agent, at equal times

Plan read_plan(const char* path) {
  const nlohmann::json json = nlohmann::json::parse(std::ifstream(path));
  Plan plan;
  plan.duration = json["duration"];
  constexpr double inf = std::numeric_limits<double>::infinity();
  plan.room = {{inf, inf}, {-inf, -inf}};
  const auto extend = [](Box& box, Vec p) {
    box = {{std::min(box.lo.x, p.x), std::min(box.lo.y, p.y)}, {std::max(box.hi.x, p.x), std::max(box.hi.y, p.y)}};
  };
  for (const auto& item : json["agents"]) {
    Agent& agent = plan.agents.emplace_back();
    agent.name = item["name"];
    agent.radius = item["radius"];
    agent.speed = item["speed"];
    agent.start = {item["start"][0], item["start"][1]};
    agent.goal = {item["goal"][0], item["goal"][1]};
    plan.z = item["start"][2];
    extend(plan.room, agent.start);
    extend(plan.room, agent.goal);
  }
  for (const auto& item : json["obstacles"]) {
    Box& box = plan.boxes.emplace_back(Box{{inf, inf}, {-inf, -inf}});
    for (const auto& v : item["vertices"]) {
      extend(box, {v[0], v[1]});
      extend(plan.room, {v[0], v[1]});
    }
  }
  const double around = 8 * plan.agents[0].radius;  // as unsnarl routes has
  plan.room.lo = plan.room.lo - Vec{around, around};
  plan.room.hi = plan.room.hi + Vec{around, around};
  return plan;
}

/// Whether a disc can move straight from a to b.
bool is_clear(const Plan& plan, Vec a, Vec b, double radius) {
  for (const Box& box : plan.boxes) {
    // The distance of a segment and a convex box is a convex function along the segment.
    double lo = 0, hi = 1;
    const auto distance = [&](double t) {
      const Vec p = a + t * (b - a);
      return norm(p - box.nearest(p));
    };
    for (int k = 0; k < 40; ++k) {
      const double s = lo + (hi - lo) / 3, t = hi - (hi - lo) / 3;
      (distance(s) < distance(t) ? hi : lo) = distance(s) < distance(t) ? t : s;
    }
    if (std::min({distance(0), distance(1), distance(lo)}) < radius) return false;
  }
  return true;
}

/// A grid with eight neighbours a node, or four, and the places of an agent.
struct Grid {
  std::vector<Vec> at;
  std::vector<std::vector<int>> next;
};

Grid make_grid(const Plan& plan, double pitch, double radius, bool diagonal) {
  Grid grid;
  const int nx = static_cast<int>((plan.room.hi.x - plan.room.lo.x) / pitch) + 1,
            ny = static_cast<int>((plan.room.hi.y - plan.room.lo.y) / pitch) + 1;
  for (int y = 0; y < ny; ++y)
    for (int x = 0; x < nx; ++x) grid.at.push_back(plan.room.lo + Vec{x * pitch, y * pitch});
  grid.next.resize(grid.at.size());
  for (int y = 0; y < ny; ++y)
    for (int x = 0; x < nx; ++x)
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
          if ((dx == 0 && dy == 0) || (!diagonal && dx != 0 && dy != 0)) continue;
          if (x + dx < 0 || x + dx >= nx || y + dy < 0 || y + dy >= ny) continue;
          const int a = y * nx + x, b = (y + dy) * nx + x + dx;
          if (is_clear(plan, grid.at[a], grid.at[b], radius)) grid.next[a].push_back(b);
        }
  return grid;
}

/// Adds a place that is not on the grid; returns its node.
int add_place(const Plan& plan, Grid& grid, Vec p, double reach, double radius) {
  const int node = static_cast<int>(grid.at.size());
  grid.at.push_back(p);
  grid.next.emplace_back();
  for (int n = 0; n < node; ++n)
    if (norm(grid.at[n] - p) <= reach && is_clear(plan, p, grid.at[n], radius)) {
      grid.next[node].push_back(n);
      grid.next[n].push_back(node);
    }
  return node;
}

/// Distance to a node; or the number of moves.
std::vector<double> distances_to(const Grid& grid, int goal, bool count_moves) {
  std::vector<double> distance(grid.at.size(), std::numeric_limits<double>::infinity());
  std::priority_queue<std::pair<double, int>, std::vector<std::pair<double, int>>, std::greater<>> open;
  distance[goal] = 0;
  open.emplace(0, goal);
  while (!open.empty()) {
    const auto [d, n] = open.top();
    open.pop();
    if (d > distance[n]) continue;
    for (const int m : grid.next[n]) {
      const double there = d + (count_moves ? 1 : norm(grid.at[m] - grid.at[n]));
      if (there < distance[m]) {
        distance[m] = there;
        open.emplace(there, m);
      }
    }
  }
  return distance;
}

double closest(Vec from, Vec to) {  // of a difference that changes evenly
  const Vec change = to - from;
  const double squared = dot(change, change);
  const double t = squared > 0 ? std::clamp(-dot(from, change) / squared, 0.0, 1.0) : 0;
  return norm(from + t * change);
}

/// CPU time.
class Clock {
 public:
  explicit Clock(double seconds) : seconds_(seconds) {}
  bool is_over() const { return static_cast<double>(std::clock()) > seconds_ * CLOCKS_PER_SEC; }

 private:
  double seconds_;
};

// ---- Conflict-based search ------------------------------------------------------------------------------------------

struct Forbidden {
  int time, from, to;
  auto operator<=>(const Forbidden&) const = default;
};
using NodePath = std::vector<int>;

int at_time(const NodePath& path, std::size_t t) {
  return path[std::min(t, path.size() - 1)];
}

/// The shortest way in time that uses no forbidden move, and can stay at its end.
NodePath way_in_time(const Grid& grid, int start, int goal, const std::vector<double>& left,
                     const std::set<Forbidden>& forbidden, int most_steps) {
  int last = 0;  // time from which the goal is not forbidden
  for (const Forbidden& f : forbidden)
    if (f.from == goal && f.to == goal) last = std::max(last, f.time + 1);
  using Entry = std::tuple<double, int, int>;  // least arrival, -time, node
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  std::map<std::pair<int, int>, int> parent;  // (time, node)
  open.emplace(left[start], 0, start);
  parent[{0, start}] = -1;
  while (!open.empty()) {
    const auto [bound, minus_time, node] = open.top();
    open.pop();
    const int time = -minus_time;
    if (node == goal && time >= last) {
      NodePath path;
      for (int n = node, t = time; n >= 0; n = parent[{t, n}], --t) path.push_back(n);
      std::reverse(path.begin(), path.end());
      return path;
    }
    if (time >= most_steps) continue;
    const auto go = [&](int to) {
      if (!(left[to] < 1e9) || forbidden.contains({time, node, to}) || parent.contains({time + 1, to})) return;
      parent[{time + 1, to}] = node;
      open.emplace(time + 1 + left[to], -(time + 1), to);
    };
    go(node);
    for (const int to : grid.next[node]) go(to);
  }
  return {};
}

struct Conflict {
  int a = -1, b = -1, time = 0, count = 0;
};

Conflict first_conflict(const Plan& plan, const Grid& grid, const std::vector<NodePath>& paths) {
  Conflict found;
  std::size_t most = 0;
  for (const NodePath& path : paths) most = std::max(most, path.size());
  for (std::size_t t = 0; t + 1 < most + 1; ++t)
    for (std::size_t i = 0; i < paths.size(); ++i)
      for (std::size_t j = i + 1; j < paths.size(); ++j) {
        const double need = plan.agents[i].radius + plan.agents[j].radius;
        const Vec from = grid.at[at_time(paths[i], t)] - grid.at[at_time(paths[j], t)],
                  to = grid.at[at_time(paths[i], t + 1)] - grid.at[at_time(paths[j], t + 1)];
        if (closest(from, to) >= need) continue;
        if (found.count++ == 0) {
          found.a = static_cast<int>(i);
          found.b = static_cast<int>(j);
          found.time = static_cast<int>(t);
        }
      }
  return found;
}

Paths cbs(const Plan& plan, const Clock& clock) {
  const double radius = plan.agents[0].radius, pitch = 2.02 * radius, step = pitch / plan.agents[0].speed;
  Grid grid = make_grid(plan, pitch, radius, false);
  const int most_steps = static_cast<int>(plan.duration / step);
  std::vector<int> starts, goals;
  for (const Agent& agent : plan.agents) {
    starts.push_back(add_place(plan, grid, agent.start, pitch, radius));
    goals.push_back(add_place(plan, grid, agent.goal, pitch, radius));
  }
  std::vector<std::vector<double>> left;
  for (const int goal : goals) left.push_back(distances_to(grid, goal, true));

  struct Node {
    std::vector<NodePath> paths;
    std::vector<std::set<Forbidden>> forbidden;
    Conflict conflict;
  };
  std::vector<Node> nodes(1);
  nodes[0].forbidden.resize(plan.agents.size());
  for (std::size_t i = 0; i < plan.agents.size(); ++i) {
    nodes[0].paths.push_back(way_in_time(grid, starts[i], goals[i], left[i], {}, most_steps));
    if (nodes[0].paths.back().empty()) return {};
  }
  nodes[0].conflict = first_conflict(plan, grid, nodes[0].paths);
  using Entry = std::tuple<int, std::size_t, std::size_t>;  // conflicts, sum of times, node
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  const auto push = [&](std::size_t n) {
    std::size_t sum = 0;
    for (const NodePath& path : nodes[n].paths) sum += path.size();
    open.emplace(nodes[n].conflict.count, sum, n);
  };
  push(0);
  while (!open.empty() && !clock.is_over()) {
    const std::size_t n = std::get<2>(open.top());
    open.pop();
    const Conflict conflict = nodes[n].conflict;
    if (conflict.count == 0) {
      Paths paths;
      for (const NodePath& path : nodes[n].paths) {
        std::vector<Vec>& points = paths.emplace_back();
        for (int t = 0; t <= most_steps; ++t) points.push_back(grid.at[at_time(path, static_cast<std::size_t>(t))]);
      }
      return paths;
    }
    for (const int agent : {conflict.a, conflict.b}) {
      Node child = nodes[n];
      const auto time = static_cast<std::size_t>(conflict.time);
      child.forbidden[agent].insert(
          {conflict.time, at_time(child.paths[agent], time), at_time(child.paths[agent], time + 1)});
      child.paths[agent] =
          way_in_time(grid, starts[agent], goals[agent], left[agent], child.forbidden[agent], most_steps);
      if (child.paths[agent].empty()) continue;
      child.conflict = first_conflict(plan, grid, child.paths);
      nodes.push_back(std::move(child));
      push(nodes.size() - 1);
    }
    nodes[n].paths.clear();
    nodes[n].forbidden.clear();
  }
  return {};
}

// ---- Reciprocal collision avoidance ---------------------------------------------------------------------------------

/// Velocities to the left of a line through `point` are allowed.
struct Line {
  Vec point, direction;
};

/// On line k, the velocity within the lines before it and the speed that is nearest to the wanted one, or farthest
/// along it where `by_direction`. False: none.
bool best_on_line(const std::vector<Line>& lines, std::size_t k, double speed, Vec wanted, bool by_direction,
                  Vec& best) {
  const Line& line = lines[k];
  const double along = dot(line.point, line.direction);
  const double root = along * along + speed * speed - dot(line.point, line.point);
  if (root < 0) return false;
  double low = -along - std::sqrt(root), high = -along + std::sqrt(root);
  for (std::size_t i = 0; i < k; ++i) {
    const double slope = det(line.direction, lines[i].direction),
                 offset = det(lines[i].direction, line.point - lines[i].point);
    if (std::abs(slope) < 1e-9) {
      if (offset < 0) return false;
      continue;
    }
    (slope >= 0 ? high : low) = slope >= 0 ? std::min(high, offset / slope) : std::max(low, offset / slope);
    if (low > high) return false;
  }
  const double t = by_direction ? (dot(wanted, line.direction) > 0 ? high : low)
                                : std::clamp(dot(line.direction, wanted - line.point), low, high);
  best = line.point + t * line.direction;
  return true;
}

/// The allowed velocity nearest to the wanted one; returns the number of the line that leaves none, or their count.
std::size_t best_velocity(const std::vector<Line>& lines, double speed, Vec wanted, bool by_direction, Vec& best) {
  best = by_direction ? speed * wanted : norm(wanted) > speed ? (speed / norm(wanted)) * wanted : wanted;
  for (std::size_t k = 0; k < lines.size(); ++k)
    if (det(lines[k].direction, lines[k].point - best) > 0) {
      const Vec before = best;
      if (!best_on_line(lines, k, speed, wanted, by_direction, best)) {
        best = before;
        return k;
      }
    }
  return lines.size();
}

/// If no velocity is allowed by all lines, finds the one that breaks those from `first` on the least; those before
/// `fixed` are kept.
void least_bad_velocity(const std::vector<Line>& lines, std::size_t fixed, std::size_t first, double speed, Vec& best) {
  double distance = 0;
  for (std::size_t i = first; i < lines.size(); ++i) {
    if (det(lines[i].direction, lines[i].point - best) <= distance) continue;
    std::vector<Line> projected(lines.begin(), lines.begin() + static_cast<std::ptrdiff_t>(fixed));
    for (std::size_t j = fixed; j < i; ++j) {
      const double slope = det(lines[i].direction, lines[j].direction);
      Line line;
      if (std::abs(slope) < 1e-9) {
        if (dot(lines[i].direction, lines[j].direction) > 0) continue;
        line.point = 0.5 * (lines[i].point + lines[j].point);
      } else {
        line.point =
            lines[i].point + (det(lines[j].direction, lines[i].point - lines[j].point) / slope) * lines[i].direction;
      }
      const Vec between = lines[j].direction - lines[i].direction;
      line.direction = (1 / norm(between)) * between;
      projected.push_back(line);
    }
    const Vec before = best;
    if (best_velocity(projected, speed, {-lines[i].direction.y, lines[i].direction.x}, true, best) < projected.size())
      best = before;
    distance = det(lines[i].direction, lines[i].point - best);
  }
}

/// The half plane of velocities by which one of two discs does its half to keep clear for some time.
Line reciprocal_line(Vec position, Vec velocity, double radius, Vec own_velocity, double horizon, double step) {
  Line line;
  Vec u;
  const double squared = dot(position, position);
  if (squared > radius * radius) {
    const Vec w = velocity - (1 / horizon) * position;
    const double along = dot(w, position);
    if (along < 0 && along * along > radius * radius * dot(w, w)) {
      const Vec unit = (1 / norm(w)) * w;
      line.direction = {unit.y, -unit.x};
      u = (radius / horizon - norm(w)) * unit;
    } else {
      const double leg = std::sqrt(squared - radius * radius);
      line.direction =
          det(position, w) > 0
              ? (1 / squared) * Vec{position.x * leg - position.y * radius, position.x * radius + position.y * leg}
              : (-1 / squared) * Vec{position.x * leg + position.y * radius, -position.x * radius + position.y * leg};
      u = dot(velocity, line.direction) * line.direction - velocity;
    }
  } else {
    const Vec w = velocity - (1 / step) * position;
    const Vec unit = (1 / norm(w)) * w;
    line.direction = {unit.y, -unit.x};
    u = (radius / step - norm(w)) * unit;
  }
  line.point = own_velocity + 0.5 * u;
  return line;
}

Paths orca(const Plan& plan, const Clock& clock) {
  constexpr double step = 0.1, horizon = 2, safety = 1.005, arrived = 1e-3;
  const double radius = plan.agents[0].radius, pitch = 0.5 * radius;
  const Grid grid = make_grid(plan, pitch, safety * radius, true);
  std::vector<std::vector<double>> left;
  std::vector<Vec> p, v(plan.agents.size());
  for (const Agent& agent : plan.agents) {
    Grid own = grid;
    const int goal = add_place(plan, own, agent.goal, 2 * pitch, safety * radius);
    left.push_back(distances_to(own, goal, false));
    p.push_back(agent.start);
  }
  const int nx = static_cast<int>((plan.room.hi.x - plan.room.lo.x) / pitch) + 1;
  /// The goal of the moment: the farthest visible point of the way down the distances.
  const auto target = [&](std::size_t i) {
    const Vec goal = plan.agents[i].goal;
    if (is_clear(plan, p[i], goal, radius)) return goal;
    int node = -1;
    const int x = static_cast<int>((p[i].x - plan.room.lo.x) / pitch),
              y = static_cast<int>((p[i].y - plan.room.lo.y) / pitch);
    double least = std::numeric_limits<double>::infinity();
    for (int dy = -2; dy <= 3; ++dy)
      for (int dx = -2; dx <= 3; ++dx) {
        const int n = (y + dy) * nx + x + dx;
        if (x + dx < 0 || x + dx >= nx || n < 0 || n >= static_cast<int>(grid.at.size())) continue;
        const double length = left[i][n] + norm(grid.at[n] - p[i]);
        if (length < least && is_clear(plan, p[i], grid.at[n], radius)) {
          least = length;
          node = n;
        }
      }
    if (node < 0) return goal;
    for (;;) {
      int next = -1;
      for (const int m : grid.next[node])
        if (left[i][m] < left[i][node] && (next < 0 || left[i][m] < left[i][next])) next = m;
      if (next < 0 || !is_clear(plan, p[i], grid.at[next], radius)) return grid.at[node];
      node = next;
    }
  };
  const int steps = static_cast<int>(plan.duration / step);
  Paths paths;
  for (const Vec& start : p) paths.push_back({start});
  for (int k = 0; k < steps && !clock.is_over(); ++k) {
    std::vector<Vec> chosen;
    for (std::size_t i = 0; i < p.size(); ++i) {
      const double speed = plan.agents[i].speed;
      std::vector<Line> lines;
      for (const Box& box : plan.boxes) {
        const Vec away = p[i] - box.nearest(p[i]);
        const double gap = norm(away) - radius;
        if (gap > speed * horizon || !(norm(away) > 0)) continue;
        const Vec unit = (1 / norm(away)) * away;
        lines.push_back({(-gap / horizon) * unit, {unit.y, -unit.x}});
      }
      const std::size_t fixed = lines.size();
      for (std::size_t j = 0; j < p.size(); ++j)
        if (j != i && norm(p[j] - p[i]) < 2 * radius + 2 * speed * horizon)
          lines.push_back(reciprocal_line(p[j] - p[i], v[i] - v[j], 2 * safety * radius, v[i], horizon, step));
      const Vec way = target(i) - p[i];
      const Vec wanted = norm(way) > speed * step ? (speed / norm(way)) * way : (1 / step) * way;
      // A little aside, a different way each: without, two that meet head on stand forever.
      const double angle = 2.39996 * static_cast<double>(i + p.size() * static_cast<std::size_t>(k));
      const Vec aside = norm(way) > arrived ? Vec{1e-2 * std::cos(angle), 1e-2 * std::sin(angle)} : Vec{};
      Vec best;
      const std::size_t failed = best_velocity(lines, speed, wanted + aside, false, best);
      if (failed < lines.size()) least_bad_velocity(lines, fixed, failed, speed, best);
      chosen.push_back(best);
    }
    bool is_done = true;
    for (std::size_t i = 0; i < p.size(); ++i) {
      v[i] = chosen[i];
      p[i] = p[i] + step * v[i];
      paths[i].push_back(p[i]);
      is_done = is_done && norm(p[i] - plan.agents[i].goal) < 10 * arrived;
    }
    if (!is_done) continue;
    for (std::size_t i = 0; i < p.size(); ++i)
      while (static_cast<int>(paths[i].size()) <= steps) paths[i].push_back(plan.agents[i].goal);
    return paths;
  }
  return {};
}

}  // namespace

int main(int count, char** given) {
  if (count != 5) {
    std::cerr << "usage: unsnarl_route_planners cbs|orca PLAN.json ROUTES.json CPU_SECONDS\n";
    return 2;
  }
  const Plan plan = read_plan(given[2]);
  const Clock clock(std::stod(given[4]));
  const Paths paths = std::string(given[1]) == "cbs" ? cbs(plan, clock) : orca(plan, clock);
  if (paths.empty()) return 1;
  nlohmann::json json = {{"duration", plan.duration}, {"routes", nlohmann::json::array()}};
  // The last point of a grid's steps is before the duration; all agents have arrived by then.
  if (std::string(given[1]) == "cbs")
    json["duration"] = 2.02 * plan.agents[0].radius / plan.agents[0].speed * static_cast<double>(paths[0].size() - 1);
  for (std::size_t i = 0; i < paths.size(); ++i) {
    nlohmann::json points = nlohmann::json::array();
    for (const Vec& p : paths[i]) points.push_back({p.x, p.y, plan.z});
    json["routes"].push_back({{"name", plan.agents[i].name}, {"points", std::move(points)}});
  }
  std::ofstream(given[3]) << json.dump() << "\n";
  return 0;
}
