// Any mesh that somebody has: non-manifold, open, in parts, one-sided, pinched, of polygons, degenerate, huge, tiny,
// far away. Each is small, runs through itself, and ends embedded or with the named obstruction; CGAL judges.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <string>

#include "oracle/intersections_oracle.h"
#include "scene/prepared_surface.h"
#include "scene/shapes.h"
#include "unsnarl/certify.h"
#include "unsnarl/repair.h"
#include "unsnarl/samples.h"

namespace unsnarl {
namespace {

using shapes::Shape;

/// By CGAL, on the triangles and the welded vertices of the input.
std::vector<IntersectingPair> judged(const PreparedSurface& input, const std::vector<double>& positions) {
  const Positions x = input.gather(positions);
  return oracle::intersections_by_cgal({x.data(), static_cast<std::size_t>(x.size())}, input.triangulation.triangles);
}

// Builders.

Surface polygons(const std::vector<Vec3>& points, const std::vector<std::vector<Index>>& faces) {
  Surface surface;
  for (const Vec3& p : points) surface.positions.insert(surface.positions.end(), {p[0], p[1], p[2]});
  surface.offsets = {0};
  for (const auto& face : faces) {
    surface.corners.insert(surface.corners.end(), face.begin(), face.end());
    surface.offsets.push_back(static_cast<std::int32_t>(surface.corners.size()));
  }
  return surface;
}

Surface mapped(Surface surface, const std::function<Vec3(const Vec3&)>& map) {
  for (std::size_t v = 0; v < surface.view().vertex_count(); ++v) {
    Eigen::Map<Vec3> p(&surface.positions[3 * v]);
    p = map(Vec3(p));
  }
  return surface;
}

/// The same triangles with three vertices each, as STL files have them.
Surface as_soup(const Surface& surface) {
  Surface soup;
  for (const std::int32_t v : surface.corners) {
    soup.corners.push_back(static_cast<std::int32_t>(soup.corners.size()));
    soup.positions.insert(soup.positions.end(), &surface.positions[3 * v], &surface.positions[3 * v] + 3);
  }
  return soup;
}

Shape sheet(Index m, Index n, const std::function<Vec3(double, double)>& f) {
  return shapes::grid(m, n, false, f);
}

/// n steps along a border shared by `pages` sheets, which stand at the given angles (degrees) and reach 1 from it.
Shape pages_on_a_spine(const std::vector<double>& degrees, double bend, Index n = 4) {
  Shape book;
  for (Index i = 0; i <= n; ++i) book.points.emplace_back(0, static_cast<double>(i) / n, 0);
  for (std::size_t k = 0; k < degrees.size(); ++k) {
    const double sign = k % 2 ? -1 : 1;
    std::vector<Index> row(n + 1), next(n + 1);
    for (Index i = 0; i <= n; ++i) row[i] = i;
    for (Index j = 1; j <= n; ++j) {
      const double r = static_cast<double>(j) / n;
      const double angle = (degrees[k] + sign * bend * r) * 3.14159265358979 / 180;
      for (Index i = 0; i <= n; ++i) {
        next[i] = static_cast<Index>(book.points.size());
        book.points.emplace_back(r * std::cos(angle), static_cast<double>(i) / n, r * std::sin(angle));
      }
      for (Index i = 0; i < n; ++i) {
        book.triangles.push_back({row[i], row[i + 1], next[i + 1]});
        book.triangles.push_back({row[i], next[i + 1], next[i]});
      }
      row = next;
    }
  }
  return book;
}

Surface book_pages() {
  return pages_on_a_spine({0, 10, 25, 170}, 20).surface();
}

/// Two of the pages start in one plane: faces that share an edge and overlap flat.
Surface book_pages_in_one_plane() {
  return pages_on_a_spine({0, 90, 0}, 0, 3).surface();
}

/// Cards across each other, each with a back of its own vertices at the same places.
Surface two_sided_hair_cards() {
  Shape cards;
  for (int k = 0; k < 3; ++k) {
    Shape card = sheet(4, 1, [&](double i, double j) {
      return Vec3(i - 2, 0.6 * j + 0.17 * i, 0.3 * std::sin(i + 2 * k) + 0.05 * k);
    });
    if (k == 1)
      for (Vec3& p : card.points) std::swap(p[0], p[1]);
    Shape back = card;
    for (Triangle& t : back.triangles) std::swap(t[1], t[2]);
    cards.add(card).add(back);
  }
  return cards.surface();
}

/// The same, the backs on the vertices of the fronts: no motion parts them.
Surface hair_cards_with_duplicate_backs() {
  Shape card = sheet(4, 1, [](double i, double j) { return Vec3(i - 2, 0.6 * j, 0.3 * std::sin(i)); });
  Shape cards = card;
  for (Triangle t : card.triangles) cards.triangles.push_back({t[0], t[2], t[1]});
  return cards.add(sheet(1, 4, [](double i, double j) { return Vec3(0.6 * i, j - 2, 0.1); })).surface();
}

/// A wall on the middle line of a floor, whose top bends over and down through the floor.
Surface wall_on_a_floor() {
  Shape shape = sheet(6, 4, [](double i, double j) { return Vec3(i - 3, j - 2, 0); });
  const auto middle = [](Index j) { return 3 * 5 + j; };
  std::vector<Index> row, next(5);
  for (Index j = 0; j < 5; ++j) row.push_back(middle(j));
  for (int k = 1; k <= 7; ++k) {
    const double angle = 0.6 * k;
    for (Index j = 0; j < 5; ++j) {
      next[j] = static_cast<Index>(shape.points.size());
      shape.points.emplace_back(1 - std::cos(angle), j - 2, 1.1 * std::sin(angle) + 0.01 * k);
    }
    for (Index j = 0; j < 4; ++j) {
      shape.triangles.push_back({row[j], row[j + 1], next[j + 1]});
      shape.triangles.push_back({row[j], next[j + 1], next[j]});
    }
    row = next;
  }
  return shape.surface();
}

/// The border of a wall ends in the middle of the faces of a floor, without shared vertices: it touches.
Surface wall_touching_a_floor() {
  Shape shape = sheet(3, 3, [](double i, double j) { return Vec3(i - 1.5, j - 1.5, 0); });
  return shape.add(sheet(2, 3, [](double i, double j) { return Vec3(0.21, 0.8 * j - 1.2, i); })).surface();
}

Shape box(const Vec3& lo, const Vec3& hi) {
  Shape shape;
  for (int k = 0; k < 8; ++k)
    shape.points.emplace_back(k & 1 ? hi[0] : lo[0], k & 2 ? hi[1] : lo[1], k & 4 ? hi[2] : lo[2]);
  shape.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                     {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return shape;
}

Surface boxes_in_a_row() {
  Shape shape;
  for (int k = 0; k < 5; ++k) shape.add(box(Vec3(0.9 * k, 0.1 * k, 0.07 * k), Vec3(0.9 * k + 1, 1 + 0.1 * k, 1)));
  return shape.surface();
}

/// Whole sides lie in each other: coplanar faces that overlap.
Surface boxes_that_touch() {
  Shape shape = box(Vec3(0, 0, 0), Vec3(1, 1, 1));
  return shape.add(box(Vec3(1, 0.25, 0.25), Vec3(1.5, 0.75, 0.75))).surface();
}

/// Well inside, and so near one side that it sticks out.
Surface boxes_in_a_box() {
  Shape shape = box(Vec3(0, 0, 0), Vec3(4, 4, 4));
  return shape.add(box(Vec3(1, 1, 1), Vec3(2, 2, 2))).add(box(Vec3(2.5, 2.6, 3.2), Vec3(3.5, 3.4, 4.1))).surface();
}

/// A cone with its tip in the origin and its rim around the place given.
Shape cone(const Vec3& rim, double radius) {
  Shape shape;
  shape.points.emplace_back(0, 0, 0);
  for (int k = 0; k < 8; ++k)
    shape.points.push_back(rim + radius * Vec3(std::cos(0.785398 * k), std::sin(0.785398 * k), 0));
  for (Index k = 0; k < 8; ++k) shape.triangles.push_back({0, 1 + k, 1 + (k + 1) % 8});
  return shape;
}

/// Their tips are one place, but not one vertex.
Surface cones_tip_to_tip() {
  return cone({0, 0, 1}, 1).add(cone({0, 0, -1}, 1)).surface();
}

/// On one vertex, and through each other there.
Surface cones_on_one_vertex() {
  Shape both = cone({0, 0, 1}, 0.8);
  const Shape other = cone({0.4, 0.1, 1.1}, 0.7);
  both.points.insert(both.points.end(), other.points.begin() + 1, other.points.end());
  for (const Triangle& t : other.triangles) both.triangles.push_back({0, t[1] + 8, t[2] + 8});
  return both.surface();
}

/// A tube of which one ring has collapsed to a point.
Surface tube_with_a_collapsed_ring() {
  Shape tube = shapes::tube(6, 8, 0.8);
  for (Index j = 0; j < 8; ++j) tube.points[3 * 8 + j] = Vec3::Zero();
  return tube.surface();
}

/// Hexagons that are not flat, in a sheet, and a star (concave) through them.
Surface hexagons_and_a_star() {
  std::vector<Vec3> points;
  std::vector<std::vector<Index>> faces;
  const double s = std::sqrt(3.0);
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) {
      std::vector<Index> face;
      for (int k = 0; k < 6; ++k) {
        face.push_back(static_cast<Index>(points.size()));
        const double a = 1.0471975512 * k;
        points.emplace_back(3.1 * i + std::cos(a), 1.1 * s * j + std::sin(a), 0.12 * ((k * 2 + i) % 3));
      }
      faces.push_back(face);
    }
  std::vector<Index> star;
  for (int k = 0; k < 10; ++k) {
    const double a = 0.62831853 * k, r = k % 2 ? 0.35 : 0.9;
    star.push_back(static_cast<Index>(points.size()));
    points.emplace_back(0.21 + r * std::cos(a), 0.13, 0.1 + r * std::sin(a));
  }
  faces.push_back(star);
  return polygons(points, faces);
}

/// Concave quads (darts), with a reflex corner at each of the four places, through one another.
Surface darts() {
  std::vector<Vec3> points;
  std::vector<std::vector<Index>> faces;
  const std::vector<Vec3> dart = {Vec3(0, 0, 0), Vec3(2, -1, 0), Vec3(0.6, 0.1, 0.1), Vec3(-0.2, 2, 0)};
  for (Index k = 0; k < 4; ++k) {
    std::vector<Index> face;
    for (Index c = 0; c < 4; ++c) face.push_back(4 * k + (c + k) % 4);
    for (const Vec3& p : dart)
      points.push_back(Vec3(p[0] + 0.1 * k, p[2] + 0.3 * k - 0.4, p[1]).cwiseProduct(Vec3(1, 1, k % 2 ? 1 : -1)));
    for (Index c = 0; c < 4 && k % 2; ++c) std::swap(points[4 * k + c][1], points[4 * k + c][2]);
    faces.push_back(face);
  }
  return polygons(points, faces);
}

/// Crossing sheets whose mesh has edges of no length and triangles on a line.
Surface zero_area_faces() {
  Shape shape = shapes::crossing_bumps(8, 0.3);
  const Triangle t = shape.triangles[70];
  const Index middle = static_cast<Index>(shape.points.size());
  shape.points.push_back(0.5 * (shape.points[t[0]] + shape.points[t[1]]));
  shape.triangles.push_back({t[0], middle, t[1]});  // on a line
  shape.points.emplace_back(30, 0, 0);
  shape.points.emplace_back(30, 0, 0);
  shape.points.emplace_back(31, 0, 0);
  shape.triangles.push_back({middle + 1, middle + 2, middle + 3});  // an edge of no length
  return shape.surface();
}

Surface duplicate_and_unused_vertices() {
  Surface soup = as_soup(shapes::crossing_bumps(8, 0.3).surface());
  soup.positions.insert(soup.positions.begin(), {0, 0, 1, 0.5, 0.25, 1.01});
  for (std::int32_t& v : soup.corners) v += 2;
  soup.positions.insert(soup.positions.end(), {7, 7, 7});
  return soup;
}

Surface coincident_sheets() {
  Shape shape = shapes::bumpy_sheet(6, 0.5);
  return shape.add(shapes::bumpy_sheet(6, 0.5)).surface();
}

Surface flat_sheets_in_one_plane() {
  Shape shape = shapes::bumpy_sheet(4, 0);
  return shape.add(shapes::bumpy_sheet(3, 0), {0.3, 0.2, 0}).surface();
}

Surface sample_of(const char* name, int resolution) {
  return make_sample(name, resolution);
}

struct Case {
  const char* name;
  std::function<Surface()> make;
  Status status = Status::embedded;
  bool is_polygonal = false;
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.name;
}

class Generality : public testing::TestWithParam<Case> {};

TEST_P(Generality, ends_as_it_should_says_cgal) {
  const Surface surface = GetParam().make();
  const PreparedSurface prepared = prepare(surface, {});
  const std::vector<IntersectingPair> before = judged(prepared, surface.positions);
  ASSERT_FALSE(before.empty()) << "it tests nothing";
  const RepairResult result = repair(surface);
  ASSERT_EQ(result.status, GetParam().status)
      << to_string(result.status) << ", " << result.report.before.total() << " -> " << result.report.after.total();
  const std::vector<IntersectingPair> after = judged(prepared, result.positions);
  EXPECT_EQ(result.report.after.total(), pairs_of_faces(prepared.triangulation.polygon, after).size());
  const Certificate certificate = certify(surface, result.positions);
  EXPECT_TRUE(certificate.seams_closed);
  EXPECT_EQ(certificate.new_zero_area_faces, 0u);
  if (GetParam().status == Status::embedded) {
    EXPECT_TRUE(after.empty());
    // What a second run makes of it: nothing.
    Surface repaired = surface;
    repaired.positions = result.positions;
    EXPECT_TRUE(repair(repaired).positions == repaired.positions);
  } else {
    ASSERT_FALSE(result.report.obstructions.empty());
    for (const IntersectingPair& pair : after) EXPECT_EQ(pair.kind, PairClass::duplicate);
  }
  // What no face uses stays.
  std::vector<std::uint8_t> used(surface.view().vertex_count(), 0);
  for (const std::int32_t v : surface.corners) used[v] = 1;
  for (std::size_t v = 0; v < used.size(); ++v)
    EXPECT_TRUE(used[v] ||
                std::equal(&surface.positions[3 * v], &surface.positions[3 * v] + 3, &result.positions[3 * v]));
}

Surface at_scale(double scale, const Vec3& away = Vec3::Zero()) {
  return mapped(shapes::crossing_bumps(8, 0.3).surface(), [=](const Vec3& p) { return Vec3(scale * p + away); });
}

// Recovery by the shape's energies would lead away from it: the bending of a ring that is one point outweighs the rest.
TEST(Repair, a_collapsed_ring_is_opened_no_farther_than_it_has_to_be) {
  const RepairResult result = repair(make_sample("cylinder_inverted", 0));
  EXPECT_EQ(result.status, Status::embedded);
  EXPECT_LT(result.report.displacement_mean_rel, 2e-4);
}

/// Segments and points that are faces: through a sheet, on it, and clear of it.
Surface pins() {
  std::vector<Vec3> points = {{-1, -1, 0},      {1, -1, 0},      {1, 1, 0},      {-1, 1, 0},
                              {0.3, 0.2, -0.5}, {0.3, 0.2, 0.5}, {-0.4, 0.3, 0}, {0, -0.5, 0},
                              {0, -0.5, 1},     {0.2, -0.6, 1},  {0.4, 0.9, 1}};
  return polygons(points, {{0, 1, 2, 3}, {4, 4, 5}, {6, 6, 6}, {8, 7, 7, 8}, {9, 10, 10}});
}

TEST(Repair, counts_and_parts_faces_that_are_segments_and_points) {
  const Surface surface = pins();
  const PairCounts before = count_by_class(find_intersections(surface));
  EXPECT_EQ(before[PairClass::degenerate], 3u);
  EXPECT_EQ(before.total(), 3u);
  const RepairResult result = repair(surface);
  EXPECT_EQ(result.status, Status::embedded);
  EXPECT_TRUE(certify(surface, result.positions).embedded());
  EXPECT_TRUE(judged(prepare(surface, {}), result.positions).empty());
}

/// Coordinates times a power of two: the same result, times that.
class AnyScale : public testing::TestWithParam<int> {};

TEST_P(AnyScale, repairs_alike) {
  const auto scaled = [](std::vector<double> numbers) {
    for (double& x : numbers) x = std::ldexp(x, GetParam());
    return numbers;
  };
  RepairOptions options;
  options.precision = Precision::float64;  // whatever float32 can hold
  options.record.frames = 4;
  for (const Surface& surface : {at_scale(1), sample_of("overlapping_quads", 8), hexagons_and_a_star(), darts()}) {
    const Surface other = {scaled(surface.positions), surface.corners, surface.offsets};
    const std::vector<IntersectingPair> pairs = find_intersections(surface);
    EXPECT_EQ(find_intersections(other), pairs);
    const RepairResult result = repair(surface, options), at_other = repair(other, options);
    EXPECT_EQ(at_other.status, Status::embedded);
    EXPECT_EQ(at_other.positions, scaled(result.positions));
    EXPECT_EQ(at_other.report.displacement_max_rel, result.report.displacement_max_rel);
    EXPECT_EQ(at_other.report.diagonal, std::ldexp(result.report.diagonal, GetParam()));
    EXPECT_EQ(at_other.frames.back().displacements, scaled(result.frames.back().displacements));
    EXPECT_TRUE(certify(other, at_other.positions).embedded());
    // Crossings are found at that scale too where there are some.
    EXPECT_EQ(certify(other, other.positions).pairs.total(), pairs.size());
  }
}

INSTANTIATE_TEST_SUITE_P(Repair, AnyScale, testing::Values(-900, -300, -128, 128, 300, 600, 900), [](const auto& info) {
  return (info.param < 0 ? "minus_" : "plus_") + std::to_string(std::abs(info.param));
});

// Both need the digits of float64, one since float32 has no such numbers, one since a vertex leaves its range.
TEST(Repair, falls_back_to_float64_where_float32_has_no_room) {
  for (const double scale : {0x1p200, 3e38 / 4.1}) {
    const Surface surface = at_scale(scale);
    const RepairResult result = repair(surface);
    EXPECT_EQ(result.status, Status::embedded) << scale;
    EXPECT_TRUE(certify(surface, result.positions).embedded());
  }
}

INSTANTIATE_TEST_SUITE_P(
    Repair, Generality,
    testing::Values(
        // Non-manifold.
        Case{"book_pages", book_pages}, Case{"book_pages_in_one_plane", book_pages_in_one_plane},
        Case{"two_sided_hair_cards", two_sided_hair_cards},
        Case{"hair_cards_with_duplicate_backs", hair_cards_with_duplicate_backs, Status::obstructed},
        Case{"wall_on_a_floor", wall_on_a_floor}, Case{"wall_touching_a_floor", wall_touching_a_floor},
        Case{"cones_on_one_vertex", cones_on_one_vertex},
        // In parts.
        Case{"boxes_in_a_row", boxes_in_a_row}, Case{"boxes_that_touch", boxes_that_touch},
        Case{"boxes_in_a_box", boxes_in_a_box}, Case{"hair_cards", [] { return sample_of("hair_cards", 12); }},
        // One-sided, with boundary.
        Case{"mobius_extended", [] { return sample_of("mobius_extended", 24); }},
        Case{"klein_bottle_punctured", [] { return sample_of("klein_bottle_punctured", 16); }},
        // No immersions.
        Case{"cross_cap_punctured", [] { return sample_of("cross_cap_punctured", 16); }},
        Case{"whitney_umbrella", [] { return sample_of("whitney_umbrella", 12); }},
        Case{"cones_tip_to_tip", cones_tip_to_tip},
        Case{"cylinder_inverted", [] { return sample_of("cylinder_inverted", 12); }},
        Case{"tube_with_a_collapsed_ring", tube_with_a_collapsed_ring},
        // Polygons.
        Case{"overlapping_quads", [] { return sample_of("overlapping_quads", 10); }},
        Case{"hexagons_and_a_star", hexagons_and_a_star}, Case{"darts", darts},
        // Degenerate.
        Case{"zero_area_faces", zero_area_faces}, Case{"duplicate_and_unused_vertices", duplicate_and_unused_vertices},
        Case{"coincident_sheets", coincident_sheets}, Case{"flat_sheets_in_one_plane", flat_sheets_in_one_plane},
        // Huge, tiny, far away.
        Case{"at_1e6", [] { return at_scale(1e6); }}, Case{"at_1e_6", [] { return at_scale(1e-6); }},
        Case{"far_from_the_origin",
             [] {
               return at_scale(1, {1e6, -2e6, 3e5});
             }},
        Case{"tiny_and_far",
             [] {
               return at_scale(1e-6, {1, 1, 1});
             }}),
    [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace unsnarl
