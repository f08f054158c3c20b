#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "applications/routes/moving_obstacles.h"
#include "applications/routes/proven_bounds.h"
#include "applications/routes/route_energy.h"
#include "applications/routes/time_search.h"
#include "applications/routes/way_finder.h"
#include "geometry/portable_math.h"
#include "optimize/lbfgs.h"
#include "run/run_control.h"

namespace unsnarl {
namespace {

/// Distances from obstacles at which ways are looked for, the widest first (unit: radii)
constexpr std::array<double, 3> way_distances = {1.05, 1.01, 1.001};
/// The middle of each leg is first pushed aside by this, one a try, so that no two routes cross or lie on each other
/// (unit: radii)
constexpr std::array<double, 3> pushed_aside = {0.3, 2, 6};
/// A leg is pushed aside as far as no obstacle is in the way, halved down to this (unit: share of pushed_aside)
constexpr double least_aside = 0.01;
constexpr double swelling_share = 0.4;    ///< Share of a try's progress that swelling takes (no unit)
constexpr double parting_share = 0.4;     ///< Share of a try's progress that parting takes (no unit)
constexpr double tightening_from = 0.8;   ///< Share of a try's progress when routes are pulled tight (no unit)
constexpr double certifying_from = 0.98;  ///< Share of a try's progress when they are certified (no unit)
/// Radii that tubes swell to, step by step: thin ones find a way past each other (unit: share of the radius)
constexpr std::array<double, 6> swelling = {0.1, 0.2, 0.35, 0.55, 0.8, 1};
constexpr int swelling_steps = 25;  ///< Steps at each of these radii (unit: steps)
constexpr int parting_steps = 50;   ///< Steps in each round of parting routes (unit: steps)
/// Weights of violations grow by this factor from round to round until nothing is violated (no unit)
constexpr double harder = 4;
constexpr int most_rounds = 9;  ///< Rounds of parting routes, at most (unit: rounds)
/// Weight of contacts and turns at the beginning: small, since hard pushes at the start make kinks that take long to
/// undo [E199] (no unit)
constexpr double first_weight = 0.005;
/// In time, unless their speed is limited, agents move this many times as fast as the one that has to be fastest when
/// they search their ways, one a try: so they can wait (no unit)
constexpr std::array<double, 3> search_paces = {2, 4, 8};
/// Width of the grid's cells in a search in time, one a try (unit: radius of the agent)
constexpr std::array<double, 3> search_cells = {1, 0.5, 0.35};
/// A search in time uses this share of a limited speed: round turns are longer than the corners of its ways [E255] (no
/// unit)
constexpr double search_speed = 0.9;
/// Steps that all time is cut into, at most (unit: steps)
constexpr double most_time_steps = 2000;
/// Rounds of easing turns in which agents are not yet made to stand where a turn stays too tight (unit: rounds)
constexpr int rounds_without_stops = 2;
/// Weights of barriers while routes are pulled tight (no unit)
constexpr std::array<double, 2> barrier_weights = {0.1, 0.01};
constexpr int tightening_steps = 100;  ///< Steps at each of these weights (unit: steps)
constexpr int alone_steps = 100;       ///< Steps of pulling the route of an agent alone tight (unit: steps)
/// The preconditioner is factorised anew after this many steps (unit: steps)
constexpr int steps_a_factorisation = 5;
/// Steps end where the energy falls by less than this share in `settled_steps` (no unit)
constexpr double settled = 1e-5;
/// Steps over which the decrease of the energy is measured (unit: steps)
constexpr int settled_steps = 10;
/// Longest motion of a vertex in one step (unit: radius of the smallest agent)
constexpr double most_motion = 2;
/// Left above the needed distance, and below the tightest turn, when barriers begin (unit: share of either)
constexpr double margin = 1e-6;

/// radius * curvature at a vertex.
double turn_of_vertex(const Eigen::VectorXd& x, Index v, double radius) {
  return proven_turn(x.segment<3>(3 * v - 3), x.segment<3>(3 * v), x.segment<3>(3 * v + 3), radius);
}

bool is_finite(RouteEnergy& energy, const Eigen::VectorXd& x) {
  Eigen::VectorXd gradient;
  return energy(x, gradient) < std::numeric_limits<double>::infinity();
}

class Planning {
 public:
  Planning(const RoutePlan& plan, const RouteOptions& options, Context* context)
      : plan_(plan), options_(options), control_(context, {.time_s = options.time_limit_s}), triangles_(plan) {}

