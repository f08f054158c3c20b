#include "applications/routes/time_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <queue>
#include <tuple>
#include <unordered_map>

namespace unsnarl {
namespace {

/// Ways keep this far from agents and obstacles, so that the energy that smooths them begins below its barriers (unit:
/// needed distance)
constexpr double search_reach = 1.01;
/// Times of blocked moments that begin or end with a step are moved by this, which makes the step's end belong to
/// them: any part of a step does, since times are rounded to steps then (fixed by rounding)
constexpr double part_of_step = 0.25;
/// Room for agents around everything in the plan [E261] (unit: radius of the largest agent)
constexpr double search_room = 8;
/// A search that looked at so many nodes finds nothing (unit: nodes)
constexpr int most_looked_at = 200000;
/// New orders of the agents, at most [E260] (unit: orders)
constexpr int most_orders = 20;
/// An agent that found no way and then chooses first leaves later by what it takes to go this far, each time: two that
/// meet head on would else both block the bay between them [E257] (unit: radius)
constexpr double wait_of_first = 4;
/// Orders that give all agents a way, at most: the one with the shortest ways is taken [E258] (unit: orders)
constexpr int most_found = 3;
/// An agent whose way is longer than this beside the one that it gets alone chooses first in another order
/// [E259] (unit: length of the way alone)
constexpr double least_detour = 1.2;
/// A place is joined to the grid within this many cells to each side (unit: cells)
constexpr int cells_around_a_place = 2;

/// What an agent does for some time: places at steps, straight and even in between.
struct Track {
  int agent = 0;
  std::vector<Index> step;
  std::vector<Vec3> place;

  void add(Index at, const Vec3& p) {
    step.push_back(at);
    place.push_back(p);
  }
  /// The piece that holds this step: from one entry to the next.
  std::size_t piece_at(Index at) const {
    const auto after = std::upper_bound(step.begin(), step.end(), at) - step.begin();
    return static_cast<std::size_t>(
        std::clamp<std::ptrdiff_t>(after - 1, 0, static_cast<std::ptrdiff_t>(step.size()) - 2));
  }
};

/// Steps of a window that agents keep, whatever rounding does.
std::array<Index, 2> window_steps(const RoutePlan& plan, const RouteAgent& agent, Index steps) {
  constexpr double rounding = 1e-12;  ///< Times are moved by this (unit: all time)
  const double from = agent.window[0] / plan.duration, to = std::min(agent.window[1] / plan.duration, 1.0);
  const auto first = from > 0 ? static_cast<Index>(std::ceil((from + rounding) * steps)) : 0;
  const auto last = to < 1 ? static_cast<Index>(std::floor((to - rounding) * steps)) : steps;
  return {first, last};
}

/// Whether two things that move from p to q and from a to b at the same time stay this far apart.
bool stay_apart(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, double distance) {
  return closest_in_time(p, q, a, b).distance >= distance;
}

/// The nodes of one agent's grid and its places, found when they are asked for.
class AgentGraph {
 public:
  using Key = std::int64_t;
  struct Move {
    Key to;
    Index steps;
  };
  struct State {
    Index from = 0, to = 0;  // steps in which the node is safe
    Index at = std::numeric_limits<Index>::max();
    bool is_done = false;
    Key parent = -1;
    std::size_t parent_state = 0;
    Index left = 0;  // when the parent was left
  };
  struct Node {
    Vec3 at;
    Index leg = 0;
    bool has_moves = false;
    std::vector<Move> moves;
    int search = -1;  // that the states are of
    std::vector<State> states;
  };

  AgentGraph(const RoutePlan& plan, std::size_t agent, const ObstacleTriangles& still, const Box& room, double stride,
             double cell)
      : agent_(plan.agents[agent]), still_(still), places_(places_of(agent_)), stride_(stride) {
    cell_ = cell * agent_.radius;
    distance_ = search_reach * agent_.radius;
    for (const Vec3& p : places_) distance_ = std::min(distance_, still.distance(p, distance_));
    for (int k = 0; k < 3; ++k) {
      const bool is_flat = agent_.planar && k == 2;
      below_[k] = is_flat ? 0 : static_cast<Key>((places_[0][k] - room.lo[k]) / cell_);
      size_[k] = is_flat ? 1 : below_[k] + 1 + static_cast<Key>((room.hi[k] - places_[0][k]) / cell_);
    }
    legs_ = static_cast<Key>(places_.size()) - 1;
    grid_ = size_[0] * size_[1] * size_[2];
  }

