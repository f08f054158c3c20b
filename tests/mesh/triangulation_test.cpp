#include "mesh/triangulation.h"

#include <gtest/gtest.h>

#include <random>

#include "geometry/parallel.h"
#include "geometry/predicates.h"
#include "geometry/scale.h"
#include "mesh/shapes.h"
#include "mesh/weld_map.h"

namespace unsnarl {
namespace {

using namespace shapes;

Vec3 at(const Surface& s, Index v) {
  return {s.positions[3 * v], s.positions[3 * v + 1], s.positions[3 * v + 2]};
}

Surface polygon(const std::vector<std::array<double, 3>>& points) {
  Surface s;
  std::vector<Index> corners;
  for (const auto& p : points) corners.push_back(add_vertex(s, p[0], p[1], p[2]));
  add_face(s, corners);
  return s;
}

/// Sum of areas seen along z, each triangle with its own sign; smallest of them in `smallest`.
double signed_area(const Surface& s, const Triangulation& cut, double& smallest) {
  double sum = 0;
  smallest = 1e300;
  for (const Triangle& t : cut.triangles) {
    const double area = 0.5 * (at(s, t[1]) - at(s, t[0])).cross(at(s, t[2]) - at(s, t[0]))[2];
    sum += area;
    smallest = std::min(smallest, area);
  }
  return sum;
}

TEST(Triangulation, triangles_stay_as_they_are) {
  const Triangulation cut = triangulate(octahedron());
  ASSERT_EQ(cut.triangles.size(), 8u);
  EXPECT_EQ(cut.triangles[1], (Triangle{2, 1, 4}));
  EXPECT_EQ(cut.polygon[7], 7);
  EXPECT_EQ(cut.statistics.triangles, 8u);
}

TEST(Triangulation, convex_quad_is_cut_from_its_first_corner) {
  const Triangulation cut = triangulate(polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0.3}, {0, 1, 0}}));
  EXPECT_EQ(cut.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(cut.polygon, (std::vector<Index>{0, 0}));
}

TEST(Triangulation, concave_quad_is_cut_where_it_does_not_fold) {
  // The second corner is a dent, so the first diagonal runs outside.
  const Surface s = polygon({{0, 0, 0}, {1, 1, 0}, {2, 0, 0}, {1, 3, 0}});
  const Triangulation cut = triangulate(s);
  EXPECT_EQ(cut.triangles, (std::vector<Triangle>{{1, 2, 3}, {1, 3, 0}}));
  EXPECT_EQ(cut.statistics.quads_other_diagonal, 1u);
}

