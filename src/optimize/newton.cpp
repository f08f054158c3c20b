#include "optimize/newton.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "geometry/fit.h"

namespace unsnarl {
namespace {

enum class Search { accepted, none, blocked };

/// Backtracking along the step from a point of this value, with every trial filtered. Sets `fall` on acceptance: by how
/// much the value is smaller now.
Search search_line(NewtonProblem& problem, const NewtonOptions& options, const Eigen::Matrix3Xd& gradient,
                   const Eigen::Matrix3Xd& step, double value, double& fall) {
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
      fall = value - next;
      problem.accept(trial);
      return Search::accepted;
    }
  }
  return Search::none;
}

/// The Newton step. False: the matrix is not positive definite as it is rounded, and there is no step.
bool solve_directly(const Eigen::SparseMatrix<double>& lower_triangle, const Eigen::Matrix3Xd& gradient,
                    Eigen::Matrix3Xd& step) {
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(lower_triangle);
  if (factors.info() != Eigen::Success || !(factors.vectorD().minCoeff() > 0)) return false;
  fit(step, 3, static_cast<Index>(gradient.cols()));
  step.reshaped() = -factors.solve(gradient.reshaped());
  return true;
}

/// Whether the last steps lowered the value by less than the wanted share. `falls`: of all steps; `value`: now.
bool hardly_falls(std::span<const double> falls, double value, const NewtonOptions& options) {
  const std::size_t window = static_cast<std::size_t>(options.window);
  if (falls.size() < window) return false;
  const double all = std::accumulate(falls.begin(), falls.end(), 0.0);
  const auto last = falls.last(window);
  return std::accumulate(last.begin(), last.end(), 0.0) < options.decrease * (value + all);
}

}  // namespace

NewtonResult minimise_newton(NewtonProblem& problem, const NewtonOptions& options, const std::function<bool()>& stop) {
  NewtonResult result;
  Eigen::Matrix3Xd gradient, step;
  std::vector<Eigen::Matrix3d> blocks;
  BlockJacobiPcg pcg;
  std::vector<double> falls;
  double value = problem.linearise(gradient);
  while (result.iterations < options.max_steps) {
    if (stop && (result.stopped = stop())) break;
    if (!options.direct_solver || !solve_directly(problem.lower_triangle(), gradient, step)) {
      problem.inverse_blocks(blocks);
      result.solver_iterations += pcg.solve([&](const auto& v, auto& out) { problem.apply_hessian(v, out); }, blocks,
                                            -gradient, step, options.solver);
    }
    ++result.iterations;
    const double longest = std::sqrt(step.colwise().squaredNorm().maxCoeff());
    if (!(longest > 0) || !(gradient.cwiseProduct(step).sum() < 0)) break;

    problem.limit(step);
    double fall = 0;
    const Search found = search_line(problem, options, gradient, step, value, fall);
    if (found == Search::none) break;
    if (found == Search::blocked) {
      if (!problem.remove_blocked()) break;
      falls.clear();
      value = problem.linearise(gradient);
      continue;
    }
    falls.push_back(fall);
    value = problem.linearise(gradient);
    if (longest < options.motion || hardly_falls(falls, value, options)) break;
  }
  return result;
}

}  // namespace unsnarl