  double distance() const { return distance_; }
  const std::vector<Vec3>& places() const { return places_; }
  Key place(std::size_t k) const { return key(grid_ + static_cast<Key>(k), static_cast<Key>(k)); }
  Key goal() const { return place(places_.size() - 1); }

  Node& node(Key k) {
    const auto [found, is_new] = nodes_.try_emplace(k);
    if (is_new) {
      const Key n = k / (legs_ + 1);
      found->second.leg = static_cast<Index>(k % (legs_ + 1));
      found->second.at = n >= grid_ ? places_[static_cast<std::size_t>(n - grid_)] : position(cell_of(n));
    }
    return found->second;
  }

  /// Where one may go from a node, obstacles that stand considered.
  const std::vector<Move>& moves(Key k) {
    Node& from = node(k);
    if (from.has_moves) return from.moves;
    from.has_moves = true;
    std::vector<Move> moves;
    const Key n = k / (legs_ + 1);
    const Vec3 at = from.at;
    const auto offer = [&](const Vec3& to, Key key_to) {
      if (still_.is_clear(at, to, distance_)) moves.push_back({key_to, steps_of((to - at).norm())});
    };
    if (from.leg < legs_) offer(places_[from.leg + 1], place(static_cast<std::size_t>(from.leg) + 1));
    std::array<Key, 3> c{};
    const bool is_place = n >= grid_;
    for (int d = 0; d < 3; ++d)
      c[d] = is_place ? below_[d] + static_cast<Key>(std::floor((at[d] - places_[0][d]) / cell_ + 0.5)) : cell_of(n)[d];
    const int around = is_place ? cells_around_a_place : 1;
    for (Key z = std::max<Key>(0, c[2] - around); z <= std::min(size_[2] - 1, c[2] + around); ++z)
      for (Key y = std::max<Key>(0, c[1] - around); y <= std::min(size_[1] - 1, c[1] + around); ++y)
        for (Key x = std::max<Key>(0, c[0] - around); x <= std::min(size_[0] - 1, c[0] + around); ++x) {
          const Vec3 to = position({x, y, z});
          if (to != at) offer(to, key((z * size_[1] + y) * size_[0] + x, from.leg));
        }
    return node(k).moves = std::move(moves);
  }

  Index steps_of(double length) const {
    return std::max<Index>(1, static_cast<Index>(std::ceil(length / stride_ * (1 - few_ulps))));
  }
  /// Steps that are left from a node, at least.
  double steps_left(const Node& node) const {
    double length = 0;
    for (std::size_t k = static_cast<std::size_t>(node.leg) + 1; k < places_.size(); ++k)
      length += (places_[k] - (k == static_cast<std::size_t>(node.leg) + 1 ? node.at : places_[k - 1])).norm();
    return length / stride_;
  }

 private:
  /// Lengths that are a whole number of strides but for rounding take no step more (no unit)
  static constexpr double few_ulps = 1e-12;

  Key key(Key node, Key leg) const { return node * (legs_ + 1) + leg; }
  std::array<Key, 3> cell_of(Key n) const { return {n % size_[0], n / size_[0] % size_[1], n / size_[0] / size_[1]}; }
  Vec3 position(const std::array<Key, 3>& c) const {
    Vec3 p;
    for (int k = 0; k < 3; ++k) p[k] = places_[0][k] + cell_ * static_cast<double>(c[k] - below_[k]);
    return p;
  }

  const RouteAgent& agent_;
  const ObstacleTriangles& still_;
  std::vector<Vec3> places_;
  double stride_, cell_ = 0, distance_ = 0;
  std::array<Key, 3> below_{}, size_{};
  Key legs_ = 0, grid_ = 0;
  std::unordered_map<Key, Node> nodes_;
};

class TimeSearch {
 public:
  TimeSearch(const RoutePlan& plan, const ObstacleTriangles& still, const std::vector<MovingObstacle>& moving,
             const TimeSearchSettings& settings)
      : plan_(plan), moving_(moving), settings_(settings) {
    Box room = still.bounds();
    double widest = 0;
    for (const RouteAgent& agent : plan.agents) {
      for (const Vec3& p : places_of(agent)) room.extend(p);
      widest = std::max(widest, agent.radius);
    }
    for (const MovingObstacle& obstacle : moving) {
      room.extend(obstacle.reach().lo);
      room.extend(obstacle.reach().hi);
    }
    room = room.inflated(search_room * widest);
    for (std::size_t i = 0; i < plan.agents.size(); ++i) {
      graphs_.emplace_back(plan, i, still, room, settings.stride[i], settings.cell);
      windows_.push_back(window_steps(plan, plan.agents[i], settings.steps));
      failures_.push_back(0);
    }
  }

