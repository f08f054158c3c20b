// Each function on cases made by hand and on cases whose answer is known by construction. All pairs that occur in
// meshes are compared with two oracles in tests/contact/intersections_oracle_test.cpp.
#include "geometry/triangle_intersection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace unsnarl {
namespace {

const TrianglePoints flat = {Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0)};

TrianglePoints rotated(const TrianglePoints& t, int by) {
  return {t[by % 3], t[(by + 1) % 3], t[(by + 2) % 3]};
}

// The answer may depend neither on the order of the two nor on that of their corners.
Meeting meeting_in_any_order(const TrianglePoints& a, const TrianglePoints& b) {
  const Meeting expected = triangles_meet(a, b);
  for (int k = 0; k < 3; ++k)
    for (int l = 0; l < 3; ++l) {
      TrianglePoints p = rotated(a, k), q = rotated(b, l);
      EXPECT_EQ(triangles_meet(p, q), expected);
      EXPECT_EQ(triangles_meet(q, p), expected);
      std::swap(p[1], p[2]);
      EXPECT_EQ(triangles_meet(p, q), expected);
    }
  return expected;
}

TEST(TriangleIntersection, segment_and_triangle) {
  EXPECT_TRUE(segment_meets_triangle({1, 1, -1}, {1, 1, 1}, flat)) << "through the inside";
  EXPECT_FALSE(segment_meets_triangle({3, 3, -1}, {3, 3, 1}, flat)) << "beside it";
  EXPECT_FALSE(segment_meets_triangle({1, 1, 2}, {1, 1, 1}, flat)) << "above it";
  EXPECT_TRUE(segment_meets_triangle({1, 1, 0}, {1, 1, 1}, flat)) << "an end in it";
  EXPECT_TRUE(segment_meets_triangle({2, 2, -1}, {2, 2, 1}, flat)) << "through an edge";
  EXPECT_TRUE(segment_meets_triangle({4, 0, -1}, {4, 0, 1}, flat)) << "through a corner";
  EXPECT_TRUE(segment_meets_triangle({-1, 1, 0}, {9, 1, 0}, flat)) << "within its plane, across";
  EXPECT_TRUE(segment_meets_triangle({1, 1, 0}, {1.5, 1, 0}, flat)) << "within its plane, inside";
  EXPECT_TRUE(segment_meets_triangle({4, 0, 0}, {9, 0, 0}, flat)) << "goes on from a corner along an edge's line";
  EXPECT_FALSE(segment_meets_triangle({5, 0, 0}, {9, 0, 0}, flat)) << "along the line of an edge, beyond it";
  EXPECT_FALSE(segment_meets_triangle({3, 3, 0}, {9, 1, 0}, flat)) << "within its plane, beside it";
  const double nearly = 2 + 0x1p-50;
  EXPECT_FALSE(segment_meets_triangle({2, nearly, -1}, {2, nearly, 1}, flat)) << "past an edge by two units";
}

