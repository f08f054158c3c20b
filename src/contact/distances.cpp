#include "contact/distances.h"

#include <algorithm>
#include <cmath>

namespace unsnarl {
namespace {

// Squared sine of the smallest angle for which the closed formulas for interiors are trusted alone; below it the
// boundaries are tried as well and the nearest point found wins. Costs nothing on ordinary meshes.
constexpr double degenerate_sin2 = 1e-10;

Closest finish(const Vec3& difference, const std::array<double, 4>& weights) {
  Closest result;
  result.distance = difference.norm();
  if (result.distance > 0) result.direction = difference / result.distance;
  result.weights = weights;
  return result;
}

/// Parameter in [0, 1] of the point of the segment from the origin along e that is nearest to p.
double nearest_parameter(const Vec3& p, const Vec3& e) {
  const double length2 = e.squaredNorm();
  return length2 > 0 ? std::clamp(p.dot(e) / length2, 0.0, 1.0) : 0.0;
}

}  // namespace

Closest closest_vertex_edge(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 e = b - a;
  const Vec3 q = p - a;
  // From the nearer end, so that the difference of large numbers is not taken there.
  const double t = nearest_parameter(q, e);
  const Vec3 difference = t <= 0.5 ? Vec3(q - t * e) : Vec3((p - b) + (1 - t) * e);
  return finish(difference, {1, -(1 - t), -t, 0});
}

Closest closest_vertex_face(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a;
  const Vec3 ac = c - a;
  const Vec3 ap = p - a;
  const Vec3 n = ab.cross(ac);
  const double n2 = n.squaredNorm();
  const double v = ap.cross(ac).dot(n);  // barycentric coordinate of b times n2
  const double w = ab.cross(ap).dot(n);  // and of c
  const double longest2 = std::max({ab.squaredNorm(), ac.squaredNorm(), (c - b).squaredNorm()});
  const bool sliver = n2 <= degenerate_sin2 * longest2 * longest2;
  const bool inside = n2 > 0 && v >= 0 && w >= 0 && v + w <= n2;

  Closest best;
  best.distance = std::numeric_limits<double>::infinity();
  if (inside) {
    const double y = v / n2;
    const double z = w / n2;
    const double x = std::max(0.0, 1 - y - z);
    if (sliver) {
      best = finish(ap - y * ab - z * ac, {1, -x, -y, -z});
    } else {
      // Away from the face's plane the difference is along the normal; taking it so keeps tiny distances accurate.
      const double height = ap.dot(n) / n2;
      best = finish(height * n, {1, -x, -y, -z});
      return best;
    }
  }
  const Closest edges[3] = {closest_vertex_edge(p, a, b), closest_vertex_edge(p, b, c), closest_vertex_edge(p, c, a)};
  for (int k = 0; k < 3; ++k) {
    if (edges[k].distance >= best.distance) continue;
    best = edges[k];
    best.weights = {1, 0, 0, 0};
    best.weights[1 + k] = edges[k].weights[1];
    best.weights[1 + (k + 1) % 3] = edges[k].weights[2];
  }
  return best;
}

Closest closest_edge_edge(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 u = b - a;
  const Vec3 v = d - c;
  const Vec3 r = a - c;
  const Vec3 n = u.cross(v);
  const double n2 = n.squaredNorm();
  const double uu = u.squaredNorm();
  const double vv = v.squaredNorm();

  Closest best;
  best.distance = std::numeric_limits<double>::infinity();
  const bool parallel = n2 <= degenerate_sin2 * uu * vv;
  if (n2 > 0) {
    // Lines: r + s u - t v is parallel to n.
    double s = v.cross(r).dot(n) / n2;
    double t = u.cross(r).dot(n) / n2;
    if (s >= 0 && s <= 1 && t >= 0 && t <= 1) {
      if (parallel) {
        best = finish(r + s * u - t * v, {1 - s, s, -(1 - t), -t});
      } else {
        return finish((r.dot(n) / n2) * n, {1 - s, s, -(1 - t), -t});
      }
    }
  }
  // The minimum lies on the boundary of the square of parameters: an end point against the other segment.
  const Closest ends[4] = {closest_vertex_edge(a, c, d), closest_vertex_edge(b, c, d), closest_vertex_edge(c, a, b),
                           closest_vertex_edge(d, a, b)};
  for (int k = 0; k < 4; ++k) {
    if (ends[k].distance >= best.distance) continue;
    best = ends[k];
    const double near = ends[k].weights[1];  // -(1 - t)
    const double far = ends[k].weights[2];   // -t
    switch (k) {
      case 0: best.weights = {1, 0, near, far}; break;
      case 1: best.weights = {0, 1, near, far}; break;
      case 2: best.weights = {-near, -far, -1, 0}; break;
      default: best.weights = {-near, -far, 0, -1}; break;
    }
    if (k >= 2) best.direction = -best.direction;
  }
  return best;
}

Closest closest(StencilKind kind, const std::array<Vec3, 4>& x) {
  switch (kind) {
    case StencilKind::vertex_face: return closest_vertex_face(x[0], x[1], x[2], x[3]);
    case StencilKind::edge_edge: return closest_edge_edge(x[0], x[1], x[2], x[3]);
    case StencilKind::vertex_edge: break;
  }
  return closest_vertex_edge(x[0], x[1], x[2]);
}

Closest closest(const Stencil& stencil, const Positions& x) {
  const auto& v = stencil.v;
  switch (stencil.kind) {
    case StencilKind::vertex_face: return closest_vertex_face(x.col(v[0]), x.col(v[1]), x.col(v[2]), x.col(v[3]));
    case StencilKind::edge_edge: return closest_edge_edge(x.col(v[0]), x.col(v[1]), x.col(v[2]), x.col(v[3]));
    case StencilKind::vertex_edge: break;
  }
  return closest_vertex_edge(x.col(v[0]), x.col(v[1]), x.col(v[2]));
}

}  // namespace unsnarl
