#include "geometry/portable_math.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <numbers>

#include "geometry/splitmix.h"

namespace unsnarl {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
using Function = std::function<double(double)>;

/// The largest distance from the function of the C library over [lo, hi], in units of the last place of its value.
double worst_error(const Function& own, const Function& known, double lo, double hi) {
  double worst = 0;
  for (int k = 0; k <= 100000; ++k) {
    const double x = lo + (hi - lo) * k / 100000, value = known(x);
    const double ulp = std::abs(std::nextafter(value, inf) - value);
    worst = std::max(worst, std::abs(own(x) - value) / ulp);
  }
  return worst;
}

#define EXPECT_CLOSE(function, lo, hi, ulps)                                                                          \
  EXPECT_LE(                                                                                                          \
      worst_error([](double x) { return portable::function(x); }, [](double x) { return std::function(x); }, lo, hi), \
      ulps)

TEST(portable_math, is_near_that_of_the_c_library) {
  EXPECT_CLOSE(exp, -1, 1, 1);
  EXPECT_CLOSE(exp, -700, 700, 1);
  EXPECT_CLOSE(log, 1e-12, 2, 1);
  EXPECT_CLOSE(log, 1e200, 1e300, 1);
  EXPECT_CLOSE(sin, 0.1, 3, 3);
  EXPECT_CLOSE(cos, -1.5, 1.5, 3);
  EXPECT_CLOSE(sin, 1000, 1001, 3);
  EXPECT_CLOSE(tan, -1.5, 1.5, 4);
  EXPECT_CLOSE(atan, -30, 30, 6);
  EXPECT_CLOSE(asin, -1, 1, 6);
  EXPECT_CLOSE(acos, -1, 0.999, 6);
  EXPECT_CLOSE(sinh, 0.5, 20, 6);
  EXPECT_CLOSE(cosh, -20, 20, 3);
}

TEST(portable_math, is_exact_where_results_are) {
  EXPECT_EQ(portable::exp(0), 1);
  EXPECT_EQ(portable::log(1), 0);
  EXPECT_EQ(portable::sin(0), 0);
  EXPECT_EQ(portable::cos(0), 1);
  EXPECT_NEAR(portable::atan2(1, 1), std::numbers::pi / 4, 1e-15);
  EXPECT_EQ(portable::pow(-3, 5), -243);
  EXPECT_EQ(portable::pow(2.0, -2), 0.25);
  EXPECT_EQ(portable::pow(0.0, 0.0), 1);
  EXPECT_EQ(portable::length(2, -3, 6), 7);
}

TEST(portable_math, knows_the_ends_of_the_range) {
  EXPECT_EQ(portable::exp(710), inf);
  EXPECT_EQ(portable::exp(inf), inf);
  EXPECT_EQ(portable::exp(-inf), 0);
  EXPECT_GT(portable::exp(-744), 0);
  EXPECT_EQ(portable::exp(-746), 0);
  EXPECT_TRUE(std::isnan(portable::exp(std::nan(""))));
  EXPECT_EQ(portable::log(0), -inf);
  EXPECT_EQ(portable::log(inf), inf);
  EXPECT_NEAR(portable::log(std::numeric_limits<double>::denorm_min()), -744.44007192138126, 1e-12);
  EXPECT_TRUE(std::isnan(portable::log(-1)));
  EXPECT_TRUE(std::isnan(portable::asin(1.1)));
  EXPECT_TRUE(std::isfinite(portable::sin(1e300)));
}

TEST(portable_math, angles_are_in_the_right_quadrant) {
  for (const double y : {-2.0, -0.0, 0.0, 3.0})
    for (const double x : {-1.0, -0.0, 0.0, 5.0}) {
      EXPECT_NEAR(portable::atan2(y, x), std::atan2(y, x), 1e-15) << y << ' ' << x;
      EXPECT_EQ(std::signbit(portable::atan2(y, x)), std::signbit(std::atan2(y, x))) << y << ' ' << x;
    }
  for (int k = -20; k <= 20; ++k) EXPECT_NEAR(portable::sin(k), std::sin(k), 1e-15) << k;
}

TEST(portable_math, powers_are_those_of_the_c_library) {
  for (std::uint64_t k = 0; k < 10000; ++k) {
    const double x = portable::exp(14 * splitmix_number(2 * k) - 7), y = 8 * splitmix_number(2 * k + 1) - 4;
    EXPECT_NEAR(portable::pow(x, y) / std::pow(x, y), 1, 1e-14);
  }
}

}  // namespace
}  // namespace unsnarl
