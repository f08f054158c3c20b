#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "applications/routes/route_energy.h"
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
    for (std::size_t k = 0; k < pushed_aside.size() && !control_.stopped(); ++k) {
      part(pushed_aside[k], static_cast<double>(k) / pushed_aside.size(), 1 << k);
      if (made_.found.hold()) return ended(Status::embedded);
    }
    return ended(control_.stopped() ? control_.status_or(Status::no_progress) : Status::no_progress);
  }

 private:
  RoutesResult ended(Status status) {
    made_.status = status;
    made_.seconds = control_.seconds();
    return std::move(made_);
  }
  /// Ways straight or past the obstacles; spread: later agents avoid the ways of earlier ones.
  std::vector<Legs> ways(std::optional<WayFinder>& finder, bool spread) {
    double widest = 0;
    for (const RouteAgent& agent : plan_.agents) widest = std::max(widest, agent.radius);
    std::vector<Legs> found;
    for (const RouteAgent& agent : plan_.agents) {
      Legs& legs = found.emplace_back();
      const std::vector<Vec3> places = places_of(agent);
      for (std::size_t k = 0; k + 1 < places.size() && !control_.stopped(); ++k) {
        std::optional<std::vector<Vec3>> way;
        if (!finder) way = {places[k], places[k + 1]};
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
        if (spread) finder->avoid(*way, agent.radius + widest);
        legs.push_back(std::move(*way));
      }
    }
    return found;
  }

  bool find_ways() {
    control_.tell(0, "find ways");
    std::optional<WayFinder> finder;
    if (!triangles_.empty()) finder.emplace(plan_, triangles_);
    shortest_ways_ = ways(finder, false);
    if (!made_.messages.empty()) return false;
    ways_ = finder && !plan_.timed ? ways(finder, true) : shortest_ways_;
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
        const Vec3 e = along.unitOrthogonal(), f = along.cross(e);
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

  /// One try; `before`: part of all work that is done; `longer`: factor of the steps it may take.
  void part(double by, double before, int longer) {
    const auto tell = [&](double fraction, std::string_view phase) {
      control_.tell(before + fraction / pushed_aside.size(), phase);
    };
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
      energy.settings.strict = true;
      for (const double weight : barrier_weights) {
        tell(tightening_from, "tighten");
        energy.settings.contact = energy.settings.turn = weight;
        minimise(energy, x, tightening_steps, chains.least_radius);
      }
    }
    tell(certifying_from, "certify");
    const std::vector<Route> routes = chains.routes(columns(x));
    RouteFindings found = check_routes(plan_, routes);
    if (made_.found.length.empty() || found.hold() || found.clearance > made_.found.clearance) {
      made_.routes = routes;
      made_.asked = sampled_alike(chains, ways_);
      made_.found = std::move(found);
    }
  }

  const RoutePlan& plan_;
  const RouteOptions& options_;
  RunControl control_;
  ObstacleTriangles triangles_;
  std::vector<Legs> shortest_ways_, ways_;
  RoutesResult made_;
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
