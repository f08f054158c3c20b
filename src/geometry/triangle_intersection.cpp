#include "geometry/triangle_intersection.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/predicates.h"

namespace unsnarl {
namespace {

Sign side_of(const TrianglePoints& t, const Vec3& p) {
  return orient3d(t[0], t[1], t[2], p);
}

/// Squares of shorter vectors may underflow (unit: lengths of vectors)
constexpr double least_size = 1e-140;

/// The plane of a triangle, for the sides of many points: signs as of orient3d. The normal is computed once; its
/// rounding is part of the bound below which orient3d decides.
class PlaneSides {
 public:
  explicit PlaneSides(const TrianglePoints& t) : t_(t) {
    const Vec3 u = t[1] - t[0], v = t[2] - t[0];
    normal_ = u.cross(v);
    const double reach = std::max(u.cwiseAbs().maxCoeff(), v.cwiseAbs().maxCoeff()), reach2 = reach * reach;
    const bool is_in_range = reach2 > least && reach2 < largest;
    error_ = is_in_range ? height_bound * reach2 : std::numeric_limits<double>::infinity();
  }

  Sign of(const Vec3& p) const {
    const Height height = height_of(p);
    return height.is_certain() ? detail::sign_of(height.value) : side_of(t_, p);
  }

  /// Lower bound of the distance between the plane and a triangle; 0 where they may meet.
  double beyond(const TrianglePoints& points) const {
    double nearest = std::numeric_limits<double>::infinity();
    Sign side = 0;
    for (const Vec3& p : points) {
      const Height height = height_of(p);
      const Sign here = detail::sign_of(height.value);
      if (!height.is_certain() || here == -side) return 0;
      side = here;
      nearest = std::min(nearest, std::abs(height.value) - height.error);
    }
    return error_ > least_size && error_ < largest ? nearest / (normal_.norm() + error_) : 0;
  }

 private:
  /// Above the plane, times the normal's length.
  struct Height {
    double value, error;
    bool is_certain() const { return std::abs(value) > error && error > least && error < largest; }
  };
  Height height_of(const Vec3& p) const {
    const Vec3 q = p - t_[0];
    return {normal_.dot(q), error_ * q.cwiseAbs().maxCoeff()};
  }

  /// A height is wrong by less than this: differences, products of two and of three are rounded, by 48 half units in
  /// the last place in all (unit: largest differences, two from corner to corner times one to the point)
  static constexpr double height_bound = 64 * detail::half_ulp;
  static constexpr double least = detail::underflow_guard;
  static constexpr double largest = 1e280;  ///< Products below this do not overflow (fixed by float64)

