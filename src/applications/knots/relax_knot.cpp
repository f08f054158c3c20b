#include "applications/knots/relax_knot.h"

#include <cmath>

#include "applications/knots/knot_energy.h"
#include "applications/knots/moving_polygon.h"
#include "applications/knots/strip.h"

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

constexpr double armijo = 1e-4;    // part of the decrease that the slope promises, as usual
constexpr double longest = 64;     // factor of the gradient; between 1 and 4 in most steps
constexpr double shortest = 1e-9;  // where rounding is all that is left of a decrease

}  // namespace

bool is_proven_way(const Positions& from, const Positions& to) {
  return stays_simple(from, to) && is_isotopy(from, to);
}

RelaxedKnot relax_knot(Positions x, const RelaxOptions& options, const std::function<bool(double energy)>& stop) {
  const KnotEnergy energy;
  RelaxedKnot made;
  const double length = length_of(x);
  made.states.push_back(x);
  Positions gradient;
  made.energy = energy(x, gradient);
  double step = 1;
  for (int k = 0; k < options.most_steps && !stop(made.energy); ++k) {
    const Positions direction = KnotMetric(x, energy.evenness).solve(gradient);
    const double slope = gradient.cwiseProduct(direction).sum();
    if (!(slope >= 0)) break;
    if (slope <= options.gradient_rel * options.gradient_rel * made.energy) {
      made.at_rest = true;
      break;
    }
    Positions next;
    double value = 0;
    for (step = std::min(2 * step, longest); step >= shortest; step *= 0.5) {
      next = of_length(x - step * direction, length);
      value = energy(next);
      if (value <= made.energy - armijo * step * slope && is_proven_way(x, next)) break;
    }
    if (step < shortest) break;
    x = next;
    made.states.push_back(x);
    made.energy = energy(x, gradient);
  }
  return made;
}

}  // namespace unsnarl
