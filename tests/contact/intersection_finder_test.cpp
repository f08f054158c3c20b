// Against oracles: intersections_oracle_test.cpp. Here: what the interface promises, on cases made by hand and on one
// that is large enough for several tasks.
#include "contact/intersection_finder.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <cmath>

namespace unsnarl {
namespace {

Positions columns(std::initializer_list<Vec3> points) {
  Positions x(3, static_cast<Index>(points.size()));
  Index v = 0;
  for (const Vec3& p : points) x.col(v++) = p;
  return x;
}

TEST(IntersectionFinder, classes_by_what_the_faces_share) {
  const Positions x =
      columns({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 1}, {1, 1, -1}, {2, 1, 1}, {1, 2, 0}, {3, 0, 0}});
  const Triangle base = {0, 1, 2};
  const auto kind_of = [&](const Triangle& other) {
    PairClass kind = PairClass::disjoint, turned = PairClass::disjoint;
    EXPECT_TRUE(intersects(x, base, other, kind));
    EXPECT_TRUE(intersects(x, other, base, turned));
    EXPECT_EQ(kind, turned);
    return kind;
  };
  EXPECT_EQ(kind_of({3, 4, 5}), PairClass::disjoint);
  EXPECT_EQ(kind_of({0, 3, 4}), PairClass::one_vertex);
  EXPECT_EQ(kind_of({0, 1, 6}), PairClass::folded);
  EXPECT_EQ(kind_of({2, 1, 0}), PairClass::duplicate);
  EXPECT_EQ(kind_of({3, 3, 4}), PairClass::degenerate);
  EXPECT_EQ(kind_of({0, 7, 7}), PairClass::degenerate);
  PairClass kind;
  EXPECT_FALSE(intersects(x, base, {1, 0, 3}, kind)) << "neighbours over an edge";
  EXPECT_FALSE(intersects(x, {0, 1, 3}, {0, 2, 4}, kind)) << "neighbours at a vertex";
}

// Two wavy sheets of 2 * 70^2 faces each that run through each other.
struct WavySheets {
  Positions x;
  std::vector<Triangle> triangles;

  explicit WavySheets(double height) {
    constexpr Index n = 70, row = n + 1;
    x.resize(3, 2 * row * row);
    for (Index s = 0; s < 2; ++s)
      for (Index i = 0; i <= n; ++i)
        for (Index j = 0; j <= n; ++j)
          x.col((s * row + i) * row + j) =
              Vec3(i + 0.31 * s, j + 0.17 * s, s * height + (s ? 1 : -1) * std::sin(0.21 * i) * std::cos(0.17 * j));
    for (Index s = 0; s < 2; ++s)
      for (Index i = 0; i < n; ++i)
        for (Index j = 0; j < n; ++j) {
          const Index a = (s * row + i) * row + j;
          triangles.push_back({a, a + row, a + row + 1});
          triangles.push_back({a, a + row + 1, a + 1});
        }
  }
};

TEST(IntersectionFinder, sorted_and_the_same_at_any_thread_count) {
  const WavySheets sheets(0.5);
  std::vector<IntersectingPair> expected;
  for (const std::size_t threads : {1, 2, 4}) {
    const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, threads);
    const auto found = IntersectionFinder(sheets.triangles).find(sheets.x);
    EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
    EXPECT_TRUE(std::adjacent_find(found.begin(), found.end()) == found.end());
    if (threads == 1) expected = found;
    EXPECT_TRUE(found == expected) << threads << " threads";
  }
  EXPECT_GT(expected.size(), 100u);
}

TEST(IntersectionFinder, any_is_whether_there_is_one) {
  const WavySheets crossing(1.99), apart(2.5);
  IntersectionFinder finder(crossing.triangles);
  EXPECT_TRUE(finder.any(crossing.x));
  EXPECT_FALSE(finder.any(apart.x));
  EXPECT_TRUE(finder.find(apart.x).empty());
  EXPECT_TRUE(finder.any(crossing.x));
}

TEST(IntersectionFinder, obstacles_do_not_count_among_themselves) {
  const WavySheets sheets(0.5);
  const auto all = IntersectionFinder(sheets.triangles).find(sheets.x);
  for (const Index active : {0, 4000, 9800}) {
    auto expected = all;
    std::erase_if(expected, [&](const IntersectingPair& pair) { return pair.a >= active; });
    IntersectionFinder finder(sheets.triangles, active);
    EXPECT_TRUE(finder.find(sheets.x) == expected);
    EXPECT_EQ(finder.any(sheets.x), !expected.empty());
  }
}

}  // namespace
}  // namespace unsnarl
