#include "optimize/line_search.h"

#include <algorithm>
#include <cmath>

namespace unsnarl {

LineSearchResult backtrack(const Objective& objective, const Eigen::VectorXd& direction,
                           const LineSearchOptions& options, Eigen::VectorXd& x, double& value,
                           Eigen::VectorXd& gradient) {
  LineSearchResult result;
  const double slope = gradient.dot(direction);
  Eigen::VectorXd trial(x.size()), trial_gradient(x.size());
  for (double step = options.first_step; step >= options.smallest_step; step *= options.shrink) {
    if (result.evaluations > 0 && options.stop && options.stop()) break;
    trial = x + step * direction;
    const double trial_value = objective(trial, trial_gradient);
    ++result.evaluations;
    if (!std::isfinite(trial_value)) continue;
    result.sufficient = trial_value <= value + options.sufficient_decrease * step * slope;
    if (result.sufficient || step * options.shrink < options.accept_step) {
      result.step = step;
      x.swap(trial);
      gradient.swap(trial_gradient);
      value = trial_value;
      return result;
    }
  }
  return result;
}

double largest_block_norm(const Eigen::VectorXd& v, int block) {
  double largest = 0;
  for (Eigen::Index i = 0; i + block <= v.size(); i += block) {
    largest = std::max(largest, v.segment(i, block).squaredNorm());
  }
  return std::sqrt(largest);
}

}  // namespace unsnarl
