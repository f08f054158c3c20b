#include "energy/minkowski_penalty.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/parallel.h"
#include "geometry/triangle_intersection.h"

namespace unsnarl {
namespace {

/// Edges are parallel, and span no normal, where the squared sine between them is below this (no unit)
constexpr double parallel_squared_sine = 1e-16;
/// A foot point lies beyond its feature by this at most, so that nearly parallel lines cannot fling their vertices
/// (unit: barycentric coordinates)
constexpr double max_extrapolation = 1.0;
/// A task of a parallel loop has this many pairs (unit: pairs)
constexpr std::size_t chunk_size = 4096;

enum class Kind { face_a, face_b, edge_edge, in_plane_a, in_plane_b };

struct Candidate {
  double depth = std::numeric_limits<double>::infinity();
  Vec3 normal = Vec3::Zero();
  Kind kind = Kind::face_a;
  int edge_a = 0;
  int edge_b = 0;
};

struct Interval {
  double lo, hi;
};

inline Interval project(std::span<const Vec3> points, const Vec3& n) {
  double lo = n.dot(points[0]), hi = lo;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double d = n.dot(points[i]);
    lo = std::min(lo, d);
    hi = std::max(hi, d);
  }
  return {lo, hi};
}

// Depth along both signs of n (any length); false: separated by more than the margin, nothing more to do.
inline bool offer(std::span<const Vec3> a, std::span<const Vec3> b, const Vec3& n, double squared_length, double margin,
                  Kind kind, int edge_a, int edge_b, Candidate& best) {
  const Interval pa = project(a, n), pb = project(b, n);
  const double forward = pb.hi - pa.lo;   // A moves along +n
  const double backward = pa.hi - pb.lo;  // A moves along -n
  const double shorter = std::min(forward, backward);
  const double inverse = 1.0 / std::sqrt(squared_length);
  const double depth = shorter * inverse + margin;
  if (depth < best.depth) {
    best.depth = depth;
    best.normal = n * (forward <= backward ? inverse : -inverse);
    best.kind = kind;
    best.edge_a = edge_a;
    best.edge_b = edge_b;
  }
  return depth > 0;
}

inline Vec3 polygon_normal(std::span<const Vec3> p) {
  Vec3 n = Vec3::Zero();
  for (std::size_t i = 2; i < p.size(); ++i) n += (p[i - 1] - p[0]).cross(p[i] - p[0]);
  return n;
}

inline double squared_extent(std::span<const Vec3> p) {
  double extent = 0;
  for (std::size_t i = 0; i < p.size(); ++i) extent = std::max(extent, (p[(i + 1) % p.size()] - p[i]).squaredNorm());
  return extent;
}

// A candidate normal by number: faces of a and b, edge x edge, in-plane of a and of b. Zero: there is none.
struct Plane {
  std::span<const Vec3> a, b;
  Vec3 normal_a, normal_b;  // zero for a face without area
  Vec3 plane_a, plane_b;    // the same, borrowed from the other face where zero
  int size_a, size_b;

