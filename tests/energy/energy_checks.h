#pragma once

#include <gtest/gtest.h>

#include "energy/energy_sum.h"
#include "energy/finite_differences.h"

namespace unsnarl {

template <ElementEnergy E>
double total_value(const E& energy, const Positions& x) {
  double sum = 0;
  for (Index e = 0; e < energy.size(); ++e) sum += energy.value(x, e);
  return sum;
}

/// A linearised sum over all elements.
struct Linearised {
  double value = 0;
  Positions gradient;
  HessianTerms hessian;
};

template <ElementEnergy E>
Linearised linearise_all(const E& energy, const Positions& x, double weight) {
  Linearised result;
  result.gradient = Positions::Zero(3, x.cols());
  for (Index e = 0; e < energy.size(); ++e)
    result.value += energy.linearise(x, e, weight, result.gradient, result.hessian);
  return result;
}

/// Value and gradient as Newton's method uses them agree with each other.
template <ElementEnergy E>
void expect_derivatives(const E& energy, const Positions& x, double step, double tolerance) {
  const double weight = 2.5;
  const Linearised at = linearise_all(energy, x, weight);
  EXPECT_NEAR(at.value, weight * total_value(energy, x), 1e-12 * std::abs(at.value));
  expect_gradient([&](const Positions& y) { return weight * total_value(energy, y); }, x, at.gradient, step, tolerance);
}

/// The terms as a dense matrix over all coordinates, vertex by vertex.
inline Eigen::MatrixXd dense(const HessianTerms& terms, Index vertex_count) {
  std::vector<Index> slot(static_cast<std::size_t>(vertex_count));
  for (Index v = 0; v < vertex_count; ++v) slot[v] = v;
  Hessian hessian;
  hessian.begin(1)[0] = terms;
  hessian.assemble(slot, vertex_count);
  Eigen::MatrixXd result(3 * vertex_count, 3 * vertex_count);
  Eigen::Matrix3Xd unit(3, vertex_count), image(3, vertex_count);
  for (Index k = 0; k < 3 * vertex_count; ++k) {
    unit.setZero();
    unit(k % 3, k / 3) = 1;
    hessian.apply(unit, image);
    result.col(k) = image.reshaped();
  }
  return result;
}

/// Central differences of the gradient.
template <class Gradient>
Eigen::MatrixXd difference_hessian(Gradient&& gradient, const Positions& x, double step) {
  Eigen::MatrixXd result(x.size(), x.size());
  for (Index k = 0; k < x.size(); ++k) {
    Positions plus = x, minus = x;
    plus(k % 3, k / 3) += step;
    minus(k % 3, k / 3) -= step;
    result.col(k) = ((gradient(plus) - gradient(minus)) / (2 * step)).reshaped();
  }
  return result;
}

}  // namespace unsnarl
