#include "applications/knots/triangles4.h"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <optional>
#include <random>

namespace unsnarl {
namespace {

using Fraction = boost::multiprecision::cpp_rational;

/// The one solution of a system of linear equations; none where there is none or many.
std::optional<std::vector<Fraction>> solved(std::vector<std::vector<Fraction>> rows, std::size_t unknowns) {
  std::size_t rank = 0;
  for (std::size_t column = 0; column < unknowns; ++column) {
    std::size_t pivot = rank;
    while (pivot < rows.size() && rows[pivot][column] == 0) ++pivot;
    if (pivot == rows.size()) return std::nullopt;
    std::swap(rows[pivot], rows[rank]);
    for (std::size_t r = 0; r < rows.size(); ++r) {
      if (r == rank || rows[r][column] == 0) continue;
      const Fraction factor = rows[r][column] / rows[rank][column];
      for (std::size_t c = column; c <= unknowns; ++c) rows[r][c] -= factor * rows[rank][c];
    }
    ++rank;
  }
  for (std::size_t r = rank; r < rows.size(); ++r)
    if (rows[r][unknowns] != 0) return std::nullopt;
  std::vector<Fraction> x;
  for (std::size_t k = 0; k < unknowns; ++k) x.push_back(rows[k][unknowns] / rows[k][k]);
  return x;
}

/// By linear programming: the common points are a polytope in the six barycentric coordinates of both triangles, and
/// every corner of it has a support whose columns are independent. Tries all 63 supports; coordinates are small
/// integers.
bool meet_by_enumeration(const Triangle4& a, const Triangle4& b, int shared) {
  const auto whole = [](double v) { return Fraction(static_cast<std::int64_t>(v)); };
  for (unsigned support = 1; support < 64; ++support) {
    std::vector<int> columns;
    for (int k = 0; k < 6; ++k)
      if (support >> k & 1U) columns.push_back(k);
    std::vector<std::vector<Fraction>> rows(6);
    for (int r = 0; r < 6; ++r) {
      for (const int k : columns) {
        if (r < 4) {
          rows[r].push_back(k < 3 ? whole(a[k][r]) : -whole(b[k - 3][r]));
        } else {
          rows[r].push_back((k < 3) == (r == 4) ? 1 : 0);
        }
      }
      rows[r].push_back(r < 4 ? 0 : 1);
    }
    const auto weights = solved(rows, columns.size());
    if (!weights) continue;
    bool inside = true, beyond = shared == 0;
    for (std::size_t k = 0; k < columns.size(); ++k) {
      inside = inside && (*weights)[k] >= 0;
      beyond = beyond || (columns[k] < 3 && columns[k] >= shared && (*weights)[k] > 0);
    }
    if (inside && beyond) return true;
  }
  return false;
}

class Dice {
 public:
  explicit Dice(unsigned seed) : engine_(seed) {}
  int whole(int below) { return static_cast<int>(engine_() % static_cast<unsigned>(below)); }
  Vec4 point(int below) { return Vec4(whole(below), whole(below), whole(below), whole(below)); }

