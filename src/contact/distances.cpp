#include "contact/distances.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace unsnarl {
namespace {

/// Squared sine of the angle below which boundaries are tried besides the closed formula for interiors, and the nearest
/// point found wins (no unit)
constexpr double degenerate_sin2 = 1e-10;

/// Squared sine of the angle above which only the boundaries that the nearest point of lines or planes lies beyond are
/// tried: rounding does not blur the side. A convex function's minimum in a convex set lies on a side that faces its
/// minimum (no unit)
constexpr double safe_sin2 = 1e-4;

/// Nearest points before the square root is taken.
struct Nearest {
  Vec3 difference;
  double squared_distance = std::numeric_limits<double>::infinity();
  std::array<double, 4> weights;
};

Closest finish(const Nearest& nearest) {
  Closest result;
  result.distance = nearest.difference.norm();
  if (result.distance > 0) result.direction = nearest.difference / result.distance;
  result.weights = nearest.weights;
  return result;
}

/// Nearest point of the segment from a along e (to b) to p: parameter and difference.
double nearest_on_segment(const Vec3& p, const Vec3& a, const Vec3& b, Vec3& difference) {
  const Vec3 e = b - a;
  const Vec3 q = p - a;
  const double length2 = e.squaredNorm();
  const double t = length2 > 0 ? std::clamp(q.dot(e) / length2, 0.0, 1.0) : 0.0;
  // From the nearer end, so that the difference of large numbers is not taken there.
  if (t <= 0.5) {
    difference = q - t * e;
  } else {
    difference = (p - b) + (1 - t) * e;
  }
  return t;
}

Nearest nearest_vertex_face(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a;
  const Vec3 ac = c - a;
  const Vec3 ap = p - a;
  const Vec3 n = ab.cross(ac);
  const double n2 = n.squaredNorm();
  const double v = ap.cross(ac).dot(n);  // barycentric coordinate of b times n2
  const double w = ab.cross(ap).dot(n);  // and of c
  const double longest2 = std::max({ab.squaredNorm(), ac.squaredNorm(), (c - b).squaredNorm()});
  const bool sliver = n2 <= degenerate_sin2 * longest2 * longest2;
  const bool beyond[3] = {w<0, v + w> n2, v < 0};  // edge k
  const bool safe = (beyond[0] || beyond[1] || beyond[2]) && n2 > safe_sin2 * longest2 * longest2;

  Nearest best;
  if (n2 > 0 && v >= 0 && w >= 0 && v + w <= n2) {
    const double y = v / n2;
    const double z = w / n2;
    best.weights = {1, -std::max(0.0, 1 - y - z), -y, -z};
    // The difference is along the normal; taking it so keeps tiny distances accurate, unless the normal is not.
    best.difference = sliver ? Vec3(ap - y * ab - z * ac) : Vec3((ap.dot(n) / n2) * n);
    best.squared_distance = best.difference.squaredNorm();
    if (!sliver) return best;
  }
  const Vec3* corner[3] = {&a, &b, &c};
  for (int k = 0; k < 3; ++k) {
    if (safe && !beyond[k]) continue;
    Vec3 difference;
    const int next = (k + 1) % 3;
    const double t = nearest_on_segment(p, *corner[k], *corner[next], difference);
    const double squared_distance = difference.squaredNorm();
    if (squared_distance >= best.squared_distance) continue;
    best.difference = difference;
    best.squared_distance = squared_distance;
    best.weights = {1, 0, 0, 0};
    best.weights[1 + k] = -(1 - t);
    best.weights[1 + next] = -t;
  }
  return best;
}

Nearest nearest_edge_edge(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 u = b - a;
  const Vec3 v = d - c;
  const Vec3 r = a - c;
  const Vec3 n = u.cross(v);
  const double n2 = n.squaredNorm();
  Nearest best;
  bool safe = false;
  std::array<bool, 4> beyond{};  // vertex k's end
  if (n2 > 0) {
    const double scale2 = u.squaredNorm() * v.squaredNorm();
    const bool parallel = n2 <= degenerate_sin2 * scale2;
    // Lines: r + s u - t v is parallel to n.
    const double s = v.cross(r).dot(n) / n2;
    const double t = u.cross(r).dot(n) / n2;
    if (s >= 0 && s <= 1 && t >= 0 && t <= 1) {
      best.weights = {1 - s, s, -(1 - t), -t};
      best.difference = parallel ? Vec3(r + s * u - t * v) : Vec3((r.dot(n) / n2) * n);
      best.squared_distance = best.difference.squaredNorm();
      if (!parallel) return best;
    }
    beyond = {s<0, s> 1, t<0, t> 1};
    safe = (beyond[0] || beyond[1] || beyond[2] || beyond[3]) && n2 > safe_sin2 * scale2;
  }
  // The minimum lies on the boundary of the square of parameters: an end point against the other segment.
  for (int k = 0; k < 4; ++k) {
    if (safe && !beyond[k]) continue;
    Vec3 difference;
    const bool first = k < 2;
    const Vec3& p = k == 0 ? a : k == 1 ? b : k == 2 ? c : d;
    const double t = first ? nearest_on_segment(p, c, d, difference) : nearest_on_segment(p, a, b, difference);
    const double squared_distance = difference.squaredNorm();
    if (squared_distance >= best.squared_distance) continue;
    best.squared_distance = squared_distance;
    best.difference = first ? difference : Vec3(-difference);
    best.weights = {0, 0, 0, 0};
    best.weights[k] = first ? 1 : -1;
    best.weights[first ? 2 : 0] = first ? -(1 - t) : 1 - t;
    best.weights[first ? 3 : 1] = first ? -t : t;
  }
  return best;
}

Nearest nearest_vertex_edge(const Vec3& p, const Vec3& a, const Vec3& b) {
  Nearest best;
  const double t = nearest_on_segment(p, a, b, best.difference);
  best.squared_distance = best.difference.squaredNorm();
  best.weights = {1, -(1 - t), -t, 0};
  return best;
}

Nearest nearest(StencilKind kind, const std::array<Vec3, 4>& x) {
  switch (kind) {
    case StencilKind::vertex_face: return nearest_vertex_face(x[0], x[1], x[2], x[3]);
    case StencilKind::edge_edge: return nearest_edge_edge(x[0], x[1], x[2], x[3]);
    case StencilKind::vertex_edge: break;
  }
  return nearest_vertex_edge(x[0], x[1], x[2]);
}

Nearest nearest(const Stencil& stencil, const Positions& x) {
  const auto& v = stencil.v;
  switch (stencil.kind) {
    case StencilKind::vertex_face: return nearest_vertex_face(x.col(v[0]), x.col(v[1]), x.col(v[2]), x.col(v[3]));
    case StencilKind::edge_edge: return nearest_edge_edge(x.col(v[0]), x.col(v[1]), x.col(v[2]), x.col(v[3]));
    case StencilKind::vertex_edge: break;
  }
  return nearest_vertex_edge(x.col(v[0]), x.col(v[1]), x.col(v[2]));
}

}  // namespace