  RoutesResult run() {
    made_.messages = route_obstructions(plan_);
    if (!made_.messages.empty()) return ended(Status::obstructed);
    if (!find_ways())
      return ended(made_.messages.empty() ? control_.status_or(Status::no_progress) : Status::no_progress);
    if (options_.ways_only) {
      const RouteChains chains = sample_chains(plan_, ways_, options_.spacing, true);
      made_.asked = chains.routes(chains.x);
      return ended(Status::no_progress);
    }
    if (plan_.timed) {
      run_in_time();
    } else {
      for (std::size_t k = 0; k < pushed_aside.size() && !control_.stopped() && !is_found(); ++k)
        part(pushed_aside[k], static_cast<double>(k) / pushed_aside.size(), 1.0 / pushed_aside.size(), 1 << k);
    }
    if (is_found()) return ended(Status::embedded);
    return ended(control_.stopped() ? control_.status_or(Status::no_progress) : Status::no_progress);
  }

 private:
  bool is_found() const { return !made_.routes.empty() && made_.found.hold(); }

  RoutesResult ended(Status status) {
    made_.status = status;
    made_.seconds = control_.seconds();
    return std::move(made_);
  }
  /// One for each height in which planar agents move, and one for all others.
  using Finders = std::map<std::optional<double>, WayFinder>;
  static std::optional<double> plane_of(const RouteAgent& agent) {
    return agent.planar ? std::optional(agent.start[2]) : std::nullopt;
  }
  /// Ways straight or past the obstacles; spread: later agents avoid the ways of earlier ones.
  std::vector<Legs> ways(Finders& finders, bool spread) {
    double widest = 0;
    for (const RouteAgent& agent : plan_.agents) widest = std::max(widest, agent.radius);
    std::vector<std::size_t> order(plan_.agents.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return plan_.agents[a].priority > plan_.agents[b].priority; });
    std::vector<Legs> found(plan_.agents.size());
    for (const std::size_t i : order) {
      const RouteAgent& agent = plan_.agents[i];
      Legs& legs = found[i];
      WayFinder* const finder = triangles_.empty() ? nullptr : &finders.at(plane_of(agent));
      const std::vector<Vec3> places = places_of(agent);
      for (std::size_t k = 0; k + 1 < places.size() && !control_.stopped(); ++k) {
        std::optional<std::vector<Vec3>> way;
        if (finder == nullptr) way = {places[k], places[k + 1]};
        for (std::size_t d = 0; d < way_distances.size() && !way; ++d)
          way = finder->find(places[k], places[k + 1], way_distances[d] * agent.radius);
        if (!way) {
          made_.messages.push_back(
              fmt::format("no way was found for '{}' from ({:.6g}, {:.6g}, {:.6g}) to ({:.6g}, {:.6g}, {:.6g}): the "
                          "obstacles leave "
                          "no gap for its radius of {:.6g}, or none that a grid shows",
                          agent.name, places[k][0], places[k][1], places[k][2], places[k + 1][0], places[k + 1][1],
                          places[k + 1][2], agent.radius));
          continue;
        }
        if (spread)
          for (auto& [plane, other] : finders) other.avoid(*way, agent.radius + widest);
        legs.push_back(std::move(*way));
      }
    }
    return found;
  }

  bool find_ways() {
    control_.tell(0, "find ways");
    Finders finders;
    if (!triangles_.empty())
      for (const RouteAgent& agent : plan_.agents)
        finders.try_emplace(plane_of(agent), plan_, triangles_, plane_of(agent));
    shortest_ways_ = ways(finders, false);
    if (!made_.messages.empty()) return false;
    ways_ = !finders.empty() && !plan_.timed ? ways(finders, true) : shortest_ways_;
    return !control_.stopped();
  }