TEST(Triangulation, quad_whose_dent_is_the_first_corner_needs_no_other) {
  const Triangulation cut = triangulate(polygon({{1, 1, 0}, {2, 0, 0}, {1, 3, 0}, {0, 0, 0}}));
  EXPECT_EQ(cut.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(cut.statistics.quads_other_diagonal, 0u);
}

TEST(Triangulation, bow_tie_quad_falls_back_to_the_first_diagonal) {
  const Triangulation cut = triangulate(polygon({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(cut.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
}

TEST(Triangulation, l_shape_is_covered_once) {
  const Surface s = polygon({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}});
  const Triangulation cut = triangulate(s);
  ASSERT_EQ(cut.triangles.size(), 4u);
  double smallest = 0;
  EXPECT_DOUBLE_EQ(signed_area(s, cut, smallest), 3);
  EXPECT_GT(smallest, 0);
  EXPECT_EQ(cut.statistics.clipped, 1u);
  EXPECT_EQ(cut.statistics.forced_ears, 0u);
}

TEST(Triangulation, non_planar_polygon_keeps_its_triangles_facing_one_way) {
  std::vector<std::array<double, 3>> points;
  for (int i = 0; i < 9; ++i) points.push_back({std::cos(i * 0.698), std::sin(i * 0.698), 0.2 * ((i * 7) % 5)});
  const Surface s = polygon(points);
  const Triangulation cut = triangulate(s);
  ASSERT_EQ(cut.triangles.size(), 7u);
  double smallest = 0;
  signed_area(s, cut, smallest);
  EXPECT_GT(smallest, 0);
}

TEST(Triangulation, comb_with_many_teeth_is_covered_once) {
  std::vector<std::array<double, 3>> points = {{0, 0, 0}};
  const int teeth = 60;
  points.push_back({2.0 * teeth, 0, 0});
  for (int i = teeth; i-- > 0;) {
    points.push_back({2.0 * i + 2, 5, 0});
    points.push_back({2.0 * i + 1, 1, 0});
  }
  points.push_back({0, 5, 0});
  const Surface s = polygon(points);
  const Triangulation cut = triangulate(s);
  EXPECT_EQ(cut.triangles.size(), points.size() - 2);
  double smallest = 0, expected = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto &a = points[i], &b = points[(i + 1) % points.size()];
    expected += 0.5 * (a[0] * b[1] - a[1] * b[0]);
  }
  EXPECT_NEAR(signed_area(s, cut, smallest), expected, 1e-9);
  EXPECT_GE(smallest, 0);
}

/// The rule written down without any bookkeeping.
std::vector<Triangle> cut_simply(const Surface& s, std::vector<Index> p) {
  Vec3 n = Vec3::Zero();
  for (std::size_t k = 0; k < p.size(); ++k)
    n += (at(s, p[k]) - at(s, p[0])).cross(at(s, p[(k + 1) % p.size()]) - at(s, p[0]));
  const auto side = [&](Index a, Index b, Index c) {
    const Vec3 m = (at(s, b) - at(s, a)).cross(at(s, c) - at(s, a));
    return n[0] * m[0] + n[1] * m[1] + n[2] * m[2];
  };
  std::vector<Triangle> out;
  while (p.size() > 3) {
    std::size_t chosen = 0;
    for (std::size_t k = 0; k < p.size(); ++k) {
      const Index a = p[(k + p.size() - 1) % p.size()], b = p[k], c = p[(k + 1) % p.size()];
      bool ear = side(a, b, c) > 0;
      for (Index x : p)
        if (ear && x != a && x != b && x != c) ear = !(side(a, b, x) >= 0 && side(b, c, x) >= 0 && side(c, a, x) >= 0);
      if (ear) {
        chosen = k;
        break;
      }
    }
    out.push_back({p[(chosen + p.size() - 1) % p.size()], p[chosen], p[(chosen + 1) % p.size()]});
    p.erase(p.begin() + static_cast<std::ptrdiff_t>(chosen));
  }
  out.push_back({p[0], p[1], p[2]});
  return out;
}

void expect_cut_as_by_the_rule(const Surface& s, const std::vector<Index>& corners) {
  const Triangulation cut = triangulate(s);
  Surface at_scale = s;  // where no product over- or underflows
  at_scale.positions = Scale(s.positions).in(s.positions);
  std::vector<Triangle> expected = cut_simply(at_scale, corners);
  const std::vector<Triangle> all_triangles = expected;
  const std::size_t all = expected.size();
  std::erase_if(expected, [&](const Triangle& t) {
    return uses_a_vertex_twice(t) &&
           std::any_of(all_triangles.begin(), all_triangles.end(), [&](const Triangle& other) {
             const auto has = [&](Index v) { return std::find(other.begin(), other.end(), v) != other.end(); };
             const bool has_area = !collinear(at(s, other[0]), at(s, other[1]), at(s, other[2]));
             return has_area && !uses_a_vertex_twice(other) && std::all_of(t.begin(), t.end(), has);
           });
  });
  EXPECT_EQ(cut.triangles, expected);
  EXPECT_EQ(cut.statistics.dropped, all - expected.size());
}

TEST(Triangulation, bookkeeping_changes_nothing) {
  std::mt19937 random(7);
  for (int round = 0; round < 300; ++round) {
    Surface s;
    std::vector<Index> corners;
    const int size = 5 + static_cast<int>(random() % (round % 10 == 0 ? 60 : 12));
    const auto range = static_cast<unsigned>(2 + round % 7);  // tiny integers: ties and repeated points abound
    for (int i = 0; i < size; ++i) {
      if (i > 2 && random() % 10 == 0)
        corners.push_back(corners[random() % corners.size()]);
      else
        corners.push_back(add_vertex(s, random() % range, random() % range, round % 3 == 0 ? random() % 2 : 0));
    }
    add_face(s, corners);
    expect_cut_as_by_the_rule(s, corners);
  }
}

/// A jagged ring in a plane askew, whose corners are rounded off it: what is collinear is so but for rounding.
TEST(Triangulation, boxes_change_nothing_even_where_rounding_decides) {
  std::mt19937 random(11);
  for (const double scale : {1.0, 1e-90, 1e90}) {
    for (int round = 0; round < 40; ++round) {
      Surface s;
      std::vector<Index> corners;
      const int size = 40 + static_cast<int>(random() % 60);
      for (int i = 0; i < size; ++i) {
        const double angle = 6.283185307179586 * i / size, radius = round % 2 == 0 ? 1 : 1 + random() % 4;
        double u = radius * std::cos(angle), v = radius * std::sin(angle);
        if (round % 4 == 1) u = std::round(3 * u) / 7, v = std::round(3 * v) / 7;
        corners.push_back(
            add_vertex(s, scale * (0.1 + u * 0.6 - v * 0.3), scale * (0.7 * u + v * 0.2), scale * (0.3 - u * 0.1 + v)));
      }
      add_face(s, corners);
      expect_cut_as_by_the_rule(s, corners);
    }
  }
}

/// For a cost of the square of their number nobody would wait.
TEST(Triangulation, polygons_of_very_many_corners_are_cut) {
  const int size = 200000;
  const auto expect_covered_once = [](const std::vector<std::array<double, 3>>& points) {
    const Surface s = polygon(points);
    const Triangulation cut = triangulate(s);
    EXPECT_EQ(cut.triangles.size(), points.size() - 2);
    EXPECT_EQ(cut.statistics.forced_ears, 0u);
    double area = 0, largest = 0, sum = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto &a = points[i], &b = points[(i + 1) % points.size()];
      area += 0.5 * (a[0] * b[1] - a[1] * b[0]);
    }
    for (const Triangle& t : cut.triangles) {
      const double part = 0.5 * (at(s, t[1]) - at(s, t[0])).cross(at(s, t[2]) - at(s, t[0]))[2];
      sum += part;
      largest = std::max(largest, area > 0 ? -part : part);
    }
    EXPECT_EQ(largest, 0);  // all turn the way of the polygon
    EXPECT_NEAR(sum, area, 1e-6 * std::abs(area));
  };
  std::vector<std::array<double, 3>> star, comb = {{0, 0, 0}, {size, 0, 0}}, spiral;
  for (int i = 0; i < size; ++i) {
    const double angle = 6.283185307179586 * i / size, radius = 1 + i % 2;
    star.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
  }
  for (int i = size; i-- > 0;) comb.push_back({i + 0.5, i % 2 == 0 ? 1.0 : 9.0, 0});
  for (int i = 0; i < size; ++i) {
    const int step = i < size / 2 ? i : size - 1 - i;
    const double angle = 3e-3 * step, radius = (i < size / 2 ? 2 : 2.1) + 0.1 * angle;
    spiral.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
  }
  expect_covered_once(star);
  expect_covered_once(comb);
  expect_covered_once(spiral);
}

TEST(Triangulation, repeated_corners_are_dropped_and_counted) {
  Surface s = polygon({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  add_face(s, {0, 1, 1});
  add_face(s, {0, 1, 2, 2});
  add_face(s, {0, 1});
  const Triangulation cut = triangulate(s);
  EXPECT_EQ(cut.triangles.size(), 2u);
  EXPECT_EQ(cut.polygon, (std::vector<Index>{0, 2}));
  EXPECT_EQ(cut.statistics.dropped, 2u);
  EXPECT_EQ(cut.statistics.too_small, 1u);
}

TEST(Triangulation, repeated_corners_that_no_triangle_covers_stay) {
  Surface s = polygon({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 0, 0}, {6, 0, 0}, {7, 0, 0}});
  s.corners = {0, 1, 2};
  s.offsets = {0, 3};
  add_face(s, {3, 3, 4});  // a segment
  add_face(s, {1, 3, 3});  // another, from a triangle's corner
  add_face(s, {5, 5, 5});  // a point
  add_face(s, {1, 1, 1});  // a triangle's corner
  add_face(s, {2, 0, 2});  // a triangle's edge
  const Triangulation cut = triangulate(s);
  EXPECT_EQ(cut.triangles, (std::vector<Triangle>{{0, 1, 2}, {3, 3, 4}, {1, 3, 3}, {5, 5, 5}}));
  EXPECT_EQ(cut.polygon, (std::vector<Index>{0, 1, 2, 3}));
  EXPECT_EQ(cut.statistics.dropped, 2u);
}

/// Thousands of flat, concave and twisted ones, at scales where products of four lengths are no numbers.
TEST(Triangulation, polygons_are_cut_alike_at_any_power_of_two) {
  std::mt19937 random(5);
  const auto number = [&] { return std::ldexp(static_cast<double>(random()), -31) - 1; };
  for (const int size : {4, 4, 4, 7, 12}) {
    Surface s;
    for (int f = 0; f < 500; ++f) {
      std::vector<Index> corners;
      for (int k = 0; k < size; ++k) corners.push_back(add_vertex(s, number(), number(), 0.1 * number()));
      add_face(s, corners);
    }
    const Triangulation cut = triangulate(s), other = triangulate_other_diagonals(s);
    EXPECT_TRUE(size != 4 || cut.statistics.quads_other_diagonal > 50) << "too few of them are concave";
    for (const int exponent : {-1000, -900, -300, -60, 60, 300, 512, 900, 1022}) {
      Surface scaled = s;
      for (double& x : scaled.positions) x = std::ldexp(x, exponent);
      EXPECT_EQ(triangulate(scaled).triangles, cut.triangles) << exponent;
      EXPECT_EQ(triangulate_other_diagonals(scaled).triangles, other.triangles) << exponent;
    }
  }
}

// What meets a segment along an edge of a triangle without area may share that edge with the triangle.
TEST(Triangulation, repeated_corners_on_a_triangle_without_area_stay) {
  Surface s = polygon({{0, 0, 0}, {2, 0, 0}, {1, 0, 0}});
  add_vertex(s, 0, 1, 0);
  add_face(s, {0, 1, 3});
  add_face(s, {0, 0, 2});
  EXPECT_EQ(triangulate(s).triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 1, 3}, {0, 0, 2}}));
  Surface with_area = s;
  with_area.positions[7] = 1;
  EXPECT_EQ(triangulate(with_area).triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 1, 3}}));
}

