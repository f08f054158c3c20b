#include "energy/intersection_length.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace unsnarl {
namespace {

const std::vector<Triangle> two = {{0, 1, 2}, {3, 4, 5}};
const std::vector<std::array<Index, 2>> pair = {{0, 1}};

double length(const Positions& x) {
  Positions gradient = Positions::Zero(3, x.cols());
  return intersection_length(x, two, pair, gradient);
}

TEST(IntersectionLength, of_a_triangle_through_another) {
  Positions x(3, 6);
  x << -3, 3, 0, -1, 1, 0,  //
      -3, -3, 5, 0, 0, 0,   //
      0, 0, 0, -1, -1, 1;
  EXPECT_NEAR(length(x), 1, 1e-12);  // half way up a triangle of width 2
  x.row(2).tail(3).array() += 5;
  EXPECT_EQ(length(x), 0);
}

TEST(IntersectionLength, of_neighbours_does_not_count) {
  const std::vector<Triangle> fan = {{0, 1, 2}, {0, 3, 4}};
  Positions x = Positions::Random(3, 5), gradient = Positions::Zero(3, 5);
  EXPECT_EQ(intersection_length(x, fan, pair, gradient), 0);
}

TEST(IntersectionLength, gradient_is_that_of_finite_differences) {
  std::mt19937 generator(7);
  int crossing = 0;
  for (int trial = 0; trial < 300; ++trial) {
    Positions x(3, 6);
    for (double& value : x.reshaped()) value = static_cast<double>(generator()) / 4294967295.0;
    Positions gradient = Positions::Zero(3, 6);
    if (intersection_length(x, two, pair, gradient, 2) < 0.05) continue;
    ++crossing;
    const double step = 1e-6;
    for (Index i = 0; i < 18; ++i) {
      Positions forward = x, backward = x;
      forward.reshaped()[i] += step;
      backward.reshaped()[i] -= step;
      const double slope = (length(forward) - length(backward)) / step;  // twice: the weight
      EXPECT_NEAR(gradient.reshaped()[i], slope, 1e-5 * (1 + gradient.norm()) * (1 + gradient.norm()));
    }
  }
  EXPECT_GT(crossing, 20);
}

}  // namespace
}  // namespace unsnarl
