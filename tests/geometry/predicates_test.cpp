#include "geometry/predicates.h"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace unsnarl {
namespace {

using Rational = boost::multiprecision::cpp_rational;

// Reference for integers: nothing overflows while coordinates stay below 2^38.
Sign orient3d_by_integers(const std::array<std::array<std::int64_t, 3>, 4>& p) {
  __extension__ using Wide = __int128;
  Wide m[3][3];
  for (int r = 0; r < 3; ++r)
    for (int k = 0; k < 3; ++k) m[r][k] = p[r + 1][k] - p[0][k];
  const Wide det = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                   m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                   m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  return (det > 0) - (det < 0);
}

// Reference for any doubles: rational numbers.
Sign orient3d_by_rationals(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  Rational m[3][3];
  const Vec3* rows[3] = {&b, &c, &d};
  for (int r = 0; r < 3; ++r)
    for (int k = 0; k < 3; ++k) m[r][k] = Rational((*rows[r])[k]) - Rational(a[k]);
  const Rational det = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                       m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                       m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  return det.sign();
}
Sign orient2d_by_rationals(double ax, double ay, double bx, double by, double cx, double cy) {
  const Rational x0(ax), y0(ay);
  const Rational det = (Rational(bx) - x0) * (Rational(cy) - y0) - (Rational(by) - y0) * (Rational(cx) - x0);
  return det.sign();
}

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  std::int64_t integer(std::int64_t limit) {  // in [-limit, limit]
    return static_cast<std::int64_t>(engine_() % static_cast<std::uint64_t>(2 * limit + 1)) - limit;
  }
  double real() { return static_cast<double>(engine_() >> 11) * 0x1p-52 - 1; }
  Vec3 point() { return Vec3(real(), real(), real()); }

 private:
  std::mt19937_64 engine_;
};

// The four points in all orders: odd permutations turn the sign.
void expect_antisymmetric(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Sign s = orient3d(a, b, c, d);
  EXPECT_EQ(orient3d(b, a, c, d), -s);
  EXPECT_EQ(orient3d(a, c, b, d), -s);
  EXPECT_EQ(orient3d(a, b, d, c), -s);
  EXPECT_EQ(orient3d(d, a, b, c), -s);
  EXPECT_EQ(orient3d(b, c, a, d), s);
}

TEST(Predicates, orientation_of_the_axes) {
  const Vec3 o(0, 0, 0), x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  EXPECT_EQ(orient3d(o, x, y, z), 1);
  EXPECT_EQ(orient3d(o, y, x, z), -1);
  EXPECT_EQ(orient3d(o, x, y, x + y), 0);
  EXPECT_EQ(orient2d(0, 0, 1, 0, 0, 1), 1);
  EXPECT_EQ(orient2d(0, 0, 0, 1, 1, 0), -1);
  EXPECT_EQ(orient2d(0, 0, 1, 1, 3, 3), 0);
}

TEST(Predicates, orient3d_agrees_with_integers) {
  Random random(1);
  std::array<int, 3> seen{};
  for (const std::int64_t limit : {2, 7, 1000, 1 << 26}) {
    for (int round = 0; round < 20000; ++round) {
      std::array<std::array<std::int64_t, 3>, 4> p;
      for (auto& point : p)
        for (auto& c : point) c = random.integer(limit);
      if (round % 2) {  // in the plane of the others, or next to it
        const std::int64_t s = random.integer(3), t = random.integer(3);
        for (int k = 0; k < 3; ++k) p[3][k] = p[0][k] + s * (p[1][k] - p[0][k]) + t * (p[2][k] - p[0][k]);
        p[3][round % 3] += random.integer(1);
      }
      std::array<Vec3, 4> q;
      for (int i = 0; i < 4; ++i)
        for (int k = 0; k < 3; ++k) q[i][k] = static_cast<double>(p[i][k]);
      const Sign expected = orient3d_by_integers(p);
      ++seen[expected + 1];
      ASSERT_EQ(orient3d(q[0], q[1], q[2], q[3]), expected) << "limit " << limit << " round " << round;
    }
  }
  for (const int count : seen) EXPECT_GT(count, 1000) << "the points hardly show one of the signs";
}