  /// Pushes the middle of each leg aside, each in a direction of its own, by the golden angle.
  Positions aside(const RouteChains& chains, double by) const {
    Positions x = chains.x;
    Index leg = 0;
    for (const RouteChains::Chain& chain : chains.chains)
      for (Index first = chain.first; first < chain.last(); ++leg) {
        Index last = first + 1;
        while (!chains.pinned[last]) ++last;
        const Vec3 along = (chains.x.col(last) - chains.x.col(first)).normalized();
        const Vec3 e = chain.planar ? Vec3(-along.y(), along.x(), 0) : along.unitOrthogonal();
        const Vec3 f = chain.planar ? e : along.cross(e);
        const double angle = 2 * std::numbers::pi * std::fmod(leg * std::numbers::phi, 1);
        // Offsets differ: lines through one centre with equal offsets would touch one ball and cross on it.
        const double amount = by * chain.radius * (0.5 + std::fmod(leg * std::numbers::sqrt2, 1));
        const Vec3 offset = amount * (portable::cos(angle) * e + portable::sin(angle) * f);
        for (double part = 1; part > least_aside; part /= 2) {
          Positions moved = chains.x;
          bool is_clear = true;
          for (Index v = first + 1; v < last; ++v)
            moved.col(v) += part * portable::sin(std::numbers::pi * (v - first) / (last - first)) * offset;
          for (Index v = first; v < last && is_clear; ++v)
            is_clear = triangles_.is_clear(moved.col(v), moved.col(v + 1), chain.radius * (1 + margin));
          if (!is_clear) continue;
          x.middleCols(first, last - first) = moved.middleCols(first, last - first);
          break;
        }
        first = last;
      }
    return x;
  }

  /// Minimises for `steps` steps, or until the energy settles.
  void minimise(RouteEnergy& energy, Eigen::VectorXd& x, int steps, double radius) {
    if (control_.stopped()) return;
    energy.factorise(x);
    LbfgsOptions options;
    options.max_iterations = steps;
    options.max_motion = most_motion * radius;
    std::vector<double> values;
    minimize_lbfgs([&](const Eigen::VectorXd& at, Eigen::VectorXd& gradient) { return energy(at, gradient); }, x,
                   options, [&](const Eigen::VectorXd& v, Eigen::VectorXd& out) { energy.precondition(v, out); },
                   [&](LbfgsIteration& state) {
                     values.push_back(state.value);
                     if (state.iteration > 0 && state.iteration % steps_a_factorisation == 0) {
                       energy.factorise(state.x);
                       state.forget = true;
                     }
                     const std::size_t n = values.size();
                     return control_.stopped() || (n > settled_steps && values[n - 1 - settled_steps] - values[n - 1] <
                                                                            settled * std::abs(values[n - 1]));
                   });
  }

  Eigen::VectorXd flat(const Positions& x) const { return Eigen::Map<const Eigen::VectorXd>(x.data(), x.size()); }
  Positions columns(const Eigen::VectorXd& x) const { return Eigen::Map<const Positions>(x.data(), 3, x.size() / 3); }

  /// Lengths of the routes that agents get alone, pulled tight from their shortest ways.
  void measure_alone() {
    const RouteChains chains = sample_chains(plan_, shortest_ways_, options_.spacing, true);
    RouteEnergy energy(chains, triangles_);
    Eigen::VectorXd x = flat(chains.x);
    minimise(energy, x, alone_steps, chains.least_radius);
    for (const Route& route : chains.routes(columns(x))) {
      double length = 0;
      for (std::size_t k = 0; k + 1 < route.points.size(); ++k)
        length += (vec(route.points[k + 1]) - vec(route.points[k])).norm();
      made_.alone_length.push_back(length);
    }
  }

  /// Whether agents may all move evenly all the time.
  bool is_even_pace_allowed() const {
    return std::all_of(plan_.agents.begin(), plan_.agents.end(),
                       [](const RouteAgent& agent) {
                         return agent.window == RouteAgent().window && agent.speed == RouteAgent().speed;
                       }) &&
           std::all_of(plan_.obstacles.begin(), plan_.obstacles.end(),
                       [](const RouteObstacle& obstacle) { return obstacle.motion.empty(); });
  }

  /// First all at an even pace, where the plan lets them; then from ways that a search in time finds.
  void run_in_time() {
    const double share = 1.0 / (1 + search_paces.size());
    if (is_even_pace_allowed()) part(pushed_aside[0], 0, share, 1);
    for (std::size_t k = 0; k < search_paces.size() && !control_.stopped() && !is_found(); ++k)
      search_and_smooth(static_cast<int>(k), share * (1 + k), share);
    if (made_.routes.empty() && failed_ >= 0 && !control_.stopped())
      made_.messages.push_back(
          fmt::format("no way in time was found for '{}' past the other agents; more time, other windows or priorities "
                      "may help",
                      plan_.agents[failed_].name));
  }