TEST(TriangleIntersection, disjoint_triangles) {
  const auto meet = [](const TrianglePoints& b) { return meeting_in_any_order(flat, b); };
  EXPECT_EQ(meet({Vec3(1, 1, -1), Vec3(1, 1, 1), Vec3(9, 9, 0.5)}), Meeting::yes) << "pierced";
  EXPECT_EQ(meet({Vec3(1, 1, 0), Vec3(1, 1, 1), Vec3(9, 9, 1)}), Meeting::yes) << "touched by a corner";
  EXPECT_EQ(meet({Vec3(4, 0, 0), Vec3(9, 0, 1), Vec3(9, 0, 5)}), Meeting::yes) << "corner at corner";
  EXPECT_EQ(meet({Vec3(1, 1, 1), Vec3(2, 1, 1), Vec3(1, 2, 1)}), Meeting::no) << "parallel";
  EXPECT_EQ(meet({Vec3(1, 1, 0), Vec3(2, 1, 0), Vec3(1, 2, 0)}), Meeting::yes) << "flat inside";
  EXPECT_EQ(meet({Vec3(-9, -9, 0), Vec3(30, -9, 0), Vec3(-9, 30, 0)}), Meeting::yes) << "flat around";
  EXPECT_EQ(meet({Vec3(4, 4, 0), Vec3(2.5, 2, 0), Vec3(4, 3, 0)}), Meeting::no) << "flat beside";
  EXPECT_EQ(meet({Vec3(4, 4, 0), Vec3(2, 2, 0), Vec3(4, 3, 0)}), Meeting::yes) << "flat, touching an edge";
  EXPECT_EQ(meet({Vec3(5, 5, -1), Vec3(5, 5, 1), Vec3(2.5, 2.5, 0)}), Meeting::no) << "spans the plane, not the face";
  EXPECT_EQ(meet({Vec3(1, 1, 0), Vec3(2, 2, 0), Vec3(3, 3, 0)}), Meeting::ask_degenerate);
}

// A common point is chosen first and both triangles are laid around it without rounding: they meet.
TEST(TriangleIntersection, triangles_around_a_common_point_meet) {
  std::mt19937 random(1);
  const auto number = [&] { return static_cast<double>(random() % 2001) - 1000; };
  for (int round = 0; round < 5000; ++round) {
    const Vec3 p(number(), number(), number());
    const auto around = [&] {
      const Vec3 u(number(), number(), number()), v(number(), number(), number());
      return TrianglePoints{p + u, p + v, p - u - v};  // p is the centroid
    };
    const TrianglePoints a = around(), b = around();
    ASSERT_EQ(triangles_meet(a, b), Meeting::yes) << "round " << round;
  }
}

// On the two sides of a plane, the gap as small as one unit in the last place.
TEST(TriangleIntersection, triangles_on_two_sides_of_a_plane_do_not_meet) {
  std::mt19937 random(2);
  const auto number = [&] { return static_cast<double>(random() % 2001) / 7 - 100; };
  for (int round = 0; round < 5000; ++round) {
    const int axis = round % 3;
    const double level = number();
    const double above = std::nextafter(level, 1e9);
    TrianglePoints a, b;
    for (int k = 0; k < 3; ++k) {
      a[k] = Vec3(number(), number(), number());
      b[k] = Vec3(number(), number(), number());
      a[k][axis] = k == 0 ? level : std::min(a[k][axis], level);
      b[k][axis] = k == 0 ? above : std::max(b[k][axis], above);
    }
    ASSERT_EQ(triangles_meet(a, b), Meeting::no) << "round " << round;
  }
}

TEST(TriangleIntersection, separation_across_the_plane_and_within_it) {
  const auto is_apart = [](const TrianglePoints& b, double distance) {
    for (const double found : {separation(flat, b), separation(b, flat)}) {
      EXPECT_GT(found, 0);
      EXPECT_LE(found, distance);
    }
  };
  is_apart({Vec3(1, 1, 3), Vec3(2, 1, 3), Vec3(1, 2, 5)}, 3);
  is_apart({Vec3(6, 0, -1), Vec3(6, 0, 1), Vec3(9, 4, 0)}, 2);
  EXPECT_NEAR(separation(flat, {Vec3(-1, 1, 0), Vec3(-4, 1, 0), Vec3(-1, 9, 0)}), 1, 1e-12) << "in one plane";
  EXPECT_EQ(separation(flat, {Vec3(1, 1, -1), Vec3(1, 1, 1), Vec3(9, 9, 0.5)}), 0);
  EXPECT_EQ(separation(flat, {Vec3(1, 1, 0), Vec3(5, 5, 1), Vec3(5, 4, 1)}), 0) << "touched";
  const TrianglePoints needle = {Vec3(1, 1, 1), Vec3(2, 2, 2), Vec3(3, 3, 3)};
  EXPECT_GE(separation(needle, {Vec3(5, 0, 0), Vec3(9, 1, 0), Vec3(5, 1, 1)}), 0) << "a needle has no plane";
}