// Points within some units in the last place of a plane, at scales from 1e-100 to 1e100 and away from the origin.
TEST(Predicates, orient3d_is_exact_next_to_the_plane) {
  Random random(2);
  std::array<int, 3> seen{};
  for (const double scale : {1.0, 1e-5, 3e7, 1e-100, 1e100, 1e-90}) {
    for (int round = 0; round < 1500; ++round) {
      const Vec3 shift = (round % 3 == 0 ? 0.0 : round % 3 == 1 ? 1.0 : 1e6) * Vec3(1, -0.7, 0.3);
      const Vec3 a = scale * (random.point() + shift), b = scale * (random.point() + shift),
                 c = scale * (random.point() + shift);
      Vec3 d = a + random.real() * (b - a) + random.real() * (c - a);
      for (int k = 0; k < 3; ++k)
        for (std::int64_t steps = random.integer(2); steps != 0; steps -= steps > 0 ? 1 : -1)
          d[k] = std::nextafter(d[k], steps > 0 ? INFINITY : -INFINITY);
      const Sign expected = orient3d_by_rationals(a, b, c, d);
      ++seen[expected + 1];
      ASSERT_EQ(orient3d(a, b, c, d), expected) << "scale " << scale << " round " << round;
      if (round % 50 == 0) expect_antisymmetric(a, b, c, d);
    }
  }
  EXPECT_GT(seen[0], 1000);
  EXPECT_GT(seen[2], 1000);
}

// Coordinates of n binary digits around each n from which on longer integers are used: up to 2^n, from 2^0.
TEST(Predicates, integers_of_every_length_are_exact) {
  Random random(3);
  std::array<int, 3> seen{};
  for (const int digits : {3, 40, 61, 62, 63, 64, 125, 126, 127, 128, 400, 1023}) {
    for (int round = 0; round < 150; ++round) {
      std::array<Vec3, 4> p;
      for (Vec3& q : p)
        for (int k = 0; k < 3; ++k)
          q[k] = static_cast<double>(random.integer(3)) +
                 (random.integer(1) == 0 ? 0 : std::ldexp(random.real(), static_cast<int>(random.integer(digits))));
      p[0][round % 3] = -std::ldexp(1 - 0x1p-53, digits);
      p[1][round % 3] = std::ldexp(1 - 0x1p-53, digits);
      if (round % 3 == 0) p[3] = p[2];
      const Sign expected = orient3d_by_rationals(p[0], p[1], p[2], p[3]);
      ++seen[expected + 1];
      ASSERT_EQ(detail::orient3d_exact(p[0], p[1], p[2], p[3]), expected) << digits << " digits, round " << round;
      ASSERT_EQ(detail::orient2d_exact(p[0][0], p[0][1], p[1][0], p[1][1], p[2][0], p[2][1]),
                orient2d_by_rationals(p[0][0], p[0][1], p[1][0], p[1][1], p[2][0], p[2][1]))
          << digits << " digits, round " << round;
    }
  }
  for (const int count : seen) EXPECT_GT(count, 200);
}

/// A coordinate for which a plane is decided by its last binary digit.
double neighbour_of(double value, std::int64_t steps) {
  for (; steps != 0; steps -= steps > 0 ? 1 : -1) value = std::nextafter(value, steps > 0 ? INFINITY : -INFINITY);
  return value;
}

// A build that rounds otherwise gets these signs wrong: the points were put into a plane, and rounded.
TEST(Predicates, a_hundred_thousand_points_beside_a_plane) {
  Random random(8);
  std::array<int, 3> seen{};
  for (int round = 0; round < 100'000; ++round) {
    const double size = std::ldexp(1.0, static_cast<int>(random.integer(20)));
    std::array<Vec3, 4> p;
    for (Vec3& q : p) q = random.point() + Vec3(size, 0.5 * size, 0);
    const double s = random.real(), t = random.real();
    p[3] = p[0] + s * (p[1] - p[0]) + t * (p[2] - p[0]);
    if (round % 4 == 1)  // as a file in single precision has them
      for (Vec3& q : p) q = q.cast<float>().cast<double>();
    if (round % 4 == 2)  // on a grid
      for (Vec3& q : p) q = (8 * q).array().round();
    if (round % 2 == 1) p[3][round % 3] = neighbour_of(p[3][round % 3], random.integer(1));
    const Sign expected = orient3d_by_rationals(p[0], p[1], p[2], p[3]);
    ++seen[expected + 1];
    ASSERT_EQ(orient3d(p[0], p[1], p[2], p[3]), expected) << "round " << round;
  }
  for (const int count : seen) EXPECT_GT(count, 1000);
}

// Products that underflow to zero, or terms of wildly different size, must not be taken for coplanar.
TEST(Predicates, orient3d_survives_underflow_and_wild_magnitudes) {
  const double tiny = 1e-200;
  EXPECT_EQ(orient3d({0, 0, 0}, {tiny, 0, 0}, {0, tiny, 0}, {0, 0, tiny}), 1);
  EXPECT_EQ(orient3d({0, 0, 0}, {0, tiny, 0}, {tiny, 0, 0}, {0, 0, tiny}), -1);
  const double least = 5e-324;
  EXPECT_EQ(orient3d({0, 0, 0}, {least, 0, 0}, {0, least, 0}, {0, 0, least}), 1);
  const std::vector<double> values = {0, 1, -1, 1 + 0x1p-52, 1e-200, -1e-17, 3e15, 1e-310, 0.1, 1e60};
  Random random(4);
  for (int round = 0; round < 20000; ++round) {
    std::array<Vec3, 4> p;
    for (Vec3& q : p)
      for (int k = 0; k < 3; ++k)
        q[k] = values[static_cast<std::size_t>(random.integer(1 << 20) + (1 << 20)) % values.size()];
    ASSERT_EQ(orient3d(p[0], p[1], p[2], p[3]), orient3d_by_rationals(p[0], p[1], p[2], p[3])) << "round " << round;
  }
}

