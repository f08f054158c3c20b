#include "contact/closed_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "contact/dice.h"

namespace unsnarl {
namespace {

/// A box from 0 to `size`, of twelve triangles over the vertices from `first` on.
std::vector<Triangle> box_triangles(Index first) {
  std::vector<Triangle> triangles;
  for (const auto& q :
       {std::array<Index, 4>{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
    triangles.push_back({first + q[0], first + q[1], first + q[2]});
    triangles.push_back({first + q[0], first + q[2], first + q[3]});
  }
  return triangles;
}
void add_box(double lo, double hi, Positions& x) {
  const Index first = static_cast<Index>(x.cols());
  x.conservativeResize(3, first + 8);
  for (int i = 0; i < 8; ++i) x.col(first + i) = Vec3(i & 1 ? hi : lo, i & 2 ? hi : lo, i & 4 ? hi : lo);
}

Side side_of_box(double lo, double hi, const Vec3& p) {
  if (p.minCoeff() < lo || p.maxCoeff() > hi) return Side::outside;
  return p.minCoeff() == lo || p.maxCoeff() == hi ? Side::on : Side::inside;
}

TEST(ClosedSurface, points_of_a_lattice_are_told_from_those_on_faces_edges_and_vertices) {
  Positions x(3, 0);
  add_box(-2, 2, x);
  std::vector<Triangle> triangles = box_triangles(0);
  for (std::size_t t = 0; t < triangles.size(); t += 3) std::swap(triangles[t][0], triangles[t][1]);
  ClosedSurface box(triangles);
  box.update(x);
  for (int i = -6; i <= 6; ++i)
    for (int j = -6; j <= 6; ++j)
      for (int k = -6; k <= 6; ++k) {
        const Vec3 p = Vec3(i, j, k) / 2;
        ASSERT_EQ(box.side_of(p), side_of_box(-2, 2, p)) << p.transpose();
      }
}

TEST(ClosedSurface, what_lies_in_a_hollow_is_outside) {
  Positions x(3, 0);
  add_box(-4, 4, x);
  add_box(-2, 2, x);
  std::vector<Triangle> triangles = box_triangles(0);
  const std::vector<Triangle> hollow = box_triangles(8);
  triangles.insert(triangles.end(), hollow.begin(), hollow.end());
  ClosedSurface shell(triangles);
  shell.update(x);
  EXPECT_EQ(shell.side_of({0, 0, 0}), Side::outside);
  EXPECT_EQ(shell.side_of({3, 0, 0}), Side::inside);
  EXPECT_EQ(shell.side_of({2, 1, -1}), Side::on);
  EXPECT_EQ(shell.side_of({5, 0, 0}), Side::outside);
}

/// An octahedron moved at random: in general position, and with coordinates of a lattice that make rays meet edges.
TEST(ClosedSurface, agrees_with_the_planes_of_a_convex_solid) {
  const std::vector<Triangle> triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                           {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  Positions x(3, 6);
  x << 3, -3, 0, 0, 0, 0, 0, 0, 3, -3, 0, 0, 0, 0, 0, 0, 3, -3;
  ClosedSurface octahedron(triangles);
  octahedron.update(x);
  Dice dice(7);
  for (int k = 0; k < 4000; ++k) {
    const Vec3 p = k % 2 == 0 ? dice.lattice(4) : Vec3(4 * dice.vector());
    const double sum = p.cwiseAbs().sum();
    if (k % 2 == 1 && std::abs(sum - 3) < 1e-12) continue;
    ASSERT_EQ(octahedron.side_of(p), sum < 3 ? Side::inside : sum > 3 ? Side::outside : Side::on) << p.transpose();
  }
}

TEST(ClosedSurface, lines_of_a_lattice_are_inside_between_their_crossings) {
  Positions x(3, 0);
  add_box(-2, 2, x);
  add_box(-1, 1, x);
  std::vector<Triangle> triangles = box_triangles(0);
  const std::vector<Triangle> hollow = box_triangles(8);
  triangles.insert(triangles.end(), hollow.begin(), hollow.end());
  ClosedSurface shell(triangles);
  shell.update(x);
  EXPECT_EQ(shell.crossings(1.5, 0), (std::vector<double>{-2, 2}));
  EXPECT_EQ(shell.crossings(0, 0.25), (std::vector<double>{-2, -1, 1, 2}));
  EXPECT_TRUE(shell.crossings(3, 0).empty());
  for (int j = -6; j <= 6; ++j)
    for (int k = -6; k <= 6; ++k) EXPECT_EQ(shell.crossings(j / 2.0, k / 2.0).size() % 2, 0u) << j << ' ' << k;
}

TEST(ClosedSurface, the_nearest_triangle_is_that_of_brute_force) {
  Dice dice(3);
  Positions x(3, 60);
  for (Index v = 0; v < 60; ++v) x.col(v) = dice.vector();
  std::vector<Triangle> triangles;
  for (Index t = 0; t < 40; ++t) triangles.push_back({dice.integer(0, 19), dice.integer(20, 39), dice.integer(40, 59)});
  ClosedSurface surface(triangles);
  surface.update(x);
  for (int k = 0; k < 200; ++k) {
    const Vec3 p = 3 * dice.vector();
    const auto even = [](Index t) { return t % 2 == 0; };
    double least = std::numeric_limits<double>::infinity(), least_even = least;
    for (Index t = 0; t < 40; ++t) {
      const double d =
          closest_vertex_face(p, x.col(triangles[t][0]), x.col(triangles[t][1]), x.col(triangles[t][2])).distance;
      least = std::min(least, d);
      if (even(t)) least_even = std::min(least_even, d);
    }
    EXPECT_EQ(surface.nearest(p, 1e-3).closest.distance, least);
    EXPECT_EQ(surface.nearest(p, 50).closest.distance, least);
    EXPECT_EQ(surface.nearest(p, 0).closest.distance, least);
    EXPECT_EQ(surface.nearest(p, 0.1, even).closest.distance, least_even);
    EXPECT_EQ(surface.nearest(p, 0.1, [](Index) { return false; }).triangle, -1);
  }
}

TEST(ClosedSurface, an_edge_of_an_odd_number_of_triangles_is_open) {
  std::vector<Triangle> triangles = box_triangles(0);
  EXPECT_EQ(first_open_edge(triangles), (Edge{-1, -1}));
  triangles.pop_back();
  EXPECT_EQ(first_open_edge(triangles), (Edge{1, 5}));
}

}  // namespace
}  // namespace unsnarl