  void search_and_smooth(int attempt, double before, double share) {
    control_.tell(before, "search in time");
    if (made_.alone_length.empty()) measure_alone();
    TimeSearchSettings settings;
    settings.cell = search_cells[attempt];
    settings.stopped = [&] { return control_.stopped(); };
    double needed = 0;  // by the agent that has to be fastest
    for (std::size_t i = 0; i < plan_.agents.size(); ++i) {
      const std::array<double, 2>& window = plan_.agents[i].window;
      needed = std::max(needed, made_.alone_length[i] / (std::min(window[1], plan_.duration) - window[0]));
    }
    double steps = 1;
    for (const RouteAgent& agent : plan_.agents) {
      // A limit far beyond what is needed counts as none: steps that short would be too many.
      const double limit = search_speed * agent.speed;
      const double speed = limit < search_paces.back() * needed ? limit : search_paces[attempt] * needed;
      settings.stride.push_back(speed * plan_.duration);
      steps = std::max(steps, settings.stride.back() / (options_.spacing * agent.radius));
    }
    settings.steps = static_cast<Index>(std::ceil(std::min(steps, most_time_steps)));
    for (double& stride : settings.stride) stride /= settings.steps;
    const std::vector<MovingObstacle> moving = moving_obstacles(plan_, settings.steps);
    const std::vector<TimedWay> start = search_in_time(plan_, triangles_, moving, settings, failed_);
    if (!start.empty()) smooth(chains_in_time(plan_, start), settings.steps, moving, before, share);
  }

  /// From ways in time that keep all distances to routes without turns that are too tight; distances are kept on the
  /// way.
  void smooth(RouteChains chains, Index steps, const std::vector<MovingObstacle>& moving, double before, double share) {
    const auto tell = [&](double fraction, std::string_view phase) { control_.tell(before + fraction * share, phase); };
    Eigen::VectorXd x = flat(chains.x);
    RouteEnergySettings settings;
    settings.strict = true;
    settings.contact = barrier_weights[0];
    double parting = barrier_weights[0];
    bool is_round = false;
    for (int round = 0; round < most_rounds && !control_.stopped() && !is_round; ++round) {
      tell(swelling_share + parting_share * round / most_rounds, "smooth");
      RouteEnergy energy(chains, triangles_, moving);
      energy.settings = settings;
      if (!is_finite(energy, x)) {  // agents that were made to stop are in the way of others
        energy.settings.strict = false;
        energy.settings.contact = parting *= harder;
      }
      minimise(energy, x, parting_steps, chains.least_radius);
      energy.settings.strict = true;
      is_round = energy.margins(x).turn <= 1 - margin && is_finite(energy, x);
      if (is_round) break;
      if (round >= rounds_without_stops) stop_at_tight_turns(chains, x, moving, settings);
      settings.turn *= harder;
    }
    settings.strict_turns = true;
    for (const double weight : barrier_weights) {
      if (!is_round) break;
      tell(tightening_from, "tighten");
      RouteEnergy energy(chains, triangles_, moving);
      energy.settings = settings;
      energy.settings.contact = energy.settings.turn = weight;
      minimise(energy, x, tightening_steps, chains.least_radius);
    }
    tell(certifying_from, "certify");
    const RouteChains asked = sample_chains(plan_, ways_, options_.spacing, true);
    std::vector<Route> routes = chains.routes(columns(x));
    for (Route& route : routes) route.points.resize(static_cast<std::size_t>(steps) + 1, route.points.back());
    keep(std::move(routes), asked.routes(asked.x));
  }

