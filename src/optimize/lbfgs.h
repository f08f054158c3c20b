#pragma once

#include <Eigen/Core>
#include <deque>
#include <functional>
#include <limits>

#include "optimize/line_search.h"

namespace unsnarl {

/// Limited-memory BFGS directions (Liu and Nocedal 1989). Keeps the last few steps; what to do with a direction is the
/// caller's choice (see minimize_lbfgs for the usual one).
class Lbfgs {
 public:
  /// Applies an approximation of the inverse Hessian, symmetric positive definite: out = H0 v.
  using Metric = std::function<void(const Eigen::VectorXd& v, Eigen::VectorXd& out)>;

  /// Steps that are kept unless the caller says otherwise (unit: steps)
  static constexpr int default_memory = 8;

  /// Without a metric, H0 is the identity scaled by s.y / y.y of the latest step.
  explicit Lbfgs(int memory = default_memory, Metric metric = {}) : memory_(memory), metric_(std::move(metric)) {}

  /// d = -H gradient. Falls back to d = -H0 gradient, and forgets all steps, where that is not a descent direction.
  void direction(const Eigen::VectorXd& gradient, Eigen::VectorXd& d);
  /// The step that was taken and the change of the gradient along it. A step without positive curvature is not
  /// remembered, and older ones are forgotten: without a Wolfe condition they would keep steps short for many
  /// iterations.
  void remember(const Eigen::VectorXd& step, const Eigen::VectorXd& gradient_change);
  void clear() { steps_.clear(); }
  int size() const { return static_cast<int>(steps_.size()); }

 private:
  struct Step {
    Eigen::VectorXd s, y;
    double inverse_curvature;  // 1 / s.y
  };
  int memory_;
  Metric metric_;
  std::deque<Step> steps_;
};

struct LbfgsOptions {
  int memory = 8;                 ///< Steps that are kept (unit: steps)
  int max_iterations = 1000;      ///< Iterations of one call, at most (unit: iterations)
  double gradient_tolerance = 0;  ///< stop when |gradient| is no larger
  LineSearchOptions line_search;
  /// Entries of x that belong together and move by max_motion at most, such as one vertex (unit: entries)
  int block = 3;
  /// Length: no block moves farther in one step. Infinite: no cap.
  double max_motion = std::numeric_limits<double>::infinity();
};

enum class LbfgsStatus { converged, stopped, max_iterations, no_step };

struct LbfgsResult {
  LbfgsStatus status = LbfgsStatus::max_iterations;
  int iterations = 0;
  int evaluations = 0;
  double value = 0;
};

/// What the callback sees after every step. If it changes the objective, it sets `objective_changed`, and value and
/// gradient are evaluated again. `forget` drops the remembered steps.
struct LbfgsIteration {
  int iteration = 0;
  double value = 0;
  const Eigen::VectorXd& x;
  bool objective_changed = false;
  bool forget = false;
};

/// Minimises from x, in place. `callback` (optional) returns true to stop; it is first called before the first step, as
/// iteration 0. When no step can be found, the memory is cleared once before giving up.
LbfgsResult minimize_lbfgs(const Objective& objective, Eigen::VectorXd& x, const LbfgsOptions& options = {},
                           const Lbfgs::Metric& metric = {}, const std::function<bool(LbfgsIteration&)>& callback = {});

}  // namespace unsnarl
