#include "applications/knots/relax_knot.h"

#include <cmath>
#include <optional>

#include "applications/knots/knot_energy.h"
#include "applications/knots/moving_polygon.h"
#include "applications/knots/strip.h"
#include "optimize/lbfgs.h"

namespace unsnarl {
namespace {

double length_of(const Positions& x) {
  double sum = 0;
  for (Index k = 0; k < x.cols(); ++k) sum += (x.col((k + 1) % x.cols()) - x.col(k)).norm();
  return sum;
}

/// About its centre. The energy has no opinion on the size.
Positions of_length(const Positions& x, double length) {
  const Vec3 centre = x.rowwise().mean();
  return (length / length_of(x) * (x.colwise() - centre)).colwise() + centre;
}

using VectorMap = Eigen::Map<const Eigen::VectorXd>;

VectorMap as_vector(const Positions& x) {
  return {x.data(), x.size()};
}

/// Armijo's condition: the decrease is at least this share of what the slope promises (no unit)
constexpr double armijo = 1e-4;
/// Shorter steps end the search: rounding is all that is left of a decrease (no unit)
constexpr double shortest = 1e-9;
constexpr int memory = 8;  ///< Steps that L-BFGS keeps (unit: steps)

}  // namespace

bool is_proven_way(const Positions& from, const Positions& to) {
  return stays_simple(from, to) && is_isotopy(from, to);
}

RelaxedKnot relax_knot(Positions x, const RelaxOptions& options, const std::function<bool()>& stop) {
  const KnotEnergy energy;
  const double length = length_of(x);
  RelaxedKnot made;
  made.states.push_back(x);
  Positions gradient;
  made.energy = energy(x, gradient);
  std::optional<KnotMetric> metric;
  Lbfgs lbfgs(memory, [&](const Eigen::VectorXd& v, Eigen::VectorXd& out) {
    out = as_vector(metric->solve(Eigen::Map<const Positions>(v.data(), 3, v.size() / 3)));
  });
  Eigen::VectorXd d;
  double step = 1;
  for (int k = 0; k < options.most_steps && !stop(); ++k) {
    metric.emplace(x, energy.evenness);
    const double steepness = gradient.cwiseProduct(metric->solve(gradient)).sum();
    made.at_rest = steepness <= options.gradient_rel * options.gradient_rel * made.energy;
    if (made.at_rest || !std::isfinite(steepness)) break;
    lbfgs.direction(as_vector(gradient), d);
    const Eigen::Map<const Positions> direction(d.data(), 3, x.cols());
    const double slope = gradient.cwiseProduct(direction).sum();
    Positions next;
    for (step = std::min(2 * step, 1.0); step >= shortest; step *= 0.5) {
      next = of_length(x + step * direction, length);
      if (energy(next) <= made.energy + armijo * step * slope && is_proven_way(x, next)) break;
    }
    if (step < shortest) break;
    const Positions before = gradient, moved = next - x;
    x = next;
    made.states.push_back(x);
    made.energy = energy(x, gradient);
    lbfgs.remember(as_vector(moved), as_vector(gradient - before));
  }
  return made;
}

}  // namespace unsnarl