// A product that underflows counts if the difference that multiplies it is huge.
TEST(Predicates, orient3d_survives_underflow_beside_huge_differences) {
  EXPECT_EQ(orient3d({0, 0, 0}, {1e-100, 0, 1e200}, {1e-162, 0, 1e-10}, {0, 1e-163, 0}),
            orient3d_by_rationals({0, 0, 0}, {1e-100, 0, 1e200}, {1e-162, 0, 1e-10}, {0, 1e-163, 0}));
  Random random(7);
  for (int round = 0; round < 20000; ++round) {
    std::array<Vec3, 4> p;
    for (Vec3& q : p)
      for (int k = 0; k < 3; ++k)
        q[k] = random.integer(3) == 0 ? 0 : std::ldexp(random.real(), static_cast<int>(random.integer(900)));
    ASSERT_EQ(orient3d(p[0], p[1], p[2], p[3]), orient3d_by_rationals(p[0], p[1], p[2], p[3])) << "round " << round;
  }
}

TEST(Predicates, points_that_are_not_finite_have_no_side) {
  EXPECT_EQ(orient3d({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, INFINITY}), 0);
  EXPECT_EQ(orient3d({0, 0, NAN}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}), 0);
  EXPECT_EQ(orient2d(0, 0, 1, 0, 0, NAN), 0);
  EXPECT_EQ(orient2d(0, 0, INFINITY, 0, 0, 1), 0);
}

TEST(Predicates, orient2d_is_exact) {
  Random random(5);
  std::array<int, 3> seen{};
  for (const double scale : {1.0, 1e-160, 1e-8, 1e140}) {
    for (int round = 0; round < 4000; ++round) {
      double p[6];
      for (double& v : p) v = scale * (round % 2 ? random.real() + 3 : static_cast<double>(random.integer(5)));
      const double t = random.real();
      if (round % 4 == 1) p[4] = p[0] + t * (p[2] - p[0]), p[5] = p[1] + t * (p[3] - p[1]);
      if (round % 8 == 1) p[5] = std::nextafter(p[5], INFINITY);
      const Sign expected = orient2d_by_rationals(p[0], p[1], p[2], p[3], p[4], p[5]);
      ++seen[expected + 1];
      ASSERT_EQ(orient2d(p[0], p[1], p[2], p[3], p[4], p[5]), expected) << "scale " << scale << " round " << round;
    }
  }
  for (const int count : seen) EXPECT_GT(count, 200);
}

TEST(Predicates, collinear_is_exact) {
  const Vec3 a(0.1, 0.2, 0.3), b(0.4, 0.7, -0.6);
  EXPECT_TRUE(collinear(a, a, b));
  EXPECT_TRUE(collinear(a, b, b));
  EXPECT_TRUE(collinear({1, 2, 3}, {2, 4, 6}, {-7, -14, -21}));
  EXPECT_FALSE(collinear({1, 2, 3}, {2, 4, 6}, {-7, -14, std::nextafter(-21.0, 0.0)}));
  EXPECT_FALSE(collinear({0, 0, 0}, {1e-200, 0, 0}, {0, 1e-200, 0}));
  EXPECT_TRUE(collinear({5, 0, 0}, {5, 0, 1}, {5, 0, -9}));
}

TEST(Predicates, projection_axis_keeps_the_area) {
  Random random(6);
  for (int round = 0; round < 2000; ++round) {
    std::array<Vec3, 3> p;
    for (Vec3& q : p)
      for (int k = 0; k < 3; ++k) q[k] = static_cast<double>(random.integer(1));
    const int axis = projection_axis(p[0], p[1], p[2]);
    if (axis >= 0) {
      EXPECT_NE(orient2d_dropping(axis, p[0], p[1], p[2]), 0);
    } else {
      for (int k = 0; k < 3; ++k) EXPECT_EQ(orient2d_dropping(k, p[0], p[1], p[2]), 0);
    }
  }
}

TEST(Predicates, order_along_a_line) {
  EXPECT_TRUE(lexicographic_less({0, 9, 9}, {1, 0, 0}));
  EXPECT_TRUE(lexicographic_less({1, 0, 9}, {1, 1, 0}));
  EXPECT_TRUE(lexicographic_less({1, 1, 0}, {1, 1, 1}));
  EXPECT_FALSE(lexicographic_less({1, 1, 1}, {1, 1, 1}));
  EXPECT_FALSE(lexicographic_less({0.0, 0, 0}, {-0.0, 0, 0}));
}

}  // namespace
}  // namespace unsnarl
