#include "untangle/local/contours.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <set>

#include "geometry/triangle_intersection.h"
#include "scene/shapes.h"

namespace unsnarl {
namespace {

using shapes::Shape;

// Two sheets; vertices and triangles of the first come first.
struct TwoSheets {
  Shape shape;
  Index first_vertices = 0;
  EdgeTable edges;

  TwoSheets(const Shape& a, const Shape& b) : shape(a), first_vertices(static_cast<Index>(a.points.size())) {
    shape.add(b);
    // Triangles in no order, so that either sheet may hold the first of a pair.
    const std::vector<Triangle> ordered = shape.triangles;
    for (std::size_t k = 0; k < ordered.size(); ++k) shape.triangles[k] = ordered[k * 7919 % ordered.size()];
    edges = build_edges(shape.triangles);
  }
  bool on_first(const Crossing& c) const { return edges.edges[c.edge][0] < first_vertices; }
  Contours contours() const {
    return trace_contours(shape.positions(), shape.triangles, edges, shapes::pairs_of(shape));
  }
};

Shape turned(const Shape& shape, double angle, const Vec3& axis, const Vec3& offset) {
  Shape result;
  const Eigen::AngleAxisd rotation(angle, axis.normalized());
  for (const Vec3& p : shape.points) result.points.push_back(rotation * p + offset);
  result.triangles = shape.triangles;
  return result;
}

TwoSheets crossing_planes() {
  return {shapes::bumpy_sheet(7, 0), turned(shapes::bumpy_sheet(5, 0.4, 3), 1.1, {1, 0.3, 0.2}, {0.113, 0.271, 0.057})};
}
// Two closed curves: the tube enters the sheet... twice, on its way down and up again.
TwoSheets crossing_tubes() {
  return {shapes::tube(12, 14, 2.1), turned(shapes::tube(13, 11, 0.9), 1.4, {0.1, 0.2, 1}, {0.123, 0.077, 0.21})};
}

Vec3 point_on_edge(const TwoSheets& sheets, const Crossing& c) {
  const auto [u, v] = sheets.edges.edges[c.edge];
  return (1 - c.along) * sheets.shape.points[u] + c.along * sheets.shape.points[v];
}

TEST(Contours, crossings_lie_on_their_edge_and_their_face) {
  for (const TwoSheets& sheets : {crossing_planes(), crossing_tubes()}) {
    const Contours contours = sheets.contours();
    ASSERT_GT(contours.crossings.size(), 5u);
    EXPECT_TRUE(contours.uncrossed.empty());
    for (const Crossing& c : contours.crossings) {
      const Triangle& t = sheets.shape.triangles[c.face];
      Vec3 on_face = Vec3::Zero();
      for (int k = 0; k < 3; ++k) {
        EXPECT_GE(c.weights[k], 0);
        on_face += c.weights[k] * sheets.shape.points[t[k]];
      }
      EXPECT_NEAR((on_face - point_on_edge(sheets, c)).norm(), 0, 1e-12);
      EXPECT_GE(c.along, 0);
      EXPECT_LE(c.along, 1);
    }
  }
}

TEST(Contours, find_every_edge_that_pierces_a_face) {
  const TwoSheets sheets = crossing_planes();
  const Positions x = sheets.shape.positions();
  std::set<std::pair<Index, Index>> expected, found;
  for (Index e = 0; e < static_cast<Index>(sheets.edges.edges.size()); ++e)
    for (Index t = 0; t < static_cast<Index>(sheets.shape.triangles.size()); ++t) {
      const auto [u, v] = sheets.edges.edges[e];
      const Triangle& f = sheets.shape.triangles[t];
      if ((u < sheets.first_vertices) == (f[0] < sheets.first_vertices)) continue;
      if (segment_meets_triangle(x.col(u), x.col(v), {x.col(f[0]), x.col(f[1]), x.col(f[2])})) expected.insert({e, t});
    }
  const Contours contours = sheets.contours();
  for (const Crossing& c : contours.crossings) EXPECT_TRUE(found.insert({c.edge, c.face}).second);
  EXPECT_TRUE(found == expected);
}

TEST(Contours, curves_are_counted_and_their_two_sheets_told_apart) {
  const TwoSheets planes = crossing_planes(), tubes = crossing_tubes();
  EXPECT_EQ(planes.contours().count, 1);
  EXPECT_EQ(tubes.contours().count, 2);
  for (const TwoSheets* sheets : {&planes, &tubes}) {
    const Contours contours = sheets->contours();
    std::vector<int> side_of_first(contours.count, 0);
    for (const Crossing& c : contours.crossings) {
      const int side = sheets->on_first(c) ? c.side : -c.side;
      if (side_of_first[c.contour] == 0) side_of_first[c.contour] = side;
      EXPECT_EQ(side, side_of_first[c.contour]) << "an edge of one sheet has the side of the other";
    }
    for (const int side : side_of_first) EXPECT_NE(side, 0);
  }
}

// One sheet bent into itself: the two sides of its curve are opposite although they hang together.
TEST(Contours, a_sheet_that_runs_through_itself_has_two_sides_along_its_curve) {
  const TwoSheets loop(shapes::grid(24, 4, false,
                                    [](double i, double j) {
                                      const double t = (i + 0.37) / 24 * 3 - 1.55;
                                      return Vec3(t * t * t - 1.3 * t, 0.5 * j + 0.013 * i, 2 * t * t);
                                    }),
                       Shape{});
  const Contours contours = loop.contours();
  EXPECT_EQ(contours.count, 1);
  int sides[2] = {0, 0};
  for (const Crossing& c : contours.crossings) {
    // The sheet's two passages: columns before and after the middle of the loop.
    const bool early = loop.edges.edges[c.edge][0] / 5 < 12;
    EXPECT_EQ(early ? c.side : -c.side,
              contours.crossings[0].side * (loop.edges.edges[contours.crossings[0].edge][0] / 5 < 12 ? 1 : -1));
    ++sides[c.side > 0];
  }
  EXPECT_GT(sides[0], 0);
  EXPECT_GT(sides[1], 0);
}

// Length of the intersection curve, pair by pair.
double contour_length(const Positions& x, const std::vector<Triangle>& triangles, Index first_vertices) {
  double length = 0;
  for (const IntersectingPair& pair : shapes::pairs_at(x, triangles)) {
    std::vector<Vec3> ends;
    for (const auto& [p, q] : {std::pair(pair.a, pair.b), std::pair(pair.b, pair.a)}) {
      EXPECT_NE(triangles[p][0] < first_vertices, triangles[q][0] < first_vertices);
      const Vec3 a = x.col(triangles[q][0]), b = x.col(triangles[q][1]), c = x.col(triangles[q][2]);
      const Vec3 normal = (b - a).cross(c - a);
      for (int k = 0; k < 3; ++k) {
        const Vec3 u = x.col(triangles[p][k]), v = x.col(triangles[p][(k + 1) % 3]);
        if (!segment_meets_triangle(u, v, {a, b, c})) continue;
        const double hu = normal.dot(u - a), hv = normal.dot(v - a);
        ends.push_back(u + hu / (hu - hv) * (v - u));
      }
    }
    EXPECT_EQ(ends.size(), 2u);
    length += (ends.front() - ends.back()).norm();
  }
  return length;
}

// An edge of the first sheet moves along with it, an edge of the second against it relative to the face it pierces.
TEST(Contours, directions_are_the_gradient_of_the_length) {
  for (const TwoSheets& sheets : {crossing_planes(), crossing_tubes()}) {
    const Positions x = sheets.shape.positions();
    Vec3 force = Vec3::Zero();
    for (const Crossing& c : sheets.contours().crossings) {
      ASSERT_LT(c.direction.norm(), 3.9) << "the limit is at work: the test needs another position";
      force += (sheets.on_first(c) ? 1 : -1) * c.direction;
    }
    const double step = 1e-6;
    for (int k = 0; k < 3; ++k) {
      Positions plus = x, minus = x;
      for (Index v = 0; v < sheets.first_vertices; ++v) plus(k, v) += step, minus(k, v) -= step;
      const double slope = (contour_length(plus, sheets.shape.triangles, sheets.first_vertices) -
                            contour_length(minus, sheets.shape.triangles, sheets.first_vertices)) /
                           (2 * step);
      EXPECT_NEAR(-0.5 * force[k], slope, 1e-6 * (1 + std::abs(slope))) << "coordinate " << k;
    }
  }
}

TEST(Contours, normals_are_those_of_the_two_sheets) {
  for (const TwoSheets& sheets : {crossing_planes(), crossing_tubes()}) {
    const Positions x = sheets.shape.positions();
    const auto normal_of = [&](Index t) { return triangle_normal(x, sheets.shape.triangles[t]); };
    for (const Crossing& c : sheets.contours().crossings) {
      const Vec3 of_face = c.normals[c.side > 0], of_edge = c.normals[c.side < 0];
      EXPECT_NEAR((of_face - normal_of(c.face)).norm(), 0, 1e-12);
      EXPECT_NEAR(of_edge.norm(), 1, 1e-12);
      // The normal is the mean of those faces of the edge that meet the pierced one.
      double closest = -1;
      for (Index t = 0; t < static_cast<Index>(sheets.shape.triangles.size()); ++t)
        for (Index e : sheets.edges.edges_of_triangle[t])
          if (e == c.edge) closest = std::max(closest, of_edge.dot(normal_of(t)));
      EXPECT_GT(closest, 0.9);
    }
  }
}

TEST(Contours, flat_overlaps_have_no_crossing) {
  Shape shape;
  shape.points = {Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0), Vec3(1, 1, 0)};
  shape.triangles = {{0, 1, 2}, {0, 1, 3}};
  const auto pairs = shapes::pairs_of(shape);
  ASSERT_EQ(pairs.size(), 1u);
  const Contours contours = trace_contours(shape.positions(), shape.triangles, build_edges(shape.triangles), pairs);
  EXPECT_TRUE(contours.crossings.empty());
  EXPECT_EQ(contours.count, 0);
  EXPECT_TRUE(contours.uncrossed == pairs);
}

}  // namespace
}  // namespace unsnarl
