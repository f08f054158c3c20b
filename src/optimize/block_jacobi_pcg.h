#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "geometry/fit.h"
#include "geometry/parallel_sums.h"

namespace unsnarl {

struct PcgOptions {
  /// Ends where the preconditioned residual is below this (unit: share of the right-hand side's)
  double relative_tolerance = 1e-2;
  int max_iterations = std::numeric_limits<int>::max();
};

/// Conjugate gradients for symmetric positive definite systems over 3-vectors, preconditioned by the inverses of the
/// 3 x 3 blocks on the diagonal. Keeps its workspace.
class BlockJacobiPcg {
 public:
  /// Solves A x = b from x = 0; `apply(v, result)` sets result = A v. Returns the number of iterations. At a direction
  /// of non-positive curvature it ends with the solution so far (in the first iteration: the preconditioned b), which
  /// is a descent direction in any case.
  template <class Apply>
  int solve(Apply&& apply, std::span<const Eigen::Matrix3d> inverse_blocks, const Eigen::Matrix3Xd& b,
            Eigen::Matrix3Xd& x, const PcgOptions& options) {
    const Index n = static_cast<Index>(b.cols());
    for (Eigen::Matrix3Xd* w : {&r_, &z_, &p_, &ap_, &x}) fit(*w, 3, n);
    x.setZero();
    r_ = b;
    double rz = step(inverse_blocks, 0, x);
    p_ = z_;
    const double stop = options.relative_tolerance * options.relative_tolerance * rz;
    if (!(rz > 0)) return 0;
    for (int k = 0; k < options.max_iterations; ++k) {
      apply(p_, ap_);
      const double curvature = sum_in_chunks(n, chunk, [&](Index begin, Index end) {
        return p_.middleCols(begin, end - begin).cwiseProduct(ap_.middleCols(begin, end - begin)).sum();
      });
      if (!(curvature > 0)) {
        if (k == 0) x = z_;
        return k;
      }
      const double next = step(inverse_blocks, rz / curvature, x);
      if (!(next > stop)) return k + 1;
      const double beta = next / rz;
      for_chunks(n, chunk, [&](Index begin, Index end) {
        auto p = p_.middleCols(begin, end - begin);
        p = z_.middleCols(begin, end - begin) + beta * p;
      });
      rz = next;
    }
    return options.max_iterations;
  }

 private:
  /// A task of a parallel loop has this many columns (unit: columns)
  static constexpr Index chunk = 2048;

  /// Goes alpha along p_, preconditions the residual there and returns its square in that metric.
  double step(std::span<const Eigen::Matrix3d> inverse_blocks, double alpha, Eigen::Matrix3Xd& x) {
    return sum_in_chunks(static_cast<Index>(r_.cols()), chunk, [&](Index begin, Index end) {
      const Index width = end - begin;
      if (alpha > 0) {
        x.middleCols(begin, width) += alpha * p_.middleCols(begin, width);
        r_.middleCols(begin, width) -= alpha * ap_.middleCols(begin, width);
      }
      for (Index i = begin; i < end; ++i) z_.col(i).noalias() = inverse_blocks[i] * r_.col(i);
      return r_.middleCols(begin, width).cwiseProduct(z_.middleCols(begin, width)).sum();
    });
  }

  Eigen::Matrix3Xd r_, z_, p_, ap_;
};

}  // namespace unsnarl