 private:
  std::mt19937 engine_;
};

bool degenerate(const Triangle4& t) {
  const Vec4 u = t[1] - t[0], v = t[2] - t[0];
  return u.squaredNorm() * v.squaredNorm() == u.dot(v) * u.dot(v);  // exact for small integers
}

TEST(Triangles4, agree_with_enumeration_on_a_fine_and_on_a_coarse_grid) {
  Dice dice(1);
  std::array<std::array<int, 2>, 3> counts{};
  for (int round = 0; round < 1500; ++round) {
    const int shared = round % 3, below = round % 2 == 0 ? 3 : 6;
    Triangle4 a, b;
    for (Vec4& p : a) p = dice.point(below);
    for (Vec4& p : b) p = dice.point(below);
    // Triangles in a common plane, or in one of three dimensions, are rare otherwise.
    if (round % 4 < 2)
      for (Triangle4* const t : {&a, &b})
        for (Vec4& p : *t) p[3] = round % 4 == 0 ? p[0] : 0;
    if (round % 8 == 0)
      for (Triangle4* const t : {&a, &b})
        for (Vec4& p : *t) p[2] = p[0] + p[1];
    for (int k = 0; k < shared; ++k) b[k] = a[k];
    if (degenerate(a) || degenerate(b)) continue;
    const bool meet = meet_by_enumeration(a, b, shared);
    ++counts[shared][meet ? 1 : 0];
    ASSERT_EQ(triangles_meet(a, b, shared), meet) << "round " << round;
    if (shared < 2) {
      ASSERT_EQ(triangles_meet(b, a, shared), meet) << "round " << round;
    }
  }
  for (const auto& count : counts)
    for (const int some : count) EXPECT_GT(some, 10);
}

TEST(Triangles4, a_last_digit_decides) {
  // A corner of b lies in the plane of a, and by one unit in the last place beside it.
  const Triangle4 a{Vec4(0, 0, 0, 0), Vec4(3, 0, 0, 1), Vec4(0, 3, 1, 0)};
  const Vec4 inside = (a[0] + a[1] + a[2]) / 3;  // (1, 1, 1/3, 1/3): thirds are rounded
  Triangle4 b{Vec4(1, 1, 0.25, 0.25), Vec4(5, 1, 7, 2), Vec4(1, 6, 2, -7)};
  b[0] = (a[0] + a[1] / 2 + a[2] / 2);  // exact
  EXPECT_TRUE(triangles_meet(a, b, 0));
  for (int k = 0; k < 4; ++k)
    for (const double direction : {-10.0, 10.0}) {
      Triangle4 moved = b;
      moved[0][k] = std::nextafter(b[0][k], direction);
      // In R^4 any motion of the corner takes it off the triangle or along it; the rest of b leads away from a.
      const bool meets = triangles_meet(a, moved, 0);
      const double off = std::abs(moved[0][2] * 3 - moved[0][1]) + std::abs(moved[0][3] * 3 - moved[0][0]);
      if (meets) {
        EXPECT_LT(off, 1e-15);
      }
    }
  EXPECT_FALSE(triangles_meet(a, {inside, b[1], b[2]}, 0));  // rounded beside the triangle
}

TEST(Triangles4, crossings_are_signed_and_placed) {
  const Triangle4 a{Vec4(-1, -1, 0, 0), Vec4(2, -1, 0, 0), Vec4(-1, 2, 0, 0)};
  const Triangle4 b{Vec4(0, 0, -1, -1), Vec4(0, 0, 2, -1), Vec4(0, 0, -1, 2)};
  EXPECT_TRUE(triangles_meet(a, b, 0));
  EXPECT_EQ(crossing_sign(a, b), 1);
  EXPECT_EQ(crossing_sign(b, a), 1);  // surfaces have even dimension
  EXPECT_EQ(crossing_sign(a, {b[1], b[0], b[2]}), -1);
  EXPECT_EQ(crossing_sign(a, a), 0);
  EXPECT_LT(crossing_point(a, b).norm(), 1e-15);
}

TEST(Triangles4, the_nearest_point_is_no_farther_than_any_other) {
  Dice dice(2);
  for (int round = 0; round < 500; ++round) {
    std::array<Vec4, 9> points;
    const int count = 1 + round % 9;
    for (int k = 0; k < count; ++k) points[k] = dice.point(40).array() - (round % 2 == 0 ? 5 : 20);
    std::array<double, 9> weights;
    const Vec4 x = nearest_to_origin(points, count, weights);
    Vec4 sum = Vec4::Zero();
    double total = 0;
    for (int k = 0; k < count; ++k) {
      EXPECT_GE(weights[k], 0);
      sum += weights[k] * points[k];
      total += weights[k];
      // All points are beyond the plane through x across it, up to rounding.
      EXPECT_GE(points[k].dot(x), x.squaredNorm() - 1e-9) << round;
    }
    EXPECT_NEAR(total, 1, 1e-12);
    EXPECT_LT((sum - x).norm(), 1e-9);
  }
}

}  // namespace
}  // namespace unsnarl