  Plane(std::span<const Vec3> a_in, std::span<const Vec3> b_in)
      : a(a_in),
        b(b_in),
        normal_a(polygon_normal(a)),
        normal_b(polygon_normal(b)),
        size_a(static_cast<int>(a.size())),
        size_b(static_cast<int>(b.size())) {
    const double extent_a = squared_extent(a), extent_b = squared_extent(b);
    if (normal_a.squaredNorm() <= parallel_squared_sine * extent_a * extent_a) normal_a.setZero();
    if (normal_b.squaredNorm() <= parallel_squared_sine * extent_b * extent_b) normal_b.setZero();
    plane_a = normal_a.isZero(0) ? normal_b : normal_a;
    plane_b = normal_b.isZero(0) ? normal_a : normal_b;
  }
  Vec3 edge_a(int i) const { return a[i + 1 == size_a ? 0 : i + 1] - a[i]; }
  Vec3 edge_b(int j) const { return b[j + 1 == size_b ? 0 : j + 1] - b[j]; }
};

inline constexpr std::uint8_t no_hint = 255;  ///< Marks a pair without a hint (fixed by the type)

// Whether candidate k alone shows the two apart by the margin; computes no other normal. Gives the depth there.
bool still_separated(std::span<const Vec3> a, std::span<const Vec3> b, double margin, int k, double& depth) {
  const int size_a = static_cast<int>(a.size()), size_b = static_cast<int>(b.size()), crosses = size_a * size_b;
  const auto edge = [](std::span<const Vec3> p, int i) {
    return Vec3(p[i + 1 == static_cast<int>(p.size()) ? 0 : i + 1] - p[i]);
  };
  Vec3 n;
  if (k < 2) {
    n = polygon_normal(k == 0 ? a : b);
  } else if (k < 2 + crosses) {
    n = edge(a, (k - 2) / size_b).cross(edge(b, (k - 2) % size_b));
  } else if (k < 2 + crosses + size_a) {
    n = polygon_normal(a).cross(edge(a, k - 2 - crosses));
  } else if (k < 2 + crosses + size_a + size_b) {
    n = polygon_normal(b).cross(edge(b, k - 2 - crosses - size_a));
  } else {
    return false;
  }
  const Interval pa = project(a, n), pb = project(b, n);
  const double shorter = std::min(pb.hi - pa.lo, pa.hi - pb.lo);
  if (!(shorter < 0)) return false;
  depth = shorter / n.norm() + margin;
  return depth <= 0;
}

// The candidate normal of least depth. depth <= 0 or infinite: nothing to penalise.
Candidate least_depth(std::span<const Vec3> a, std::span<const Vec3> b, double margin, std::uint8_t* hint) {
  Candidate best;
  if (hint && still_separated(a, b, margin, *hint, best.depth)) return best;
  best = {};
  const Plane plane(a, b);
  const int crosses = plane.size_a * plane.size_b;
  const int count = 2 + crosses + (margin > 0 ? plane.size_a + plane.size_b : 0);
  // False: separated.
  const auto consider = [&](int k) {
    if (k < 2) {
      const Vec3& n = k == 0 ? plane.normal_a : plane.normal_b;
      const double squared = n.squaredNorm();
      return squared <= 0 || offer(a, b, n, squared, margin, k == 0 ? Kind::face_a : Kind::face_b, 0, 0, best);
    }
    k -= 2;
    if (k < crosses) {
      const int i = k / plane.size_b, j = k % plane.size_b;
      const Vec3 ea = plane.edge_a(i), eb = plane.edge_b(j);
      const Vec3 n = ea.cross(eb);
      const double squared = n.squaredNorm();
      return squared <= parallel_squared_sine * ea.squaredNorm() * eb.squaredNorm() ||
             offer(a, b, n, squared, margin, Kind::edge_edge, i, j, best);
    }
    k -= crosses;
    const bool of_a = k < plane.size_a;
    const int edge = of_a ? k : k - plane.size_a;
    const Vec3 n = of_a ? plane.plane_a.cross(plane.edge_a(edge)) : plane.plane_b.cross(plane.edge_b(edge));
    const double squared = n.squaredNorm();
    return squared <= 0 || offer(a, b, n, squared, margin, of_a ? Kind::in_plane_a : Kind::in_plane_b, of_a ? edge : 0,
                                 of_a ? 0 : edge, best);
  };
  for (int k = 0; k < count; ++k) {
    if (consider(k)) continue;
    if (hint) *hint = static_cast<std::uint8_t>(k);
    return best;
  }
  return best;
}

// The corner that is extreme along n; the first of equals.
int extreme(std::span<const Vec3> p, const Vec3& n, double sign) {
  int best = 0;
  double best_value = sign * n.dot(p[0]);
  for (int i = 1; i < static_cast<int>(p.size()); ++i) {
    const double value = sign * n.dot(p[i]);
    if (value > best_value) best_value = value, best = i;
  }
  return best;
}

double bounded(double t) {
  return std::clamp(t, -max_extrapolation, 1 + max_extrapolation);
}

// Weights of the point of the polygon's plane below q, on the triangle of the fan that comes closest to holding it.
void foot_on_face(std::span<const Vec3> p, const Vec3& q, std::span<double> weight) {
  std::fill(weight.begin(), weight.end(), 0.0);
  double best = -std::numeric_limits<double>::infinity();
  std::array<double, 3> best_weights{1, 0, 0};
  std::size_t best_triangle = 2;
  for (std::size_t i = 2; i < p.size(); ++i) {
    const Vec3 e1 = p[i - 1] - p[0], e2 = p[i] - p[0], d = q - p[0];
    const Vec3 n = e1.cross(e2);
    const double nn = n.squaredNorm();
    if (nn <= 0) continue;
    const double w1 = d.cross(e2).dot(n) / nn, w2 = e1.cross(d).dot(n) / nn;
    const double smallest = std::min({w1, w2, 1 - w1 - w2});
    if (smallest > best) {
      best = smallest;
      best_weights = {1 - w1 - w2, w1, w2};
      best_triangle = i;
    }
  }
  if (best < -max_extrapolation) {  // far outside: shrink towards the middle
    const double shrink = (1.0 / 3 + max_extrapolation) / (1.0 / 3 - best);
    for (double& w : best_weights) w = 1.0 / 3 + shrink * (w - 1.0 / 3);
  }
  weight[0] = best_weights[0];
  weight[best_triangle - 1] = best_weights[1];
  weight[best_triangle] = best_weights[2];
}

void foot_on_edge(int size, int edge, double t, std::span<double> weight) {
  std::fill(weight.begin(), weight.end(), 0.0);
  weight[edge] = 1 - t;
  weight[(edge + 1) % size] = t;
}

void foot_at_corner(int corner, std::span<double> weight) {
  std::fill(weight.begin(), weight.end(), 0.0);
  weight[corner] = 1;
}

// In-plane normals: one side is an edge, the other a corner (or an edge parallel to it). Parameter of q along the edge.
double along(const Vec3& p0, const Vec3& p1, const Vec3& q) {
  const Vec3 e = p1 - p0;
  return bounded((q - p0).dot(e) / e.squaredNorm());
}

void foot_points(std::span<const Vec3> a, std::span<const Vec3> b, const Candidate& best, std::span<double> weight_a,
                 std::span<double> weight_b) {
  const int size_a = static_cast<int>(a.size()), size_b = static_cast<int>(b.size());
  const Vec3& n = best.normal;
  // A's support is its lowest corner along n, B's its highest.
  switch (best.kind) {
    case Kind::face_a: {
      const int corner = extreme(b, n, 1);
      foot_at_corner(corner, weight_b);
      foot_on_face(a, b[corner], weight_a);
      break;
    }
    case Kind::face_b: {
      const int corner = extreme(a, n, -1);
      foot_at_corner(corner, weight_a);
      foot_on_face(b, a[corner], weight_b);
      break;
    }
    case Kind::edge_edge: {
      // Where an extreme corner is off the edge that gave the normal, the support is that corner alone.
      const auto support = [&n](std::span<const Vec3> p, int edge, double sign) {
        const int corner = extreme(p, n, sign);
        return corner == edge || corner == (edge + 1) % static_cast<int>(p.size()) ? -1 : corner;
      };
      const int corner_a = support(a, best.edge_a, -1), corner_b = support(b, best.edge_b, 1);
      const Vec3 &a0 = a[best.edge_a], &a1 = a[(best.edge_a + 1) % size_a];
      const Vec3 &b0 = b[best.edge_b], &b1 = b[(best.edge_b + 1) % size_b];
      if (corner_a < 0 && corner_b < 0) {
        const Vec3 ea = a1 - a0, eb = b1 - b0, r = a0 - b0;
        const double aa = ea.squaredNorm(), bb = eb.squaredNorm(), ab = ea.dot(eb);
        const double ar = ea.dot(r), br = eb.dot(r);
        const double determinant = aa * bb - ab * ab;
        const double s = determinant > 0 ? (ab * br - bb * ar) / determinant : 0.5;
        const double t = (ab * s + br) / bb;
        foot_on_edge(size_a, best.edge_a, bounded(s), weight_a);
        foot_on_edge(size_b, best.edge_b, bounded(t), weight_b);
      } else if (corner_a >= 0 && corner_b >= 0) {
        foot_at_corner(corner_a, weight_a);
        foot_at_corner(corner_b, weight_b);
      } else if (corner_a >= 0) {
        foot_at_corner(corner_a, weight_a);
        foot_on_edge(size_b, best.edge_b, along(b0, b1, a[corner_a]), weight_b);
      } else {
        foot_at_corner(corner_b, weight_b);
        foot_on_edge(size_a, best.edge_a, along(a0, a1, b[corner_b]), weight_a);
      }
      break;
    }
    case Kind::in_plane_a: {
      const int corner_a = extreme(a, n, -1), corner_b = extreme(b, n, 1);
      foot_at_corner(corner_b, weight_b);
      const int next = (best.edge_a + 1) % size_a;
      if (corner_a == best.edge_a || corner_a == next) {
        foot_on_edge(size_a, best.edge_a, along(a[best.edge_a], a[next], b[corner_b]), weight_a);
      } else {
        foot_at_corner(corner_a, weight_a);
      }
      break;
    }
    case Kind::in_plane_b: {
      const int corner_a = extreme(a, n, -1), corner_b = extreme(b, n, 1);
      foot_at_corner(corner_a, weight_a);
      const int next = (best.edge_b + 1) % size_b;
      if (corner_b == best.edge_b || corner_b == next) {
        foot_on_edge(size_b, best.edge_b, along(b[best.edge_b], b[next], a[corner_a]), weight_b);
      } else {
        foot_at_corner(corner_b, weight_b);
      }
      break;
    }
  }
}

}  // namespace

