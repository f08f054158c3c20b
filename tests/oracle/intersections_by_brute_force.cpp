#include "oracle/intersections_oracle.h"
#include "oracle/pair_class_oracle.h"

namespace unsnarl::oracle {
namespace {

__extension__ using Integer = __int128;

struct Vector {
  Integer x, y, z;
};
Vector operator-(const Vector& a, const Vector& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
Vector operator*(Integer s, const Vector& a) {
  return {s * a.x, s * a.y, s * a.z};
}
Vector operator+(const Vector& a, const Vector& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
Vector cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Integer dot(const Vector& a, const Vector& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
bool is_zero(const Vector& a) {
  return a.x == 0 && a.y == 0 && a.z == 0;
}

/// The point p / w, w > 0.
struct RationalPoint {
  Vector p;
  Integer w = 1;
};
RationalPoint make_point(Vector p, Integer w) {
  if (w < 0) return {{-p.x, -p.y, -p.z}, -w};
  return {p, w};
}
/// w (r - a), an integer vector.
Vector offset_from(const Vector& a, const RationalPoint& r) {
  return r.p - r.w * a;
}

using Points = std::vector<Vector>;

bool on_segment(const RationalPoint& r, const Vector& a, const Vector& b) {
  const Vector from_a = offset_from(a, r), from_b = offset_from(b, r);
  return is_zero(cross(from_a, b - a)) && dot(from_a, b - a) >= 0 && dot(from_b, a - b) >= 0 &&
         (!is_zero(b - a) || is_zero(from_a));
}

/// r in the convex hull of 0 to 3 points.
bool in_hull(const RationalPoint& r, const Points& hull) {
  if (hull.empty()) return false;
  if (hull.size() == 1) return is_zero(offset_from(hull[0], r));
  if (hull.size() == 2) return on_segment(r, hull[0], hull[1]);
  const Vector normal = cross(hull[1] - hull[0], hull[2] - hull[0]);
  if (is_zero(normal))
    return on_segment(r, hull[0], hull[1]) || on_segment(r, hull[1], hull[2]) || on_segment(r, hull[2], hull[0]);
  if (dot(normal, offset_from(hull[0], r)) != 0) return false;
  for (int k = 0; k < 3; ++k)
    if (dot(normal, cross(hull[(k + 1) % 3] - hull[k], offset_from(hull[k], r))) < 0) return false;
  return true;
}

/// Corners of the convex set in which a and b meet, and maybe more points of it. A corner is where a vertex, edge or
/// face of one meets a vertex, edge or face of the other in a single point.
std::vector<RationalPoint> corners_of_meeting(const Points& a, const Points& b) {
  std::vector<RationalPoint> candidates;
  for (const Points* points : {&a, &b})
    for (const Vector& p : *points) candidates.push_back({p, 1});
  for (const auto& [edges, face] : {std::pair(&a, &b), std::pair(&b, &a)}) {
    const Vector normal = cross((*face)[1] - (*face)[0], (*face)[2] - (*face)[0]);
    for (int k = 0; k < 3; ++k) {
      const Vector &p = (*edges)[k], &q = (*edges)[(k + 1) % 3];
      // edge with the plane of a face: p + t (q - p), t = height / slope
      const Integer slope = dot(normal, q - p), height = dot(normal, (*face)[0] - p);
      if (slope != 0) candidates.push_back(make_point(slope * p + height * (q - p), slope));
    }
  }
  for (int k = 0; k < 3; ++k)
    for (int l = 0; l < 3; ++l) {
      // edge with edge: t = ((c - p) x v) . (u x v) / |u x v|^2; where the lines are skew the point fails the test
      // below
      const Vector p = a[k], u = a[(k + 1) % 3] - p, c = b[l], v = b[(l + 1) % 3] - c;
      const Vector uv = cross(u, v);
      if (is_zero(uv)) continue;
      candidates.push_back(make_point(dot(uv, uv) * p + dot(cross(c - p, v), uv) * u, dot(uv, uv)));
    }
  std::erase_if(candidates, [&](const RationalPoint& r) { return !in_hull(r, a) || !in_hull(r, b); });
  return candidates;
}

}  // namespace

std::vector<IntersectingPair> intersections_by_brute_force(std::span<const std::int64_t> coordinates,
                                                           std::span<const OracleTriangle> triangles) {
  const auto point = [&](std::int32_t v) {
    return Vector{coordinates[3 * v], coordinates[3 * v + 1], coordinates[3 * v + 2]};
  };
  const auto points = [&](const auto& ids) {
    Points result;
    for (const std::int32_t v : ids) result.push_back(point(v));
    return result;
  };
  const auto zero_area = [](const Points& t) { return is_zero(cross(t[1] - t[0], t[2] - t[0])); };

  std::vector<IntersectingPair> pairs;
  for (std::size_t i = 0; i < triangles.size(); ++i)
    for (std::size_t j = i + 1; j < triangles.size(); ++j) {
      const Points a = points(triangles[i]), b = points(triangles[j]);
      const auto kind = classify(triangles[i], triangles[j], zero_area(a) || zero_area(b), [&](const auto& shared) {
        const Points hull = points(shared);
        for (const RationalPoint& corner : corners_of_meeting(a, b))
          if (!in_hull(corner, hull)) return true;
        return false;
      });
      if (kind) pairs.push_back({static_cast<std::int32_t>(i), static_cast<std::int32_t>(j), *kind});
    }
  return pairs;
}

}  // namespace unsnarl::oracle
