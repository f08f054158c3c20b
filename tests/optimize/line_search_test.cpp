#include "optimize/line_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace unsnarl {
namespace {

double parabola(const Eigen::VectorXd& x, Eigen::VectorXd& g) {
  g = 2 * x;
  return x.squaredNorm();
}

struct State {
  Eigen::VectorXd x, gradient;
  double value;
  explicit State(const Objective& f, double at) : x(Eigen::VectorXd::Constant(1, at)), gradient(1) {
    value = f(x, gradient);
  }
};

TEST(LineSearch, halves_until_the_decrease_suffices) {
  State s(parabola, 1);
  const Eigen::VectorXd d = Eigen::VectorXd::Constant(1, -8);
  const LineSearchResult result = backtrack(parabola, d, {}, s.x, s.value, s.gradient);
  EXPECT_EQ(result.step, 0.125);  // 1 -> -7, -3, -1 (no decrease), 0
  EXPECT_EQ(result.evaluations, 4);
  EXPECT_TRUE(result.sufficient);
  EXPECT_EQ(s.x[0], 0);
  EXPECT_EQ(s.value, 0);
  EXPECT_EQ(s.gradient[0], 0);
}

TEST(LineSearch, stops_between_trials) {
  State s(parabola, 1);
  const Eigen::VectorXd d = Eigen::VectorXd::Constant(1, -8);
  LineSearchOptions options;
  int asked = 0;
  options.stop = [&] { return ++asked == 2; };
  const LineSearchResult result = backtrack(parabola, d, options, s.x, s.value, s.gradient);
  EXPECT_EQ(result.step, 0);
  EXPECT_EQ(result.evaluations, 2);
  EXPECT_EQ(s.x[0], 1);
  EXPECT_EQ(s.value, 1);
}

TEST(LineSearch, leaves_everything_alone_when_it_fails) {
  State s(parabola, 1);
  const Eigen::VectorXd uphill = Eigen::VectorXd::Constant(1, 1);
  const LineSearchResult result = backtrack(parabola, uphill, {}, s.x, s.value, s.gradient);
  EXPECT_EQ(result.step, 0);
  EXPECT_FALSE(result.sufficient);
  EXPECT_EQ(s.x[0], 1);
  EXPECT_EQ(s.value, 1);
  EXPECT_EQ(result.evaluations, 34);  // 2^-33 > 1e-10 > 2^-34
}

TEST(LineSearch, takes_the_last_step_where_told_to) {
  State s(parabola, 1);
  LineSearchOptions options;
  options.accept_step = 0.1;
  const LineSearchResult result =
      backtrack(parabola, Eigen::VectorXd::Constant(1, 1), options, s.x, s.value, s.gradient);
  EXPECT_EQ(result.step, 0.125);
  EXPECT_FALSE(result.sufficient);
  EXPECT_EQ(s.x[0], 1.125);
}

TEST(LineSearch, backs_out_of_non_finite_values) {
  const auto log_like = [](const Eigen::VectorXd& x, Eigen::VectorXd& g) {
    g = Eigen::VectorXd::Constant(1, 1 - 1 / x[0]);
    return x[0] > 0 ? x[0] - std::log(x[0]) : std::numeric_limits<double>::quiet_NaN();
  };
  State s(log_like, 2);
  const LineSearchResult result = backtrack(log_like, Eigen::VectorXd::Constant(1, -4), {}, s.x, s.value, s.gradient);
  EXPECT_EQ(result.step, 0.25);
  EXPECT_EQ(s.x[0], 1);
}

TEST(LineSearch, largest_block_norm) {
  Eigen::VectorXd v(6);
  v << 1, 2, 2, 0, 3, 4;
  EXPECT_EQ(largest_block_norm(v, 3), 5);
  EXPECT_EQ(largest_block_norm(Eigen::VectorXd(), 3), 0);
}

}  // namespace
}  // namespace unsnarl
