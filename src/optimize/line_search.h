#pragma once

#include <Eigen/Core>
#include <functional>

namespace unsnarl {

/// Returns f(x) and overwrites `gradient` (same size as x) with its gradient.
using Objective = std::function<double(const Eigen::VectorXd& x, Eigen::VectorXd& gradient)>;

struct LineSearchOptions {
  /// Armijo's beta_0 (paper §3.5.1): the decrease is at least this share of what the slope promises (no unit)
  double sufficient_decrease = 1e-4;
  double shrink = 0.5;    ///< A trial's step is this share of the one before (no unit)
  double first_step = 1;  ///< Factor alpha of the direction in the first trial (no unit)
  /// The search ends below this alpha, without a step (paper §3.5.1) (no unit)
  double smallest_step = 1e-10;
  /// For objectives that are not smooth: the search ends below this alpha too, but *takes* that step. 0: never.
  double accept_step = 0;
  /// Asked before each trial but the first; true ends the search without a step.
  std::function<bool()> stop;
};

struct LineSearchResult {
  double step = 0;          ///< alpha taken; 0: none, x is unchanged
  bool sufficient = false;  ///< Armijo's condition holds
  int evaluations = 0;
};

/// Backtracking from x along `direction`. On success x, value and gradient are those of the new point; else unchanged.
LineSearchResult backtrack(const Objective& objective, const Eigen::VectorXd& direction,
                           const LineSearchOptions& options, Eigen::VectorXd& x, double& value,
                           Eigen::VectorXd& gradient);

/// The largest Euclidean norm among consecutive blocks of `block` entries: how far the fastest vertex moves.
double largest_block_norm(const Eigen::VectorXd& v, int block);

}  // namespace unsnarl
