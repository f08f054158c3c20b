#pragma once

#include <Eigen/Core>
#include <cmath>
#include <span>
#include <vector>

namespace unsnarl {

struct PcgOptions {
  double relative_tolerance = 1e-2;  ///< of the preconditioned residual, against the right-hand side's
  int max_iterations = 200;
};

/// Conjugate gradients for symmetric positive definite systems over 3-vectors, preconditioned by the inverses of the
/// 3 x 3 blocks on the diagonal (of their diagonals only: the classical Jacobi preconditioner). Keeps its workspace.
class BlockJacobiPcg {
 public:
  /// Solves A x = b from x = 0; `apply(v, result)` sets result = A v. Returns the number of iterations. Where a
  /// direction of non-positive curvature turns up, the solution so far is returned (b itself, preconditioned, at the
  /// first iteration): a descent direction in any case.
  template <class Apply>
  int solve(Apply&& apply, std::span<const Eigen::Matrix3d> inverse_blocks, const Eigen::Matrix3Xd& b,
            Eigen::Matrix3Xd& x, const PcgOptions& options) {
    const Eigen::Index n = b.cols();
    for (Eigen::Matrix3Xd* w : {&r_, &z_, &p_, &ap_}) w->resize(3, n);
    x.setZero(3, n);
    r_ = b;
    precondition(inverse_blocks);
    p_ = z_;
    double rz = dot(r_, z_);
    const double stop = options.relative_tolerance * options.relative_tolerance * rz;
    if (!(rz > 0)) return 0;
    for (int k = 0; k < options.max_iterations; ++k) {
      apply(p_, ap_);
      const double curvature = dot(p_, ap_);
      if (!(curvature > 0)) {
        if (k == 0) x = z_;
        return k;
      }
      const double alpha = rz / curvature;
      x += alpha * p_;
      r_ -= alpha * ap_;
      precondition(inverse_blocks);
      const double next = dot(r_, z_);
      if (!(next > stop)) return k + 1;
      p_ = z_ + (next / rz) * p_;
      rz = next;
    }
    return options.max_iterations;
  }

 private:
  static double dot(const Eigen::Matrix3Xd& a, const Eigen::Matrix3Xd& b) { return a.cwiseProduct(b).sum(); }
  void precondition(std::span<const Eigen::Matrix3d> inverse_blocks) {
    for (Eigen::Index i = 0; i < r_.cols(); ++i) z_.col(i).noalias() = inverse_blocks[i] * r_.col(i);
  }
  Eigen::Matrix3Xd r_, z_, p_, ap_;
};

}  // namespace unsnarl
