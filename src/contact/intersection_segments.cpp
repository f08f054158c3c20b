#include "contact/intersection_segments.h"

#include <algorithm>

#include "geometry/triangle_intersection.h"
#include "mesh/adjacency.h"

namespace unsnarl {
namespace {

/// Where the edges of one triangle pierce the other.
void add_piercings(const Positions& x, const Triangle& piercing, const Triangle& pierced, std::vector<Vec3>& points) {
  const TrianglePoints face = points_of(x, pierced);
  const Vec3 normal = (face[1] - face[0]).cross(face[2] - face[0]);
  for (int k = 0; k < 3; ++k) {
    const Index u = piercing[k], v = piercing[(k + 1) % 3];
    if (has_corner(pierced, u) || has_corner(pierced, v)) continue;
    const Vec3 p = x.col(u), q = x.col(v);
    const double height_p = normal.dot(p - face[0]), height_q = normal.dot(q - face[0]);
    if (height_p == height_q || !segment_meets_triangle(p, q, face)) continue;
    points.push_back(p + std::clamp(height_p / (height_p - height_q), 0.0, 1.0) * (q - p));
  }
}

}  // namespace

std::vector<std::array<Vec3, 2>> intersection_segments(const Positions& x, std::span<const Triangle> triangles,
                                                       std::span<const IntersectingPair> pairs) {
  std::vector<std::array<Vec3, 2>> segments;
  std::vector<Vec3> points;
  for (const IntersectingPair& pair : pairs) {
    if (pair.kind != PairClass::disjoint && pair.kind != PairClass::one_vertex) continue;
    const Triangle &a = triangles[pair.a], &b = triangles[pair.b];
    points.clear();
    add_piercings(x, a, b, points);
    add_piercings(x, b, a, points);
    for (Index v : a)
      if (has_corner(b, v)) points.push_back(x.col(v));
    // An edge through a corner or through an edge counts more than once: the two points furthest apart are the ends.
    std::array<Vec3, 2> ends;
    double longest = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (const double length = (points[i] - points[j]).squaredNorm(); length > longest) {
          longest = length;
          ends = {points[j], points[i]};
        }
    if (longest > 0) segments.push_back(ends);
  }
  return segments;
}

}  // namespace unsnarl