  /// Agents stand for a step where a turn stays too tight. The step is taken from the next place where they stand, or
  /// from the one before; in between they pass each point a step later or earlier. Not where an obstacle is in
  /// the way then.
  void stop_at_tight_turns(RouteChains& chains, Eigen::VectorXd& x, const std::vector<MovingObstacle>& moving,
                           const RouteEnergySettings& settings) {
    const std::vector<RouteChains::Chain> all = chains.chains;
    for (const RouteChains::Chain& chain : all)
      for (Index v = chain.first + 1; v < chain.last() && !control_.stopped(); ++v) {
        if (chains.stands(v) || turn_of_vertex(x, v, chain.radius) <= 1 - margin) continue;
        for (const Index step : {1, -1}) {
          RouteChains stopped = chains;
          stopped.x = columns(x);
          if (!insert_stop(stopped, chain, v, step)) continue;
          RouteEnergy energy(stopped, triangles_, moving);
          energy.settings = settings;
          energy.settings.strict = false;
          const Eigen::VectorXd moved = flat(stopped.x);
          if (!is_finite(energy, moved)) continue;
          chains = std::move(stopped);
          x = moved;
          break;
        }
      }
  }
  /// Keeps routes that are better than those found before.
  void keep(std::vector<Route> routes, std::vector<Route> asked) {
    RouteFindings found = check_routes(plan_, routes);
    if (!made_.found.length.empty() && !found.hold() && !(found.clearance > made_.found.clearance)) return;
    made_.routes = std::move(routes);
    made_.asked = std::move(asked);
    made_.found = std::move(found);
  }

  /// One try; `before`: part of all work that is done; `share`: of all work, this try's; `longer`: factor of the steps
  /// it may take.
  void part(double by, double before, double share, int longer) {
    const auto tell = [&](double fraction, std::string_view phase) { control_.tell(before + fraction * share, phase); };
    RouteChains chains = sample_chains(plan_, ways_, options_.spacing, true);
    if (made_.alone_length.empty()) measure_alone();
    Eigen::VectorXd x = flat(aside(chains, by));
    {
      RouteEnergy energy(chains, triangles_);
      energy.settings.contact = first_weight;
      for (const double part : swelling) {
        tell(swelling_share * part, "swell");
        energy.settings.swelling = part;
        energy.forget_neighbours();
        minimise(energy, x, longer * swelling_steps, chains.least_radius);
      }
    }
    // Routes have become longer, so their vertices are spread evenly again, unless obstacles forbid the new corners.
    // With timed routes that would change where agents are at which time.
    const std::vector<Legs> legs = chains.legs(columns(x));
    RouteChains even = sample_chains(plan_, legs, options_.spacing, false);
    RouteEnergy probe(even, triangles_);
    Eigen::VectorXd even_x = flat(even.x), gradient;
    if (!plan_.timed && probe(even_x, gradient) < std::numeric_limits<double>::infinity()) {
      chains = std::move(even);
      x = even_x;
    } else {
      chains.x = columns(x);
    }
    RouteEnergy energy(chains, triangles_);
    energy.settings.contact = first_weight;
    const auto is_apart = [&] {
      const RouteMargins margins = energy.margins(x);
      return margins.contact >= 1 + margin && margins.turn <= 1 - margin;
    };
    for (int round = 0; round < most_rounds && !control_.stopped(); ++round) {
      tell(swelling_share + parting_share * round / most_rounds, "part");
      minimise(energy, x, longer * parting_steps, chains.least_radius);
      if (is_apart()) break;
      energy.settings.contact *= harder;
      energy.settings.turn *= harder;
    }
    if (is_apart()) {
      energy.settings.strict = energy.settings.strict_turns = true;
      for (const double weight : barrier_weights) {
        tell(tightening_from, "tighten");
        energy.settings.contact = energy.settings.turn = weight;
        minimise(energy, x, tightening_steps, chains.least_radius);
      }
    }
    tell(certifying_from, "certify");
    keep(chains.routes(columns(x)), sampled_alike(chains, ways_));
  }

  const RoutePlan& plan_;
  const RouteOptions& options_;
  RunControl control_;
  ObstacleTriangles triangles_;
  std::vector<Legs> shortest_ways_, ways_;
  RoutesResult made_;
  int failed_ = -1;  // the agent for which the last search in time found no way
};

}  // namespace

double RoutesResult::mean_alone_ratio() const {
  double sum = 0;
  for (std::size_t i = 0; i < alone_length.size(); ++i) sum += found.length[i] / alone_length[i];
  return alone_length.empty() ? 1 : sum / static_cast<double>(alone_length.size());
}

RoutesResult plan_routes(const RoutePlan& plan, const RouteOptions& options, Context* context) {
  check_plan(plan);
  if (!(options.spacing > 0 && options.spacing <= 2))
    throw std::invalid_argument(fmt::format("spacing is {}; give a number above 0, 2 at most", options.spacing));
  if (!(options.time_limit_s >= 0)) throw std::invalid_argument("time_limit_s is below 0");
  return Planning(plan, options, context).run();
}

}  // namespace unsnarl