Penetration triangle_penetration(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b, double margin,
                                 std::uint8_t* hint) {
  const Candidate best = least_depth(a, b, margin, hint);
  Penetration result;
  if (!(best.depth < std::numeric_limits<double>::infinity())) return result;
  result.depth = best.depth;
  result.normal = best.normal;
  if (best.depth > 0) foot_points(a, b, best, result.weight_a, result.weight_b);
  return result;
}

double overlap_depth(const Positions& x, const Triangle& a, const Triangle& b) {
  return triangle_penetration(points_of(x, a), points_of(x, b), 0).depth;
}

PolygonPenetration polygon_penetration(std::span<const Vec3> a, std::span<const Vec3> b, double margin,
                                       std::span<double> weight_a, std::span<double> weight_b) {
  const Candidate best = least_depth(a, b, margin, nullptr);
  PolygonPenetration result;
  if (!(best.depth < std::numeric_limits<double>::infinity())) return result;
  result.depth = best.depth;
  result.normal = best.normal;
  if (best.depth > 0) foot_points(a, b, best, weight_a, weight_b);
  return result;
}

Penetration one_vertex_penetration(const std::array<Vec3, 3>& a, int shared_a, const std::array<Vec3, 3>& b,
                                   int shared_b, double trim, double margin, std::uint8_t* hint) {
  const auto trimmed = [trim](const std::array<Vec3, 3>& t, int shared) {
    std::array<Vec3, 3> result = t;
    result[shared] = (1 - trim) * t[shared] + (0.5 * trim) * (t[(shared + 1) % 3] + t[(shared + 2) % 3]);
    return result;
  };
  const auto untrim = [trim](std::array<double, 3>& weight, int shared) {
    const double w = weight[shared];
    weight[shared] = (1 - trim) * w;
    weight[(shared + 1) % 3] += 0.5 * trim * w;
    weight[(shared + 2) % 3] += 0.5 * trim * w;
  };
  Penetration result = triangle_penetration(trimmed(a, shared_a), trimmed(b, shared_b), margin, hint);
  if (result.depth > 0) {
    untrim(result.weight_a, shared_a);
    untrim(result.weight_b, shared_b);
  }
  return result;
}