  std::vector<TimedWay> run(int& failed) {
    std::vector<std::size_t> order(plan_.agents.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      const auto rank = [&](std::size_t i) {
        return std::pair(-plan_.agents[i].priority, -graphs_[i].steps_left(graphs_[i].node(graphs_[i].place(0))));
      };
      return rank(a) < rank(b);
    });
    std::vector<Track> tracks(order.size());
    std::vector<TimedWay> best;
    double best_length = std::numeric_limits<double>::infinity();
    std::size_t done = 0;  // of the order, those whose tracks hold
    int found = 0;
    for (int orders = 0; orders < most_orders && found < most_found && !settings_.stopped(); ++orders) {
      while (done < order.size()) {
        std::optional<Track> track = find(order, done, tracks);
        if (!track) break;
        tracks[order[done]] = std::move(*track);
        ++done;
      }
      std::size_t to_front = done;
      if (done == order.size()) {
        ++found;
        double length = 0;
        for (const Track& track : tracks) length += length_of(track);
        if (length < best_length) best = ways(tracks);
        best_length = std::min(best_length, length);
        to_front = longest_detour(order, tracks);
        if (to_front == order.size()) break;
      } else {
        failed = static_cast<int>(order[done]);
      }
      ++failures_[order[to_front]];
      std::size_t first = to_front;
      while (first > 0 && plan_.agents[order[first - 1]].priority == plan_.agents[order[to_front]].priority) --first;
      if (first == to_front) break;
      std::rotate(order.begin() + static_cast<std::ptrdiff_t>(first),
                  order.begin() + static_cast<std::ptrdiff_t>(to_front),
                  order.begin() + static_cast<std::ptrdiff_t>(to_front) + 1);
      done = first;
    }
    return best;
  }

 private:
  using Key = AgentGraph::Key;
  using State = AgentGraph::State;

  static double length_of(const Track& track) {
    double length = 0;
    for (std::size_t k = 0; k + 1 < track.place.size(); ++k) length += (track.place[k + 1] - track.place[k]).norm();
    return length;
  }

  /// The place in the order of the agent whose way is longest beside the one that it gets alone; the end where none is
  /// worth another order.
  std::size_t longest_detour(const std::vector<std::size_t>& order, const std::vector<Track>& tracks) {
    std::size_t longest = order.size();
    double most = least_detour;
    for (std::size_t k = 0; k < order.size() && !settings_.stopped(); ++k) {
      const std::optional<Track> alone = find({order[k]}, 0, tracks);
      const double detour = alone ? length_of(tracks[order[k]]) / length_of(*alone) : 1;
      if (detour > most) longest = k;
      most = std::max(most, detour);
    }
    return longest;
  }

  /// The distance that two agents keep: more than they need, where their starts and goals do.
  double apart(std::size_t i, std::size_t j) const {
    const RouteAgent &a = plan_.agents[i], &b = plan_.agents[j];
    return std::min({search_reach * (a.radius + b.radius), (vec(a.start) - vec(b.start)).norm(),
                     (vec(a.goal) - vec(b.goal)).norm()});
  }

  /// What the others do that the next one in the order has to respect: their tracks, or until they have chosen, that
  /// they stand at their start before their window and at their goal after it.
  std::vector<Track> others(const std::vector<std::size_t>& order, std::size_t done,
                            const std::vector<Track>& tracks) const {
    std::vector<Track> found;
    for (std::size_t k = 0; k < order.size(); ++k) {
      const std::size_t i = order[k];
      if (k < done) found.push_back(tracks[i]);
      if (k <= done) continue;
      const auto stand = [&](Index from, Index to, const RoutePoint& at) {
        if (from == to) return;
        Track& track = found.emplace_back();
        track.agent = static_cast<int>(i);
        track.add(from, vec(at));
        track.add(to, vec(at));
      };
      stand(0, windows_[i][0], plan_.agents[i].start);
      stand(windows_[i][1], settings_.steps, plan_.agents[i].goal);
    }
    return found;
  }

