#include "optimize/lbfgs.h"

#include <algorithm>
#include <vector>

namespace unsnarl {
namespace {

/// A step is not remembered where s.y is below this share of |s||y|: that is rounding or negative curvature, useless as
/// a metric (no unit)
constexpr double least_curvature = 1e-12;
/// Memory is dropped where the cosine between -gradient and the direction, in the plain inner product, is below this
/// (no unit)
constexpr double least_descent = 1e-14;

}  // namespace

void Lbfgs::remember(const Eigen::VectorXd& step, const Eigen::VectorXd& gradient_change) {
  const double curvature = step.dot(gradient_change);
  if (!(curvature > least_curvature * step.norm() * gradient_change.norm())) {
    clear();
    return;
  }
  if (size() == memory_) steps_.pop_front();
  steps_.push_back({step, gradient_change, 1 / curvature});
}

void Lbfgs::direction(const Eigen::VectorXd& gradient, Eigen::VectorXd& d) {
  Eigen::VectorXd q = gradient;
  std::vector<double> alpha(steps_.size());
  for (int k = size() - 1; k >= 0; --k) {
    alpha[k] = steps_[k].inverse_curvature * steps_[k].s.dot(q);
    q -= alpha[k] * steps_[k].y;
  }
  if (metric_) {
    metric_(q, d);
  } else {
    d = steps_.empty() ? q : Eigen::VectorXd(q / (steps_.back().inverse_curvature * steps_.back().y.squaredNorm()));
  }
  for (int k = 0; k < size(); ++k) {
    const double beta = steps_[k].inverse_curvature * steps_[k].y.dot(d);
    d += (alpha[k] - beta) * steps_[k].s;
  }
  d = -d;
  if (!steps_.empty() && !(gradient.dot(d) < -least_descent * gradient.norm() * d.norm())) {
    clear();
    direction(gradient, d);
  }
}

LbfgsResult minimize_lbfgs(const Objective& objective, Eigen::VectorXd& x, const LbfgsOptions& options,
                           const Lbfgs::Metric& metric, const std::function<bool(LbfgsIteration&)>& callback) {
  LbfgsResult result;
  Lbfgs lbfgs(options.memory, metric);
  Eigen::VectorXd gradient(x.size()), d(x.size());
  double value = objective(x, gradient);
  ++result.evaluations;
  for (;; ++result.iterations) {
    result.value = value;
    if (callback) {
      LbfgsIteration state{result.iterations, value, x};
      if (callback(state)) {
        result.status = LbfgsStatus::stopped;
        return result;
      }
      if (state.forget) lbfgs.clear();
      if (state.objective_changed) {
        value = objective(x, gradient);
        ++result.evaluations;
      }
    }
    if (gradient.norm() <= options.gradient_tolerance) {
      result.status = LbfgsStatus::converged;
      return result;
    }
    if (result.iterations >= options.max_iterations) return result;
    const Eigen::VectorXd old_x = x, old_gradient = gradient;
    bool moved = false;
    while (!moved) {
      const bool steepest = lbfgs.size() == 0;
      lbfgs.direction(gradient, d);
      LineSearchOptions search = options.line_search;
      const double fastest = largest_block_norm(d, options.block);
      if (fastest * search.first_step > options.max_motion) search.first_step = options.max_motion / fastest;
      const LineSearchResult found = backtrack(objective, d, search, x, value, gradient);
      result.evaluations += found.evaluations;
      moved = found.step > 0;
      if (moved && !found.sufficient)
        lbfgs.clear();
      else if (moved)
        lbfgs.remember(x - old_x, gradient - old_gradient);
      if (!moved && steepest) {
        result.status = LbfgsStatus::no_step;
        return result;
      }
      if (!moved) lbfgs.clear();
    }
  }
}

}  // namespace unsnarl