Penetration fold_penetration(const Vec3& u, const Vec3& v, const Vec3& p, const Vec3& q, double margin,
                             double max_slope, int flat_side) {
  Penetration result;
  const Vec3 e = v - u;
  const double ee = e.squaredNorm();
  if (ee <= 0) return result;
  const Vec3 rise_p = (p - u) - e * ((p - u).dot(e) / ee);
  const Vec3 rise_q = (q - u) - e * ((q - u).dot(e) / ee);
  const double inner = rise_p.dot(rise_q);
  if (inner <= 0) return result;  // open by 90 degrees or more
  const double height_p = rise_p.norm(), height_q = rise_q.norm();
  const bool p_is_lower = height_p < height_q;
  const Vec3& low = p_is_lower ? p : q;
  const Vec3& high = p_is_lower ? q : p;
  const double low_height = std::min(height_p, height_q);
  const double wanted = std::min(margin, max_slope * low_height);
  Vec3 n = e.cross(high - u);
  const double length = n.norm();
  if (length <= 0) return result;
  n /= length;
  const double offset = n.dot(low - u);
  const double side = offset > 0 ? 1 : offset < 0 ? -1 : flat_side;
  result.depth = wanted - side * offset;
  if (result.depth <= 0) return result;
  // Foot of `low` on the plane of (u, v, high).
  const double w_high = inner / (std::max(height_p, height_q) * std::max(height_p, height_q));
  const Vec3 flat = low - n * offset;
  const double t = (flat - u - w_high * (high - u)).dot(e) / ee;
  const std::array<double, 3> on_high{1 - t - w_high, t, w_high}, on_low{0, 0, 1};
  // The lower apex moves along +side n, its foot along -side n.
  result.normal = (p_is_lower ? side : -side) * n;
  result.weight_a = p_is_lower ? on_low : on_high;
  result.weight_b = p_is_lower ? on_high : on_low;
  return result;
}