  /// Steps from and to in which an agent can stand here.
  std::vector<State> safe_states(std::size_t agent, const Vec3& p, const std::vector<Track>& others) const {
    std::vector<std::array<double, 2>> blocked;
    for (const Track& track : others) {
      const double distance = apart(agent, static_cast<std::size_t>(track.agent));
      for (std::size_t k = 0; k + 1 < track.step.size(); ++k) {
        const Vec3 from = track.place[k] - p, way = track.place[k + 1] - track.place[k];
        const double a = way.squaredNorm(), b = from.dot(way), c = from.squaredNorm() - distance * distance;
        double lo = 0, hi = 1;
        if (a > 0) {
          const double root = b * b - a * c;
          if (!(root > 0)) continue;
          lo = (-b - std::sqrt(root)) / a;
          hi = (-b + std::sqrt(root)) / a;
          if (!(hi > 0 && lo < 1)) continue;
        } else if (!(c < 0)) {
          continue;
        }
        const double step = track.step[k], steps = track.step[k + 1] - track.step[k];
        blocked.push_back({lo <= 0 ? step - part_of_step : step + lo * steps,
                           hi >= 1 ? step + steps + part_of_step : step + hi * steps});
      }
    }
    for (const MovingObstacle& obstacle : moving_) {
      Box box;
      box.extend(p);
      if (!box.inflated(graphs_[agent].distance()).overlaps(obstacle.reach())) continue;
      for (Index k = 0; k < settings_.steps; ++k)
        if (!obstacle.is_clear(k, p, p, graphs_[agent].distance()))
          blocked.push_back({k - part_of_step, k + 1 + part_of_step});
    }
    std::sort(blocked.begin(), blocked.end());
    std::vector<State> safe;
    double from = 0;
    const auto add = [&](double to) {
      if (std::ceil(from) > to) return;
      State& state = safe.emplace_back();
      state.from = static_cast<Index>(std::ceil(from));
      state.to = static_cast<Index>(std::floor(to));
    };
    for (const auto& [lo, hi] : blocked) {
      if (lo > from) add(lo);
      from = std::max(from, hi);
    }
    add(settings_.steps);
    return safe;
  }

  bool is_clear(std::size_t agent, const Vec3& p, const Vec3& q, Index left, Index steps,
                const std::vector<Track>& others) const {
    const auto at = [&](Index step) { return Vec3(p + (static_cast<double>(step - left) / steps) * (q - p)); };
    Box box;
    box.extend(p);
    box.extend(q);
    for (const Track& track : others) {
      const double distance = apart(agent, static_cast<std::size_t>(track.agent));
      for (std::size_t k = track.piece_at(left); k + 1 < track.step.size() && track.step[k] < left + steps; ++k) {
        const Index from = std::max(left, track.step[k]), to = std::min(left + steps, track.step[k + 1]);
        if (from >= to) continue;
        const double length = track.step[k + 1] - track.step[k];
        const auto there = [&](Index step) {
          return Vec3(track.place[k] + ((step - track.step[k]) / length) * (track.place[k + 1] - track.place[k]));
        };
        if (!stay_apart(at(from), at(to), there(from), there(to), distance)) return false;
      }
    }
    const double distance = graphs_[agent].distance();
    for (const MovingObstacle& obstacle : moving_)
      if (box.inflated(distance).overlaps(obstacle.reach()))
        for (Index k = left; k < left + steps; ++k)
          if (!obstacle.is_clear(k, at(k), at(k + 1), distance)) return false;
    return true;
  }

