#include "optimize/newton.h"

#include <algorithm>
#include <cmath>

namespace unsnarl {
namespace {

/// Sets the columns that are marked (or those that are not) to zero.
void clear(Eigen::Matrix3Xd& v, const std::vector<std::uint8_t>& marks, bool marked) {
  for (Index i = 0; i < v.cols(); ++i)
    if ((marks[i] != 0) == marked) v.col(i).setZero();
}

/// Solves for Newton steps. Keeps its workspace.
class StepSolver {
 public:
  /// Solves for the step at the current point. Returns the number of iterations.
  int solve(NewtonProblem& problem, const NewtonOptions& options, const Eigen::Matrix3Xd& gradient,
            Eigen::Matrix3Xd& step) {
    problem.inverse_blocks(options.scalar_jacobi, blocks_);
    int iterations = pcg_.solve([&](const auto& v, auto& out) { problem.apply_hessian(v, out); }, blocks_, -gradient,
                                step, options.solver);
    is_prescribed_.assign(static_cast<std::size_t>(step.cols()), 0);
    for (int round = 0; round < options.prescribed_rounds && problem.prescribe(step, is_prescribed_); ++round)
      iterations += solve_others(problem, options.solver, gradient, step);
    return iterations;
  }

 private:
  /// Solves for the unknowns that are not prescribed.
  int solve_others(const NewtonProblem& problem, const PcgOptions& options, const Eigen::Matrix3Xd& gradient,
                   Eigen::Matrix3Xd& step) {
    clear(step, is_prescribed_, false);
    right_side_.resize(3, step.cols());
    problem.apply_hessian(step, right_side_);
    right_side_ = -gradient - right_side_;
    clear(right_side_, is_prescribed_, true);
    const auto apply = [&](const Eigen::Matrix3Xd& v, Eigen::Matrix3Xd& out) {
      problem.apply_hessian(v, out);
      clear(out, is_prescribed_, true);
    };
    const int iterations = pcg_.solve(apply, blocks_, right_side_, others_, options);
    step += others_;
    return iterations;
  }

  BlockJacobiPcg pcg_;
  std::vector<Eigen::Matrix3d> blocks_;
  std::vector<std::uint8_t> is_prescribed_;
  Eigen::Matrix3Xd right_side_, others_;
};

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
  StepSolver solver;
  std::vector<double> values = {problem.linearise(gradient)};
  while (result.iterations < options.max_steps) {
    if (stop && (result.stopped = stop())) break;
    result.solver_iterations += solver.solve(problem, options, gradient, step);
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
