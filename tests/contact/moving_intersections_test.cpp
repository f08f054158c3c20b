// MovingIntersections and NearPairs against what is found anew.
#include "contact/moving_intersections.h"
#include "geometry/parallel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "contact/intersection_finder.h"

namespace unsnarl {
namespace {

/// Two sheets of n x n quads, cut along alternating diagonals, that cross each other.
struct Sheets {
  Positions x;
  std::vector<Triangle> triangles;

  explicit Sheets(Index n) {
    const Index row = n + 1;
    x.resize(3, 2 * row * row);
    for (Index s = 0; s < 2; ++s)
      for (Index i = 0; i <= n; ++i)
        for (Index j = 0; j <= n; ++j) {
          const Index a = (s * row + i) * row + j;
          x.col(a) = Vec3(i + 0.3 * s, j + 0.2 * s, (s ? -1 : 1) * std::sin(0.4 * i) * std::cos(0.3 * j));
          if (i == n || j == n) continue;
          if ((i + j) % 2) {
            triangles.insert(triangles.end(), {{a, a + row, a + row + 1}, {a, a + row + 1, a + 1}});
          } else {
            triangles.insert(triangles.end(), {{a, a + row, a + 1}, {a + 1, a + row, a + row + 1}});
          }
        }
  }
};

/// Moves all vertices, some of them far.
void move(Positions& x, double step, std::mt19937& random) {
  const auto uniform = [&] { return static_cast<double>(random()) / 2147483648.0 - 1; };
  for (Index v = 0; v < x.cols(); ++v) {
    const double here = random() % 16 == 0 ? 8 * step : step;
    x.col(v) += here * Vec3(uniform(), uniform(), uniform());
  }
}

TEST(MovingIntersections, finds_what_is_found_anew) {
  for (const double step : {0.002, 0.03, 0.3}) {
    const Sheets sheets(40);
    Positions x = sheets.x;
    const Index count = static_cast<Index>(sheets.triangles.size()), active = count * 3 / 4;
    MovingIntersections moving(sheets.triangles, active, static_cast<Index>(x.cols()));
    std::mt19937 random(3);
    std::size_t least = 1000000;
    for (int round = 0; round < 12; ++round) {
      const auto found = moving.find(x);
      EXPECT_TRUE(found == IntersectionFinder(sheets.triangles, active).find(x)) << step << ", round " << round;
      least = std::min(least, found.size());
      move(x, step, random);
    }
    EXPECT_GT(least, 20u);
  }
}

// Sheets that drift far, turn and ripple: slivers, far from the origin. Most pairs are near each other all the time and
// move together.
TEST(MovingIntersections, finds_what_is_found_anew_on_sheets_that_drift) {
  for (const double flat : {1.0, 0.02})
    for (const double far : {0.0, 1e6}) {
      const Sheets sheets(30);
      const Index count = static_cast<Index>(sheets.triangles.size()), vertices = static_cast<Index>(sheets.x.cols());
      const Vec3 shape(1, flat, 1), at(far, -far, 0.5 * far);
      MovingIntersections moving(sheets.triangles, count, vertices);
      Positions x(3, vertices);
      std::size_t changes = 0;
      std::vector<IntersectingPair> last;
      for (int round = 0; round < 40; ++round) {
        const double t = 0.02 * round;
        for (Index v = 0; v < vertices; ++v) {
          const Vec3 p = sheets.x.col(v);
          const Vec3 moved(p[0] + 3 * t, p[1] + 0.1 * t * p[0],
                           p[2] + (v < vertices / 2 ? t : -t) * std::cos(0.7 * p[0]));
          x.col(v) = moved.cwiseProduct(shape) + at;
        }
        const auto found = moving.find(x);
        ASSERT_TRUE(found == IntersectionFinder(sheets.triangles).find(x)) << flat << ' ' << far << ", round " << round;
        changes += round > 0 && !(found == last);
        last = found;
      }
      EXPECT_GT(changes, 30u);
    }
}

// Tiny integers: touching, folded flat, duplicate and zero-area faces; vertices of many faces, of several fans.
TEST(MovingIntersections, finds_what_is_found_anew_among_degenerate_faces) {
  std::mt19937 random(11);
  for (int round = 0; round < 300; ++round) {
    const Index vertices = 6 + static_cast<Index>(random() % 20);
    std::vector<Triangle> triangles(5 + random() % 40);
    for (Triangle& t : triangles)
      for (Index& v : t) v = static_cast<Index>(random() % vertices);
    Positions x(3, vertices);
    for (double& c : x.reshaped()) c = static_cast<int>(random() % 4);
    const Index active = static_cast<Index>(random() % (triangles.size() + 1));
    MovingIntersections moving(triangles, active, vertices);
    for (int step = 0; step < 4; ++step) {
      ASSERT_TRUE(moving.find(x) == IntersectionFinder(triangles, active).find(x)) << round;
      for (double& c : x.reshaped())
        if (random() % 4 == 0) c = static_cast<int>(random() % 4);
    }
  }
}

TEST(MovingIntersections, the_same_at_any_thread_count) {
  const Sheets sheets(80);
  std::vector<std::vector<IntersectingPair>> expected;
  for (const std::size_t threads : {1, 2, 4}) {
    const ThreadLimit limit(threads);
    Positions x = sheets.x;
    MovingIntersections moving(sheets.triangles, static_cast<Index>(sheets.triangles.size()),
                               static_cast<Index>(x.cols()));
    std::mt19937 random(5);
    for (std::size_t round = 0; round < 4; ++round) {
      const auto found = moving.find(x);
      if (threads == 1) expected.push_back(found);
      EXPECT_TRUE(found == expected[round]) << threads << " threads";
      move(x, 0.03, random);
    }
  }
}

TEST(NearPairs, lists_all_whose_boxes_overlap_once_and_in_the_same_order_at_any_thread_count) {
  const Sheets sheets(24);
  const Index count = static_cast<Index>(sheets.triangles.size()), active = count / 2;
  std::vector<std::vector<NearPairs::Pair>> expected;
  for (const std::size_t threads : {1, 4}) {
    const ThreadLimit limit(threads);
    Positions x = sheets.x;
    NearPairs near(sheets.triangles, active);
    std::mt19937 random(9);
    for (std::size_t round = 0; round < 6; ++round) {
      near.update(x);
      const std::vector<NearPairs::Pair> pairs(near.pairs().begin(), near.pairs().end());
      if (threads == 1) expected.push_back(pairs);
      EXPECT_TRUE(pairs == expected[round]) << threads << " threads";
      const std::set<NearPairs::Pair> listed(pairs.begin(), pairs.end());
      EXPECT_EQ(listed.size(), pairs.size());
      for (Index b = 0; b < count; ++b)
        for (Index a = 0; a < std::min(b, active); ++a) {
          const Triangle &s = sheets.triangles[a], &t = sheets.triangles[b];
          const bool joined =
              std::any_of(s.begin(), s.end(), [&](Index v) { return std::count(t.begin(), t.end(), v) > 0; });
          if (joined || !box_of(x, s).overlaps(box_of(x, t))) continue;
          EXPECT_TRUE(listed.contains({a, b})) << a << ' ' << b;
        }
      move(x, 0.02, random);
    }
  }
}

TEST(NearPairs, boxes_that_are_points_have_no_room_but_neighbours) {
  const std::vector<Triangle> triangles = {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}};
  Positions x = Positions::Zero(3, 9);
  x.rightCols(3).row(0).setConstant(5);
  NearPairs near(triangles, 3);
  for (const double there : {5., 0., 5.}) {
    x.rightCols(3).row(0).setConstant(there);
    near.update(x);
    std::vector<NearPairs::Pair> pairs(near.pairs().begin(), near.pairs().end());
    std::sort(pairs.begin(), pairs.end());
    const std::vector<NearPairs::Pair> all = {{0, 1}, {0, 2}, {1, 2}}, first = {{0, 1}};
    EXPECT_TRUE(pairs == (there == 0 ? all : first));
  }
}

}  // namespace
}  // namespace unsnarl