// No points of the two, on a grid, are nearer; at any scale, needles among them.
TEST(TriangleIntersection, separation_is_no_more_than_the_distance) {
  std::mt19937 random(4);
  const auto number = [&] { return static_cast<double>(random() % 2001) / 7 - 140; };
  int separated = 0;
  for (int round = 0; round < 20000; ++round) {
    const double scale = std::pow(10, round % 40 - 20), flatness = round % 3 == 0 ? 1e-9 : 1;
    TrianglePoints a, b;
    for (Vec3& p : a) p = scale * Vec3(number(), number(), flatness * number());
    for (Vec3& p : b) p = scale * Vec3(number(), number(), flatness * number() + (round % 5) * 10);
    const double apart = separation(a, b);
    if (apart == 0) continue;
    ++separated;
    ASSERT_EQ(triangles_meet(a, b), Meeting::no) << round;
    for (int i = 0; i <= 6; ++i)
      for (int j = 0; i + j <= 6; ++j)
        for (int k = 0; k <= 6; ++k)
          for (int l = 0; k + l <= 6; ++l) {
            const Vec3 p = a[0] + i / 6.0 * (a[1] - a[0]) + j / 6.0 * (a[2] - a[0]);
            const Vec3 q = b[0] + k / 6.0 * (b[1] - b[0]) + l / 6.0 * (b[2] - b[0]);
            ASSERT_LE(apart, (p - q).norm() * (1 + 1e-9)) << round;
          }
  }
  EXPECT_GT(separated, 2000);
}

TEST(TriangleIntersection, beyond_a_common_vertex) {
  const auto meet = [](const Vec3& p, const Vec3& q) {
    const Meeting there = triangles_meet_beyond_vertex(flat, {flat[0], p, q});
    EXPECT_EQ(triangles_meet_beyond_vertex({flat[0], p, q}, flat), there);
    EXPECT_EQ(triangles_meet_beyond_vertex({flat[0], q, p}, flat), there);
    return there;
  };
  EXPECT_EQ(meet({-1, 0, 1}, {0, -1, 1}), Meeting::no) << "only the vertex";
  EXPECT_EQ(meet({1, 1, 1}, {1, 1, -1}), Meeting::yes) << "a segment from the vertex inwards";
  EXPECT_EQ(meet({9, 9, 1}, {9, 9, -1}), Meeting::yes) << "right through";
  EXPECT_EQ(meet({-1, -1, 1}, {-1, -1, -1}), Meeting::no) << "its plane meets the face, it does not";
  EXPECT_EQ(meet({1, 1, 0}, {1, 1, 5}), Meeting::yes) << "an edge within the face";
  EXPECT_EQ(meet({9, 0, 0}, {1, 0, 5}), Meeting::yes) << "an edge along an edge";
  EXPECT_EQ(meet({1, 2, 0}, {2, 1, 0}), Meeting::yes) << "flat within";
  EXPECT_EQ(meet({-1, -2, 0}, {-2, -1, 0}), Meeting::no) << "flat on the other side";
  EXPECT_EQ(meet({-1, 0, 0}, {-1, -1, 0}), Meeting::no) << "an edge along the line of an edge, away";
  EXPECT_EQ(meet({1, 1, 0}, {2, 2, 0}), Meeting::ask_degenerate);
}

TEST(TriangleIntersection, folds_over_a_common_edge) {
  const auto fold = [](const Vec3& apex) { return triangles_fold_flat(flat, {flat[0], flat[1], apex}); };
  EXPECT_EQ(fold({1, -2, 0}), Meeting::no) << "opened flat";
  EXPECT_EQ(fold({1, 2, 0}), Meeting::yes) << "folded flat";
  EXPECT_EQ(fold({9, 2, 0}), Meeting::yes) << "folded flat, slanted";
  EXPECT_EQ(fold({1, 2, 5e-324}), Meeting::no) << "nearly folded flat";
  EXPECT_EQ(fold({1, 2, 3}), Meeting::no);
  EXPECT_EQ(fold({7, 0, 0}), Meeting::ask_degenerate);
}

