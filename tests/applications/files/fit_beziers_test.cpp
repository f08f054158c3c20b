#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "applications/curves/files/fit_beziers.h"

namespace unsnarl {
namespace {

Vec2 bezier_at(const Vec2& a, const FittedBezier& bezier, const Vec2& d, double t) {
  const double u = 1 - t;
  return u * u * u * a + 3 * t * u * u * bezier.controls[0] + 3 * t * t * u * bezier.controls[1] + t * t * t * d;
}

TEST(FitBeziers, a_quarter_of_a_circle_is_one_curve) {
  std::vector<Vec2> points;
  for (int k = 0; k <= 20; ++k) {
    const double angle = std::numbers::pi / 2 * k / 20;
    points.emplace_back(std::cos(angle), std::sin(angle));
  }
  const std::vector<FittedBezier> fitted = fit_beziers(points, {0, 1}, {-1, 0}, 1e-3);
  ASSERT_EQ(fitted.size(), 1U);
  EXPECT_EQ(fitted[0].to, 20U);
  EXPECT_NEAR(fitted[0].controls[0].x(), 1, 1e-12);
  EXPECT_NEAR(fitted[0].controls[0].y(), 0.5523, 2e-3);
  EXPECT_GT(fit_beziers(points, {0, 1}, {-1, 0}, 1e-6).size(), 1U);
}

TEST(FitBeziers, random_points_are_met_without_kinks_and_without_bulges) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<Vec2> points{{0, 0}};
    while (points.size() < 12) {
      const double x = static_cast<double>(random()) / 4294967296.0;
      const double y = static_cast<double>(random()) / 4294967296.0;
      points.emplace_back(points.back() + Vec2(x, y - 0.5));
    }
    const std::vector<FittedBezier> fitted = fit_beziers(points, Vec2::Zero(), Vec2::Zero(), 0.01);
    std::size_t at = 0;
    Vec2 arrived = Vec2::Zero();
    for (const FittedBezier& bezier : fitted) {
      ASSERT_GT(bezier.to, at);
      const Vec2 a = points[at], d = points[bezier.to];
      const Vec2 leaves = (bezier.controls[0] - a).normalized();
      if (at > 0) {
        EXPECT_NEAR((leaves - arrived).norm(), 0, 1e-9);
      }
      arrived = (d - bezier.controls[1]).normalized();
      for (int k = 0; bezier.to == at + 1 && k <= 20; ++k) {
        const Vec2 place = bezier_at(a, bezier, d, k / 20.0);
        EXPECT_LE((place - (a + nearest_fraction(place, a, d) * (d - a))).norm(), 0.05 * (1 + 1e-9));
      }
      at = bezier.to;
    }
    EXPECT_EQ(at, points.size() - 1);
  }
}

}  // namespace
}  // namespace unsnarl