TEST(Triangulation, corners_are_renamed_after_the_cut) {
  const Surface s = exploded(cube());
  const WeldMap id = weld(s);
  const Triangulation cut = triangulate(s, id.vertex_of);
  ASSERT_EQ(cut.triangles.size(), 12u);
  for (const Triangle& t : cut.triangles)
    for (Index v : t) EXPECT_LT(v, 8);
}

TEST(Triangulation, same_at_any_thread_count) {
  Surface s;
  std::mt19937 random(3);
  for (int f = 0; f < 30000; ++f) {
    std::vector<Index> corners;
    for (unsigned k = 0; k < 3 + random() % 5; ++k)
      corners.push_back(add_vertex(s, random() % 9, random() % 9, random() % 3));
    add_face(s, corners);
  }
  std::vector<Triangulation> cuts;
  for (const std::size_t threads : {1, 2, 4}) {
    const ThreadLimit limit(threads);
    cuts.push_back(triangulate(s));
  }
  for (const Triangulation& cut : cuts) {
    EXPECT_EQ(cut.triangles, cuts[0].triangles);
    EXPECT_EQ(cut.polygon, cuts[0].polygon);
  }
}

TEST(Triangulation, describes_only_what_occurs) {
  EXPECT_EQ(triangulate(cube()).statistics.describe(), "6 quads cut from their first corner");
  EXPECT_EQ(CutStatistics{}.describe(), "no faces");
  CutStatistics ones;
  ones.triangles = ones.quads = ones.clipped = 1;
  EXPECT_EQ(ones.describe(), "1 triangle as it is, 1 quad cut from its first corner, 1 larger polygon cut ear by ear");
}

}  // namespace
}  // namespace unsnarl