  std::optional<Track> find(const std::vector<std::size_t>& order, std::size_t done, const std::vector<Track>& tracks) {
    const std::size_t agent = order[done];
    AgentGraph& graph = graphs_[agent];
    const std::vector<Track> others = this->others(order, done, tracks);
    const auto [first, last] = windows_[agent];
    ++searches_;
    const auto states = [&](Key key) -> std::vector<State>& {
      AgentGraph::Node& node = graph.node(key);
      if (node.search != searches_) node.states = safe_states(agent, node.at, others);
      node.search = searches_;
      return node.states;
    };
    using Entry = std::tuple<double, Index, Key, std::size_t>;  // least arrival, steps not yet made, where
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    const auto reach = [&](Key key, std::size_t s, Index at) {
      states(key)[s].at = at;
      open.emplace(at + graph.steps_left(graph.node(key)), -at, key, s);
    };
    const Key start = graph.place(0), goal = graph.goal();
    if (!states(start).empty() && states(start)[0].from == 0 && states(start)[0].to >= first) {
      // One that chooses first after it found no way waits for the others to get out of its way.
      const double wait = failures_[agent] * wait_of_first * plan_.agents[agent].radius / settings_.stride[agent];
      reach(start, 0, first + static_cast<Index>(std::min<double>(wait, states(start)[0].to - first)));
    }
    for (int looked_at = 0; !open.empty() && looked_at < most_looked_at && !settings_.stopped(); ++looked_at) {
      const auto [bound, unmade, key, s] = open.top();
      open.pop();
      const State state = states(key)[s];
      if (state.is_done || state.at != -unmade) continue;
      states(key)[s].is_done = true;
      if (key == goal) return track_to(agent, graph, s);
      const Vec3 p = graph.node(key).at;
      for (const AgentGraph::Move& move : graph.moves(key)) {
        const Vec3 q = graph.node(move.to).at;
        for (std::size_t t = 0; t < states(move.to).size(); ++t) {
          const State to = states(move.to)[t];
          if (to.is_done || (move.to == goal && to.to < settings_.steps)) continue;
          const Index latest = std::min({state.to, to.to - move.steps, last - move.steps, to.at - move.steps - 1});
          for (Index left = std::max(state.at, to.from - move.steps); left <= latest; ++left)
            if (is_clear(agent, p, q, left, move.steps, others)) {
              State& better = states(move.to)[t];
              better.parent = key;
              better.parent_state = s;
              better.left = left;
              reach(move.to, t, left + move.steps);
              break;
            }
        }
      }
    }
    return std::nullopt;
  }

  Track track_to(std::size_t agent, AgentGraph& graph, std::size_t goal_state) const {
    std::vector<std::pair<Index, Vec3>> back{{settings_.steps, graph.node(graph.goal()).at}};
    Key key = graph.goal();
    std::size_t s = goal_state;
    for (;;) {
      const State& state = graph.node(key).states[s];
      back.emplace_back(state.parent < 0 ? 0 : state.at, graph.node(key).at);
      if (state.parent < 0) break;
      back.emplace_back(state.left, graph.node(state.parent).at);
      s = state.parent_state;
      key = state.parent;
    }
    Track track;
    track.agent = static_cast<int>(agent);
    for (auto entry = back.rbegin(); entry != back.rend(); ++entry)
      if (track.step.empty() || track.step.back() < entry->first) track.add(entry->first, entry->second);
    return track;
  }

  std::vector<TimedWay> ways(const std::vector<Track>& tracks) const {
    std::vector<TimedWay> found;
    for (const Track& track : tracks) {
      TimedWay& way = found.emplace_back();
      const std::vector<Vec3>& places = graphs_[found.size() - 1].places();
      std::size_t passed = 0;  // places
      way.points.push_back(track.place[0]);
      for (std::size_t k = 0; k + 1 < track.step.size(); ++k)
        for (Index step = track.step[k] + 1; step <= track.step[k + 1]; ++step) {
          const double share = static_cast<double>(step - track.step[k]) / (track.step[k + 1] - track.step[k]);
          const bool is_end = step == track.step[k + 1] || track.place[k] == track.place[k + 1];
          way.points.push_back(is_end ? track.place[k + 1]
                                      : Vec3(track.place[k] + share * (track.place[k + 1] - track.place[k])));
        }
      for (const Vec3& p : way.points) {
        if (passed + 1 < places.size() && p == places[passed + 1]) ++passed;
        way.pinned.push_back(p == places[passed]);
      }
    }
    return found;
  }

  const RoutePlan& plan_;
  const std::vector<MovingObstacle>& moving_;
  const TimeSearchSettings& settings_;
  std::vector<AgentGraph> graphs_;
  std::vector<std::array<Index, 2>> windows_;
  std::vector<int> failures_;  // of each agent
  int searches_ = 0;
};

}  // namespace

std::vector<TimedWay> search_in_time(const RoutePlan& plan, const ObstacleTriangles& still,
                                     const std::vector<MovingObstacle>& moving, const TimeSearchSettings& settings,
                                     int& failed) {
  return TimeSearch(plan, still, moving, settings).run(failed);
}

}  // namespace unsnarl