TEST(TriangleIntersection, degenerate_faces_are_segments_and_points) {
  const std::array<int, 3> none = {-1, -1, -1};
  const TrianglePoints needle = {Vec3(1, 1, -1), Vec3(1, 1, 1), Vec3(1, 1, 0.3)};
  const TrianglePoints beside = {Vec3(5, 1, -1), Vec3(5, 1, 1), Vec3(5, 1, 0.3)};
  const TrianglePoints point = {Vec3(1, 1, 0), Vec3(1, 1, 0), Vec3(1, 1, 0)};
  EXPECT_TRUE(degenerate_triangles_meet(needle, flat, none));
  EXPECT_TRUE(degenerate_triangles_meet(flat, needle, none));
  EXPECT_FALSE(degenerate_triangles_meet(beside, flat, none));
  EXPECT_TRUE(degenerate_triangles_meet(point, flat, none));
  EXPECT_TRUE(degenerate_triangles_meet(point, needle, none));
  EXPECT_FALSE(degenerate_triangles_meet(point, beside, none));
  const TrianglePoints crossing = {Vec3(0, 1, 0.5), Vec3(2, 1, 0.5), Vec3(1, 1, 0.5)};
  const TrianglePoints passing = {Vec3(0, 1.1, 0.5), Vec3(2, 1.1, 0.5), Vec3(1, 1.1, 0.5)};
  EXPECT_TRUE(degenerate_triangles_meet(crossing, needle, none));
  EXPECT_FALSE(degenerate_triangles_meet(passing, needle, none));
  const TrianglePoints ahead = {Vec3(1, 1, 1), Vec3(1, 1, 2), Vec3(1, 1, 3)},
                       gone = {Vec3(1, 1, 2), Vec3(1, 1, 3), Vec3(1, 1, 4)};
  EXPECT_TRUE(degenerate_triangles_meet(needle, ahead, none)) << "end at end on one line";
  EXPECT_FALSE(degenerate_triangles_meet(needle, gone, none)) << "apart on one line";
}

TEST(TriangleIntersection, degenerate_faces_with_common_corners) {
  // A segment from a corner of the face: outwards, inwards, along an edge.
  const auto from_corner = [](const Vec3& middle, const Vec3& end) {
    const TrianglePoints needle = {flat[0], middle, end};
    const bool there = degenerate_triangles_meet(needle, flat, {0, -1, -1});
    EXPECT_EQ(degenerate_triangles_meet(flat, needle, {0, -1, -1}), there);
    return there;
  };
  EXPECT_FALSE(from_corner({-1, -1, 0}, {-2, -2, 0}));
  EXPECT_FALSE(from_corner({1, 1, 1}, {2, 2, 2}));
  EXPECT_TRUE(from_corner({1, 1, 0}, {2, 2, 0}));
  EXPECT_TRUE(from_corner({1, 0, 0}, {2, 0, 0}));
  EXPECT_TRUE(from_corner({-1, -1, 0}, {2, 2, 0})) << "the common corner in its middle";
  // A cap: its long side is the common edge, its apex lies on it.
  EXPECT_FALSE(degenerate_triangles_meet({flat[0], flat[1], Vec3(2, 0, 0)}, flat, {0, 1, -1}));
  EXPECT_FALSE(degenerate_triangles_meet({flat[0], flat[1], Vec3(6, 0, 0)}, flat, {0, 1, -1})) << "past the edge";
  EXPECT_TRUE(degenerate_triangles_meet({flat[0], Vec3(1, 1, 0), Vec3(2, 2, 0)}, flat, {0, -1, -1}));
}

}  // namespace
}  // namespace unsnarl
