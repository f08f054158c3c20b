#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <functional>
#include <limits>
#include <vector>

#include "optimize/block_jacobi_pcg.h"

namespace unsnarl {

/// A function of 3-vectors at its current point, as Newton's method sees it. A step has one column an unknown.
class NewtonProblem {
 public:
  virtual ~NewtonProblem() = default;

  /// Number of unknowns that move now.
  virtual Index unknowns() const = 0;
  /// The value at the current point. Sets the gradient; the calls of the next two refer to the Hessian there.
  virtual double linearise(Eigen::Matrix3Xd& gradient) = 0;
  virtual void apply_hessian(const Eigen::Matrix3Xd& v, Eigen::Matrix3Xd& result) const = 0;
  /// Inverses of the Hessian's 3 x 3 blocks on the diagonal.
  virtual void inverse_blocks(std::vector<Eigen::Matrix3d>& blocks) const = 0;
  /// The Hessian's lower triangle, three rows an unknown.
  virtual Eigen::SparseMatrix<double> lower_triangle() const = 0;

  /// Shortens a Newton step to where the model can be trusted, before the line search. May add terms to the function
  /// that matter along the step, so that its value at the current point grows.
  virtual void limit(Eigen::Matrix3Xd& step) = 0;
  /// Shortens a trial step, unknown by unknown, to what the constraints allow.
  virtual void filter(Eigen::Matrix3Xd& step) = 0;
  /// The value at the current point plus a step; infinite where a constraint is violated.
  virtual double value(const Eigen::Matrix3Xd& step) = 0;
  virtual void accept(const Eigen::Matrix3Xd& step) = 0;
  /// Called after an infinite value: removes the unknowns that cannot move, and the problem starts again from the
  /// current point. Returns false if there are none.
  virtual bool remove_blocked() = 0;
};

struct NewtonOptions {
  int max_steps = 100;  ///< Newton steps of one call, at most (unit: steps)
  /// Armijo's condition (paper §3.5.1): the decrease is at least this share of what the slope promises (no unit)
  double sufficient_decrease = 1e-4;
  int max_halvings = 40;  ///< The line search halves a step this many times at most (unit: halvings)
  PcgOptions solver;
  /// Steps are solved by a sparse LDL^T factorisation, and by conjugate gradients where the Hessian, as it is rounded,
  /// is not positive definite.
  bool direct_solver = false;
  /// Ends when in `window` steps the value fell by less than this share of what it was at the start, without what
  /// unknowns that do not move any more have in it (no unit)
  double decrease = 0;
  int window = 1;     ///< Steps over which the decrease of the value is measured (unit: steps)
  double motion = 0;  ///< Ends when a Newton step moves no unknown farther (unit: length)
};

struct NewtonResult {
  int iterations = 0;
  int solver_iterations = 0;
  bool stopped = false;  ///< by the caller
};

/// Minimises from the current point of the problem: Newton steps by preconditioned conjugate gradients or a direct
/// solver, each shortened by limit(), then by halving until the filtered step satisfies Armijo's condition. Never
/// accepts a point with a larger value than the one before. `stop` is asked once a step.
NewtonResult minimise_newton(NewtonProblem& problem, const NewtonOptions& options,
                             const std::function<bool()>& stop = {});

}  // namespace unsnarl
