#include "optimize/newton.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>

namespace unsnarl {
namespace {

/// f = `least` + sum over unknowns of a smooth bowl around `target`, steeper than quadratic; no unknown may get below
/// `floor` in its last coordinate, and no step may be longer than `cap`.
struct Bowls final : NewtonProblem {
  Eigen::Matrix3Xd x, target;
  double floor = -std::numeric_limits<double>::infinity();
  double cap = std::numeric_limits<double>::infinity();
  double least = 0;
  bool can_remove = false;
  int accepted = 0;
  bool is_rounded_to_singular = false;

  explicit Bowls(Index n) : x(Eigen::Matrix3Xd::Zero(3, n)), target(Eigen::Matrix3Xd::Constant(3, n, 3)) {}
  Index unknowns() const override { return static_cast<Index>(x.cols()); }
  double at(const Eigen::Matrix3Xd& y) const {
    if (y.size() > 0 && y.row(2).minCoeff() < floor) return std::numeric_limits<double>::infinity();
    const auto d2 = (y - target).colwise().squaredNorm().array();
    return least + (0.5 * d2 + 0.25 * d2.square()).sum();
  }
  double linearise(Eigen::Matrix3Xd& gradient) override {
    const Eigen::Matrix3Xd d = x - target;
    gradient = d;
    for (Index i = 0; i < unknowns(); ++i) gradient.col(i) *= 1 + d.col(i).squaredNorm();
    return at(x);
  }
  Eigen::Matrix3d block(Index i) const {
    const Eigen::Vector3d d = x.col(i) - target.col(i);
    return (1 + d.squaredNorm()) * Eigen::Matrix3d::Identity() + 2 * d * d.transpose();
  }
  void apply_hessian(const Eigen::Matrix3Xd& v, Eigen::Matrix3Xd& result) const override {
    for (Index i = 0; i < unknowns(); ++i) result.col(i) = block(i) * v.col(i);
  }
  void inverse_blocks(std::vector<Eigen::Matrix3d>& blocks) const override {
    blocks.resize(unknowns());
    for (Index i = 0; i < unknowns(); ++i) blocks[i] = block(i).inverse();
  }
  Eigen::SparseMatrix<double> lower_triangle() const override {
    Eigen::MatrixXd whole = Eigen::MatrixXd::Zero(3 * unknowns(), 3 * unknowns());
    if (!is_rounded_to_singular)
      for (Index i = 0; i < unknowns(); ++i) whole.block<3, 3>(3 * i, 3 * i) = block(i);
    return Eigen::MatrixXd(whole.triangularView<Eigen::Lower>()).sparseView();
  }
  void limit(Eigen::Matrix3Xd& step) override {
    step *= std::min(1.0, cap / std::sqrt(step.colwise().squaredNorm().maxCoeff()));
  }
  void filter(Eigen::Matrix3Xd&) override {}
  double value(const Eigen::Matrix3Xd& step) override { return at(x + step); }
  void accept(const Eigen::Matrix3Xd& step) override {
    EXPECT_LE(at(x + step), at(x));
    x += step;
    ++accepted;
  }
  bool remove_blocked() override {
    if (!can_remove) return false;
    can_remove = false;
    floor = -std::numeric_limits<double>::infinity();
    return true;
  }
};

TEST(Newton, converges_to_the_minimum) {
  Bowls bowls(5);
  NewtonOptions options;
  options.solver = {1e-10, 100};
  options.motion = 1e-9;
  const NewtonResult result = minimise_newton(bowls, options);
  EXPECT_LT((bowls.x - bowls.target).norm(), 1e-8);
  EXPECT_LE(result.iterations, 15);
  EXPECT_EQ(bowls.accepted, result.iterations);
}

TEST(Newton, the_direct_solver_gives_the_steps_of_conjugate_gradients) {
  Bowls by_gradients(5), directly(5);
  by_gradients.target.col(2) = directly.target.col(2) = Eigen::Vector3d(-1, 4, 0.5);
  NewtonOptions options;
  options.max_steps = 3;
  options.solver = {1e-12, 100};
  minimise_newton(by_gradients, options);
  options.direct_solver = true;
  const NewtonResult result = minimise_newton(directly, options);
  EXPECT_LT((by_gradients.x - directly.x).norm(), 1e-9);
  EXPECT_EQ(result.iterations, 3);
  EXPECT_EQ(result.solver_iterations, 0);
}

TEST(Newton, where_there_is_no_factorisation_conjugate_gradients_go_on) {
  Bowls bowls(5);
  bowls.is_rounded_to_singular = true;
  NewtonOptions options;
  options.direct_solver = true;
  options.solver = {1e-10, 100};
  options.motion = 1e-9;
  const NewtonResult result = minimise_newton(bowls, options);
  EXPECT_LT((bowls.x - bowls.target).norm(), 1e-8);
  EXPECT_GT(result.solver_iterations, 0);
}

TEST(Newton, short_steps_take_more_iterations) {
  Bowls bowls(2);
  bowls.cap = 0.5;
  NewtonOptions options;
  options.motion = 1e-6;
  const NewtonResult result = minimise_newton(bowls, options);
  EXPECT_LT((bowls.x - bowls.target).norm(), 1e-4);
  EXPECT_GE(result.iterations, 10);  // the target is 5.2 away
}

TEST(Newton, ends_where_the_value_hardly_falls) {
  Bowls all(2), some(2);
  NewtonOptions options;
  options.motion = 1e-12;
  all.least = some.least = 1;
  const int until_the_end = minimise_newton(all, options).iterations;
  options.decrease = 0.9;
  options.window = 1;
  EXPECT_LT(minimise_newton(some, options).iterations, until_the_end);
}

// Each step lowers the value by more than a third of what it is then, but by less and less of what it was at the start.
TEST(Newton, ends_by_the_value_at_the_start) {
  Bowls bowls(1);
  bowls.cap = 0.5;
  NewtonOptions options;
  options.decrease = 0.05;
  const double start = (bowls.x - bowls.target).norm();
  minimise_newton(bowls, options);
  const double end = (bowls.x - bowls.target).norm();
  EXPECT_LT(end, 0.7 * start);
  EXPECT_GT(end, 0.2 * start);
}

TEST(Newton, stops_at_its_limits) {
  Bowls bowls(2);
  NewtonOptions options;
  options.max_steps = 2;
  EXPECT_EQ(minimise_newton(bowls, options).iterations, 2);
  int asked = 0;
  const NewtonResult result = minimise_newton(bowls, options, [&] { return ++asked == 2; });
  EXPECT_TRUE(result.stopped);
  EXPECT_EQ(result.iterations, 1);
}

TEST(Newton, starts_anew_without_the_unknowns_that_are_blocked) {
  Bowls stuck(1), freed(1);
  for (Bowls* b : {&stuck, &freed}) {
    b->floor = -1;
    b->target.row(2).setConstant(-3);
  }
  freed.can_remove = true;
  NewtonOptions options;
  minimise_newton(stuck, options);
  EXPECT_TRUE(stuck.x.isZero(0));
  options.solver = {1e-10, 100};
  options.motion = 1e-9;
  minimise_newton(freed, options);
  EXPECT_LT((freed.x - freed.target).norm(), 1e-8);
}

}  // namespace
}  // namespace unsnarl
