#include "applications/isotopy/general_position.h"

#include <gtest/gtest.h>

#include <cmath>

namespace unsnarl {
namespace {

/// A comb, whose teeth end on one line and begin on another.
Points2 comb_in_lines(int teeth) {
  std::vector<double> p{0, 0, 2.0 * teeth - 1, 0};
  for (int k = teeth; k-- > 0;) {
    p.insert(p.end(), {2.0 * k + 1, 10, 2.0 * k, 10});
    if (k > 0) p.insert(p.end(), {2.0 * k, 1, 2.0 * k - 1, 1});
  }
  return Eigen::Map<const Points2>(p.data(), 2, static_cast<Eigen::Index>(p.size() / 2));
}

Corners corners_of(const Points2& x) {
  Corners c;
  c.x = x;
  const auto n = static_cast<Index>(x.cols());
  for (Index v = 0; v < n; ++v) {
    c.before.push_back((v + n - 1) % n);
    c.after.push_back((v + 1) % n);
  }
  c.is_corner.assign(n, 1);
  c.polygon.assign(n, 0);
  c.count = {n};
  return c;
}

double area_of_triple(const Points2& x, Index i, Index j, Index k) {
  const Vec2 a = x.col(j) - x.col(i), b = x.col(k) - x.col(i);
  return std::abs(a.x() * b.y() - a.y() * b.x());
}

std::size_t triples_in_line(const Points2& x) {
  std::size_t count = 0;
  const auto n = static_cast<Index>(x.cols());
  for (Index i = 0; i < n; ++i)
    for (Index j = i + 1; j < n; ++j)
      for (Index k = j + 1; k < n; ++k) count += area_of_triple(x, i, j, k) < 1e-7;
  return count;
}

TEST(GeneralPosition, no_three_corners_are_in_line_and_nothing_is_crossed) {
  const Points2 start = comb_in_lines(6);
  EXPECT_GT(triples_in_line(start), 100U);
  const Points2 end = in_general_position(corners_of(start), [] { return false; });
  EXPECT_EQ(triples_in_line(end), 0U);
  EXPECT_LT((end - start).colwise().norm().maxCoeff(), 0.02);  // edges are 1 apart
  EXPECT_GT((end - start).colwise().norm().minCoeff(), 1e-5);
}

TEST(GeneralPosition, little_room_is_little_motion) {
  Points2 slit(2, 8);  // a square with a slit whose sides are 1e-6 apart
  slit << 0, 5, 5, 5 + 1e-6, 5 + 1e-6, 10, 10, 0, 0, 0, 8, 8, 0, 0, 9, 9;
  const Points2 end = in_general_position(corners_of(slit), [] { return false; });
  EXPECT_LE((end - slit).middleCols(1, 4).colwise().norm().maxCoeff(), 0.02e-6);
  EXPECT_GT((end - slit).col(6).norm(), 1e-4);
}

TEST(GeneralPosition, nothing_moves_when_it_is_stopped) {
  const Points2 start = comb_in_lines(3);
  EXPECT_EQ(in_general_position(corners_of(start), [] { return true; }), start);
}

}  // namespace
}  // namespace unsnarl