Closest closest_vertex_face(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  return finish(nearest_vertex_face(p, a, b, c));
}
Closest closest_edge_edge(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return finish(nearest_edge_edge(a, b, c, d));
}
Closest closest_vertex_edge(const Vec3& p, const Vec3& a, const Vec3& b) {
  return finish(nearest_vertex_edge(p, a, b));
}

Closest closest(const Stencil& stencil, const Positions& x) {
  return finish(nearest(stencil, x));
}

Closest closest(StencilKind kind, const std::array<Vec3, 4>& x) {
  return finish(nearest(kind, x));
}

double approach(const Stencil& s, std::span<const double> lengths) {
  switch (s.kind) {
    case StencilKind::vertex_face:
      return lengths[s.v[0]] + std::max({lengths[s.v[1]], lengths[s.v[2]], lengths[s.v[3]]});
    case StencilKind::edge_edge:
      return std::max(lengths[s.v[0]], lengths[s.v[1]]) + std::max(lengths[s.v[2]], lengths[s.v[3]]);
    case StencilKind::vertex_edge: break;
  }
  return lengths[s.v[0]] + std::max(lengths[s.v[1]], lengths[s.v[2]]);
}

double squared_distance(StencilKind kind, const std::array<Vec3, 4>& x) {
  return nearest(kind, x).squared_distance;
}

double squared_distance(const Stencil& stencil, const Positions& x) {
  return nearest(stencil, x).squared_distance;
}

}  // namespace unsnarl
