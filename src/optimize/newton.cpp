#include "optimize/newton.h"

#include <algorithm>
#include <cmath>

namespace unsnarl {
namespace {

enum class Search { accepted, none, blocked };

/// Backtracking along the step, with every trial filtered. On acceptance `value` is that of the new point.
Search search_line(NewtonProblem& problem, const NewtonOptions& options, const Eigen::Matrix3Xd& gradient,
                   const Eigen::Matrix3Xd& step, double& value) {
  Eigen::Matrix3Xd trial;
  double alpha = 1;
  for (int halving = 0; halving < options.max_halvings; ++halving, alpha *= 0.5) {
    trial = alpha * step;
    problem.filter(trial);
    const double slope = gradient.cwiseProduct(trial).sum();
    const double next = problem.value(trial);
    if (!std::isfinite(next)) return Search::blocked;
    const auto decreases = [&] { return slope < 0 && next <= value + options.sufficient_decrease * slope; };
    // limit() may have changed the function.
    if (halving == 0 && !decreases()) value = problem.value(Eigen::Matrix3Xd::Zero(3, step.cols()));
    if (decreases()) {
      problem.accept(trial);
      return Search::accepted;
    }
  }
  return Search::none;
}

}  // namespace

NewtonResult minimise_newton(NewtonProblem& problem, const NewtonOptions& options, const std::function<bool()>& stop) {
  NewtonResult result;
  Eigen::Matrix3Xd gradient, step;
  std::vector<Eigen::Matrix3d> blocks;
  BlockJacobiPcg pcg;
  std::vector<double> values = {problem.linearise(gradient)};
  while (result.iterations < options.max_steps) {
    if (stop && (result.stopped = stop())) break;
    problem.inverse_blocks(options.scalar_jacobi, blocks);
    result.solver_iterations += pcg.solve([&](const auto& v, auto& out) { problem.apply_hessian(v, out); }, blocks,
                                          -gradient, step, options.solver);
    ++result.iterations;
    const double longest = std::sqrt(step.colwise().squaredNorm().maxCoeff());
    if (!(longest > 0) || !(gradient.cwiseProduct(step).sum() < 0)) break;

    problem.limit(step);
    double value = values.back();
    const Search found = search_line(problem, options, gradient, step, value);
    if (found == Search::none) break;
    if (found == Search::blocked) {
      if (!problem.remove_blocked()) break;
      values = {problem.linearise(gradient)};
      continue;
    }
    values.push_back(problem.linearise(gradient));
    if (longest < options.motion) break;
    const std::size_t window = static_cast<std::size_t>(options.window);
    if (values.size() > window) {
      const double before = values[values.size() - 1 - window], now = values.back();
      if (before - now < options.decrease * now) break;
    }
  }
  return result;
}

}  // namespace unsnarl
