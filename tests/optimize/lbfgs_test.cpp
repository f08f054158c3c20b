#include "optimize/lbfgs.h"

#include <gtest/gtest.h>

#include <cmath>

namespace unsnarl {
namespace {

double rosenbrock(const Eigen::VectorXd& x, Eigen::VectorXd& g) {
  const double a = 1 - x[0], b = x[1] - x[0] * x[0];
  g.resize(2);
  g << -2 * a - 400 * x[0] * b, 200 * b;
  return a * a + 100 * b * b;
}

// 1/2 x^T D x with condition number 1e6.
struct Quadratic {
  Eigen::VectorXd d;
  explicit Quadratic(Eigen::Index n) : d(n) {
    for (Eigen::Index i = 0; i < n; ++i) d[i] = std::pow(10.0, 6.0 * i / (n - 1));
  }
  double operator()(const Eigen::VectorXd& x, Eigen::VectorXd& g) const {
    g = d.cwiseProduct(x);
    return 0.5 * x.dot(g);
  }
};

TEST(Lbfgs, finds_the_minimum_of_rosenbrock) {
  Eigen::VectorXd x(2);
  x << -1.2, 1;
  LbfgsOptions options;
  options.block = 2;
  options.gradient_tolerance = 1e-8;
  const LbfgsResult result = minimize_lbfgs(rosenbrock, x, options);
  EXPECT_EQ(result.status, LbfgsStatus::converged);
  EXPECT_NEAR(x[0], 1, 1e-6);
  EXPECT_NEAR(x[1], 1, 1e-6);
  EXPECT_LT(result.iterations, 100);
}

TEST(Lbfgs, the_right_metric_solves_a_quadratic_in_one_step) {
  const Quadratic quadratic(30);
  const auto metric = [&](const Eigen::VectorXd& v, Eigen::VectorXd& out) { out = v.cwiseQuotient(quadratic.d); };
  LbfgsOptions options;
  options.gradient_tolerance = 1e-9;
  Eigen::VectorXd x = Eigen::VectorXd::Ones(30);
  const LbfgsResult with = minimize_lbfgs(quadratic, x, options, metric);
  EXPECT_EQ(with.status, LbfgsStatus::converged);
  EXPECT_EQ(with.iterations, 1);
  x.setOnes();
  const LbfgsResult without = minimize_lbfgs(quadratic, x, options);
  EXPECT_GT(without.iterations, 10);
}

TEST(Lbfgs, direction_is_exact_after_enough_steps_on_a_quadratic) {
  // With n independent conjugate steps remembered, -H g is the Newton step.
  const Eigen::Vector3d d(1, 10, 100);
  Lbfgs lbfgs(3);
  for (int i = 0; i < 3; ++i) {
    const Eigen::VectorXd s = Eigen::Vector3d::Unit(i);
    lbfgs.remember(s, d.cwiseProduct(s));
  }
  const Eigen::VectorXd g = Eigen::Vector3d(3, -20, 500);
  Eigen::VectorXd direction(3);
  lbfgs.direction(g, direction);
  EXPECT_NEAR((direction + g.cwiseQuotient(Eigen::VectorXd(d))).norm(), 0, 1e-12);
}

TEST(Lbfgs, steps_without_positive_curvature_are_not_remembered) {
  Lbfgs lbfgs;
  lbfgs.remember(Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(-1, 0, 0));
  lbfgs.remember(Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 0));
  EXPECT_EQ(lbfgs.size(), 0);
  lbfgs.remember(Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(1, 0, 0));
  EXPECT_EQ(lbfgs.size(), 1);
  lbfgs.remember(Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0, -1, 0));
  EXPECT_EQ(lbfgs.size(), 0);
}

TEST(Lbfgs, no_block_moves_farther_than_the_cap) {
  const Quadratic quadratic(9);
  Eigen::VectorXd x = Eigen::VectorXd::Constant(9, 5), before = x;
  LbfgsOptions options;
  options.max_motion = 0.25;
  options.max_iterations = 10;
  minimize_lbfgs(quadratic, x, options, {}, [&](LbfgsIteration& state) {
    EXPECT_LE(largest_block_norm(state.x - before, 3), 0.25 * (1 + 1e-12));
    before = state.x;
    return false;
  });
}

TEST(Lbfgs, the_callback_stops_and_may_change_the_objective) {
  double center = 0;
  const auto objective = [&](const Eigen::VectorXd& x, Eigen::VectorXd& g) {
    g = x.array() - center;
    return 0.5 * g.squaredNorm();
  };
  Eigen::VectorXd x = Eigen::VectorXd::Constant(3, 4);
  const LbfgsResult result = minimize_lbfgs(objective, x, {}, {}, [&](LbfgsIteration& state) {
    if (state.iteration == 1) {
      center = 7;
      state.objective_changed = state.forget = true;
    }
    return state.iteration == 2;
  });
  EXPECT_EQ(result.status, LbfgsStatus::stopped);
  EXPECT_EQ(result.iterations, 2);
  EXPECT_NEAR(x[0], 7, 1e-12);
}

TEST(Lbfgs, gives_up_where_no_step_decreases) {
  // The gradient lies: it points the wrong way.
  const auto objective = [](const Eigen::VectorXd& x, Eigen::VectorXd& g) {
    g = -2 * x;
    return x.squaredNorm();
  };
  Eigen::VectorXd x = Eigen::VectorXd::Ones(3);
  EXPECT_EQ(minimize_lbfgs(objective, x).status, LbfgsStatus::no_step);
  EXPECT_EQ(x, Eigen::VectorXd::Ones(3));
}

}  // namespace
}  // namespace unsnarl
