#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/intersections.h>

#include <variant>

#include "oracle/intersections_oracle.h"
#include "oracle/pair_class_oracle.h"

namespace unsnarl::oracle {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Point = Kernel::Point_3;
using Segment = Kernel::Segment_3;
using Triangle = Kernel::Triangle_3;
/// What the hull of up to three points is.
using Shape = std::variant<std::monostate, Point, Segment, Triangle>;

Shape hull_of(std::vector<Point> points) {
  if (points.empty()) return {};
  if (points.size() == 3 && !CGAL::collinear(points[0], points[1], points[2]))
    return Triangle(points[0], points[1], points[2]);
  const auto [lo, hi] = std::minmax_element(points.begin(), points.end());  // along a line: its ends
  if (*lo == *hi) return *lo;
  return Segment(*lo, *hi);
}

bool contains(const Shape& shape, const Point& p) {
  if (const Point* point = std::get_if<Point>(&shape)) return *point == p;
  if (const Segment* segment = std::get_if<Segment>(&shape)) return segment->has_on(p);
  if (const Triangle* triangle = std::get_if<Triangle>(&shape)) return triangle->has_on(p);
  return false;
}

/// Corners of what CGAL::intersection returns.
struct Corners {
  std::vector<Point> points;
  using result_type = void;
  void operator()(const Point& p) { points.push_back(p); }
  void operator()(const Segment& s) { points.insert(points.end(), {s.source(), s.target()}); }
  void operator()(const Triangle& t) { points.insert(points.end(), {t[0], t[1], t[2]}); }
  void operator()(const std::vector<Point>& polygon) { points = polygon; }
};

std::vector<Point> corners_of_meeting(const Shape& a, const Shape& b) {
  if (const Point* p = std::get_if<Point>(&a)) return contains(b, *p) ? std::vector{*p} : std::vector<Point>{};
  if (const Point* p = std::get_if<Point>(&b)) return contains(a, *p) ? std::vector{*p} : std::vector<Point>{};
  Corners corners;
  const auto meet = [&](const auto& s, const auto& t) {
    if (const auto meeting = CGAL::intersection(s, t)) boost::apply_visitor(corners, *meeting);
  };
  const Segment *segment_a = std::get_if<Segment>(&a), *segment_b = std::get_if<Segment>(&b);
  const Triangle *triangle_a = std::get_if<Triangle>(&a), *triangle_b = std::get_if<Triangle>(&b);
  if (segment_a && segment_b) meet(*segment_a, *segment_b);
  if (segment_a && triangle_b) meet(*segment_a, *triangle_b);
  if (triangle_a && segment_b) meet(*triangle_a, *segment_b);
  if (triangle_a && triangle_b) meet(*triangle_a, *triangle_b);
  return corners.points;
}

}  // namespace

std::vector<IntersectingPair> intersections_by_cgal(std::span<const double> positions,
                                                    std::span<const OracleTriangle> triangles) {
  std::vector<Point> points;
  for (std::size_t v = 0; v < positions.size() / 3; ++v)
    points.emplace_back(positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]);
  const auto shape_on = [&](const auto& ids) {
    std::vector<Point> corners;
    for (const std::int32_t v : ids) corners.push_back(points[v]);
    return hull_of(corners);
  };
  std::vector<Shape> shapes;
  for (const OracleTriangle& t : triangles) shapes.push_back(shape_on(t));
  const auto coordinate = [&](const OracleTriangle& t, int k, int axis) { return positions[3 * t[k] + axis]; };
  const auto boxes_apart = [&](const OracleTriangle& a, const OracleTriangle& b) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto [a_lo, a_hi] = std::minmax({coordinate(a, 0, axis), coordinate(a, 1, axis), coordinate(a, 2, axis)});
      const auto [b_lo, b_hi] = std::minmax({coordinate(b, 0, axis), coordinate(b, 1, axis), coordinate(b, 2, axis)});
      if (a_hi < b_lo || b_hi < a_lo) return true;
    }
    return false;
  };

  std::vector<IntersectingPair> pairs;
  for (std::size_t i = 0; i < triangles.size(); ++i)
    for (std::size_t j = i + 1; j < triangles.size(); ++j) {
      if (boxes_apart(triangles[i], triangles[j])) continue;
      const bool zero_area =
          !std::holds_alternative<Triangle>(shapes[i]) || !std::holds_alternative<Triangle>(shapes[j]);
      const auto kind = classify(triangles[i], triangles[j], zero_area, [&](const auto& shared) {
        const Shape hull = shape_on(shared);
        for (const Point& corner : corners_of_meeting(shapes[i], shapes[j]))
          if (!contains(hull, corner)) return true;
        return false;
      });
      if (kind) pairs.push_back({static_cast<std::int32_t>(i), static_cast<std::int32_t>(j), *kind});
    }
  return pairs;
}

}  // namespace unsnarl::oracle