  const TrianglePoints& t_;
  Vec3 normal_;
  double error_;
};

std::array<Sign, 3> sides_of(const TrianglePoints& t, const TrianglePoints& points) {
  const PlaneSides sides(t);
  return {sides.of(points[0]), sides.of(points[1]), sides.of(points[2])};
}

/// Lower bound of the distance of two triangles: how far apart they are along a direction within the plane of a, across
/// one of its edges; 0 where they are not, or rounding may deceive.
double separation_in_plane(const TrianglePoints& a, const TrianglePoints& b) {
  /// Rounding changes the distance of two projections by less than this: 10 half units in the last place (unit: size of
  /// the direction times the largest difference)
  constexpr double projection_rounding = 16 * detail::half_ulp;
  const Vec3 u = a[1] - a[0], v = a[2] - a[0], normal = u.cross(v);
  const Vec3 to[3] = {b[0] - a[0], b[1] - a[0], b[2] - a[0]};
  double reach = std::max(u.cwiseAbs().maxCoeff(), v.cwiseAbs().maxCoeff()), most = 0;
  for (const Vec3& p : to) reach = std::max(reach, p.cwiseAbs().maxCoeff());
  for (const Vec3& edge : {u, Vec3(v - u), Vec3(-v)}) {
    const Vec3 across = edge.cross(normal);  // outward
    const double own = std::max({0.0, across.dot(u), across.dot(v)});
    const double error = projection_rounding * across.cwiseAbs().sum() * reach;
    const double gap = std::min({across.dot(to[0]), across.dot(to[1]), across.dot(to[2])}) - own - error;
    if (!(gap > 0)) continue;
    const double size = across.norm();
    if (size > least_size && error > detail::underflow_guard) most = std::max(most, gap / size);
  }
  return std::isfinite(most) ? most : 0;
}

/// Both strictly on the same side.
bool same_side(Sign s, Sign t) {
  return s * t > 0;
}

/// p in the closed segment ab, all three known to be collinear.
bool between(const Vec3& a, const Vec3& b, const Vec3& p) {
  const bool forward = lexicographic_less(a, b);
  const Vec3& lo = forward ? a : b;
  const Vec3& hi = forward ? b : a;
  return !lexicographic_less(p, lo) && !lexicographic_less(hi, p);
}

/// Closed segments in the plane seen along `axis`, where not all four points are collinear.
bool segments_meet_in_plane(int axis, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Sign ca = orient2d_dropping(axis, a, b, c), da = orient2d_dropping(axis, a, b, d);
  if (same_side(ca, da)) return false;
  const Sign ac = orient2d_dropping(axis, c, d, a), bc = orient2d_dropping(axis, c, d, b);
  if (same_side(ac, bc)) return false;
  if (ca == 0 && da == 0) return between(a, b, c) || between(a, b, d) || between(c, d, a) || between(c, d, b);
  return true;
}

bool point_in_triangle_in_plane(int axis, const TrianglePoints& t, const Vec3& p) {
  const Sign s0 = orient2d_dropping(axis, t[0], t[1], p);
  const Sign s1 = orient2d_dropping(axis, t[1], t[2], p);
  const Sign s2 = orient2d_dropping(axis, t[2], t[0], p);
  return (s0 >= 0 && s1 >= 0 && s2 >= 0) || (s0 <= 0 && s1 <= 0 && s2 <= 0);
}

/// Segment and triangle known to lie in one plane.
bool segment_meets_triangle_in_plane(const Vec3& p, const Vec3& q, const TrianglePoints& t) {
  const int axis = projection_axis(t[0], t[1], t[2]);
  if (point_in_triangle_in_plane(axis, t, p) || point_in_triangle_in_plane(axis, t, q)) return true;
  for (int k = 0; k < 3; ++k)
    if (segments_meet_in_plane(axis, p, q, t[k], t[(k + 1) % 3])) return true;
  return false;
}

/// Segment against triangle when the sides of its ends are known.
bool segment_meets_triangle(const Vec3& p, Sign side_p, const Vec3& q, Sign side_q, const TrianglePoints& t) {
  if (same_side(side_p, side_q)) return false;
  if (side_p == 0 && side_q == 0) return segment_meets_triangle_in_plane(p, q, t);
  const Sign s0 = orient3d(p, q, t[0], t[1]);
  const Sign s1 = orient3d(p, q, t[1], t[2]);
  if (same_side(s0, -s1)) return false;
  const Sign s2 = orient3d(p, q, t[2], t[0]);
  return !same_side(s0, -s2) && !same_side(s1, -s2);
}

/// A degenerate triangle as the segment it covers; `lo == hi` for a point.
struct Extent {
  Vec3 lo, hi;
  bool is_point() const { return lo == hi; }
};
Extent extent_of(const TrianglePoints& t) {
  Extent e{t[0], t[0]};
  for (int k = 1; k < 3; ++k) {
    if (lexicographic_less(t[k], e.lo)) e.lo = t[k];
    if (lexicographic_less(e.hi, t[k])) e.hi = t[k];
  }
  return e;
}

/// A degenerate triangle has every point in its plane; only then is the exact test of degeneracy needed.
bool maybe_degenerate(const std::array<Sign, 3>& sides_of_others, const TrianglePoints& t) {
  return sides_of_others == std::array<Sign, 3>{0, 0, 0} && collinear(t[0], t[1], t[2]);
}

bool point_on_segment(const Extent& s, const Vec3& p) {
  return collinear(s.lo, s.hi, p) && between(s.lo, s.hi, p);
}

bool segments_meet(const Extent& s, const Extent& t) {
  if (s.is_point()) return point_on_segment(t, s.lo);
  if (t.is_point()) return point_on_segment(s, t.lo);
  if (orient3d(s.lo, s.hi, t.lo, t.hi) != 0) return false;
  int axis = projection_axis(s.lo, s.hi, t.lo);
  if (axis < 0) axis = projection_axis(s.lo, s.hi, t.hi);
  if (axis >= 0) return segments_meet_in_plane(axis, s.lo, s.hi, t.lo, t.hi);
  return between(s.lo, s.hi, t.lo) || between(s.lo, s.hi, t.hi) || between(t.lo, t.hi, s.lo);
}

/// Segment s and convex set b share the point `from`, an extreme common corner. Does b hold points of s beyond `from`
/// towards `to`, an end of s other than `from`?
bool continues_into(const Vec3& from, const Vec3& to, const TrianglePoints& b, int corner_of_b, bool b_is_degenerate) {
  if (b_is_degenerate) {
    const Extent e = extent_of(b);
    const bool forward = lexicographic_less(from, to);
    const Vec3& end = forward ? e.hi : e.lo;
    return end != from && collinear(from, to, end) && lexicographic_less(from, end) == forward;
  }
  if (side_of(b, to) != 0) return false;
  const int axis = projection_axis(b[0], b[1], b[2]);
  const Vec3 &v = b[corner_of_b], &next = b[(corner_of_b + 1) % 3], &previous = b[(corner_of_b + 2) % 3];
  const Sign turn = orient2d_dropping(axis, v, next, previous);
  return turn * orient2d_dropping(axis, v, next, to) >= 0 && turn * orient2d_dropping(axis, v, to, previous) >= 0;
}

}  // namespace

bool segment_meets_triangle(const Vec3& p, const Vec3& q, const TrianglePoints& t) {
  return segment_meets_triangle(p, side_of(t, p), q, side_of(t, q), t);
}

double separation(const TrianglePoints& a, const TrianglePoints& b) {
  if (const double beyond = PlaneSides(b).beyond(a); beyond > 0) return beyond;
  if (const double beyond = PlaneSides(a).beyond(b); beyond > 0) return beyond;
  return std::max(separation_in_plane(a, b), separation_in_plane(b, a));
}

Meeting triangles_meet(const TrianglePoints& a, const TrianglePoints& b) {
  const std::array<Sign, 3> sides_a = sides_of(b, a);
  if (same_side(sides_a[0], sides_a[1]) && same_side(sides_a[0], sides_a[2])) return Meeting::no;
  const std::array<Sign, 3> sides_b = sides_of(a, b);
  if (same_side(sides_b[0], sides_b[1]) && same_side(sides_b[0], sides_b[2])) return Meeting::no;
  if (maybe_degenerate(sides_a, b) || maybe_degenerate(sides_b, a)) return Meeting::ask_degenerate;
  // Where two triangles meet, an edge of one meets the other.
  for (int k = 0; k < 3; ++k) {
    const int l = (k + 1) % 3;
    if (segment_meets_triangle(a[k], sides_a[k], a[l], sides_a[l], b)) return Meeting::yes;
    if (segment_meets_triangle(b[k], sides_b[k], b[l], sides_b[l], a)) return Meeting::yes;
  }
  return Meeting::no;
}

Meeting triangles_meet_beyond_vertex(const TrianglePoints& a, const TrianglePoints& b) {
  // Both are convex and hold the vertex: going on from it through another common point, one of them is left through
  // the edge opposite the vertex, at a point of the other.
  const PlaneSides of_b(b);
  const std::array<Sign, 3> sides_a = {0, of_b.of(a[1]), of_b.of(a[2])};
  if (same_side(sides_a[1], sides_a[2])) return Meeting::no;
  const PlaneSides of_a(a);
  const std::array<Sign, 3> sides_b = {0, of_a.of(b[1]), of_a.of(b[2])};
  if (same_side(sides_b[1], sides_b[2])) return Meeting::no;
  if (maybe_degenerate(sides_a, b) || maybe_degenerate(sides_b, a)) return Meeting::ask_degenerate;
  const bool meet = segment_meets_triangle(a[1], sides_a[1], a[2], sides_a[2], b) ||
                    segment_meets_triangle(b[1], sides_b[1], b[2], sides_b[2], a);
  return meet ? Meeting::yes : Meeting::no;
}

Meeting triangles_fold_flat(const TrianglePoints& a, const TrianglePoints& b) {
  if (side_of(a, b[2]) != 0) return Meeting::no;
  const int axis = projection_axis(a[0], a[1], a[2]);
  if (axis < 0 || collinear(b[0], b[1], b[2])) return Meeting::ask_degenerate;
  const bool overlap = same_side(orient2d_dropping(axis, a[0], a[1], a[2]), orient2d_dropping(axis, a[0], a[1], b[2]));
  return overlap ? Meeting::yes : Meeting::no;
}

bool degenerate_triangles_meet(const TrianglePoints& a, const TrianglePoints& b, const std::array<int, 3>& shared_a) {
  const bool degenerate_a = collinear(a[0], a[1], a[2]);
  const bool degenerate_b = collinear(b[0], b[1], b[2]);
  if (!degenerate_a) {
    std::array<int, 3> shared_b = {-1, -1, -1};
    for (int k = 0; k < 3; ++k)
      if (shared_a[k] >= 0) shared_b[shared_a[k]] = k;
    return degenerate_triangles_meet(b, a, shared_b);
  }
  const Extent s = extent_of(a);
  int first = -1, last = -1;  // extreme shared corners along s
  for (int k = 0; k < 3; ++k) {
    if (shared_a[k] < 0) continue;
    if (first < 0 || lexicographic_less(a[k], a[first])) first = k;
    if (last < 0 || lexicographic_less(a[last], a[k])) last = k;
  }
  if (first < 0) {
    if (degenerate_b) return segments_meet(s, extent_of(b));
    return segment_meets_triangle(s.lo, s.hi, b);
  }
  return (a[first] != s.lo && continues_into(a[first], s.lo, b, shared_a[first], degenerate_b)) ||
         (a[last] != s.hi && continues_into(a[last], s.hi, b, shared_a[last], degenerate_b));
}

}  // namespace unsnarl