Penetration MinkowskiPenalty::evaluate(const Positions& x, Index a, Index b, std::uint8_t* hint) const {
  const Triangle &ta = triangles_[a], &tb = triangles_[b];
  int shared = 0;
  std::array<int, 3> in_a{}, in_b{};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (ta[i] != tb[j] || shared == 3) continue;
      in_a[shared] = i;
      in_b[shared] = j;
      ++shared;
    }
  }
  if (shared == 0) {
    return triangle_penetration(points_of(x, ta), points_of(x, tb), options_.margin, hint);
  }
  if (shared == 1 && options_.one_vertex) {
    return one_vertex_penetration(points_of(x, ta), in_a[0], points_of(x, tb), in_b[0], options_.vertex_trim,
                                  options_.margin, hint);
  }
  // A triangle with a repeated vertex can share "two" corners that are one; it has no fold.
  if (shared == 2 && options_.folded && in_a[0] != in_a[1] && in_b[0] != in_b[1]) {
    const int apex_a = 3 - in_a[0] - in_a[1], apex_b = 3 - in_b[0] - in_b[1];
    const Penetration local = fold_penetration(x.col(ta[in_a[0]]), x.col(ta[in_a[1]]), x.col(ta[apex_a]),
                                               x.col(tb[apex_b]), options_.margin, options_.fold_slope);
    Penetration result = local;
    result.weight_a[in_a[0]] = local.weight_a[0];
    result.weight_a[in_a[1]] = local.weight_a[1];
    result.weight_a[apex_a] = local.weight_a[2];
    result.weight_b[in_b[0]] = local.weight_b[0];
    result.weight_b[in_b[1]] = local.weight_b[1];
    result.weight_b[apex_b] = local.weight_b[2];
    return result;
  }
  return {};
}

double MinkowskiPenalty::value_and_gradient(const Positions& x, Positions& gradient, double weight) {
  if (hints_.size() != pairs.size()) hints_.assign(pairs.size(), no_hint);
  const std::size_t chunks = (pairs.size() + chunk_size - 1) / chunk_size;
  contacts_.resize(std::max(contacts_.size(), chunks));
  const auto evaluate_chunk = [&](std::size_t chunk) {
    contacts_[chunk].clear();
    const std::size_t end = std::min(pairs.size(), (chunk + 1) * chunk_size);
    for (std::size_t k = chunk * chunk_size; k < end; ++k) {
      const auto [a, b] = pairs[k];
      const Penetration penetration = evaluate(x, a, b, &hints_[k]);
      if (penetration.depth > 0) contacts_[chunk].push_back({a, b, penetration});
    }
  };
  if (chunks < 2) {
    for (std::size_t chunk = 0; chunk < chunks; ++chunk) evaluate_chunk(chunk);
  } else {
    parallel_for(chunks, evaluate_chunk);
  }
  double value = 0;
  for (std::size_t chunk = 0; chunk < chunks; ++chunk) {
    for (const Contact& contact : contacts_[chunk]) {
      const Penetration& penetration = contact.penetration;
      value += penetration.depth;
      const Vec3 force = weight * penetration.normal;
      for (int i = 0; i < 3; ++i) {
        gradient.col(triangles_[contact.a][i]) -= penetration.weight_a[i] * force;
        gradient.col(triangles_[contact.b][i]) += penetration.weight_b[i] * force;
      }
    }
  }
  return weight * value;
}

}  // namespace unsnarl
