#include "contact/closed_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/bvh_traversal.h"
#include "geometry/predicates.h"
#include "mesh/adjacency.h"

namespace unsnarl {
namespace {

/// Side of the line through a and b, seen along x, that p shifted by (0, e, e^2) is on. 0: a and b are one point there.
Sign side_of_line(const Vec3& a, const Vec3& b, const Vec3& p) {
  if (const Sign side = orient2d(a[1], a[2], b[1], b[2], p[1], p[2]); side != 0) return side;
  if (a[2] != b[2]) return a[2] > b[2] ? 1 : -1;
  return (b[1] > a[1]) - (b[1] < a[1]);
}

/// Side of all edges of the triangle, seen along x, that p shifted by (0, e, e^2) is on; 0: not of one and the same.
Sign side_of_triangle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p) {
  const Sign side = side_of_line(a, b, p);
  return side != 0 && side_of_line(b, c, p) == side && side_of_line(c, a, p) == side ? side : 0;
}

/// x of the triangle where it is crossed by the line along x through p.
double place_on_line(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p) {
  const auto area = [&](const Vec3& v, const Vec3& w) {
    return std::abs((v[1] - p[1]) * (w[2] - p[2]) - (v[2] - p[2]) * (w[1] - p[1]));
  };
  const double of_a = area(b, c), of_b = area(c, a), of_c = area(a, b), sum = of_a + of_b + of_c;
  const double place = sum > 0 ? (of_a * a[0] + of_b * b[0] + of_c * c[0]) / sum : (a[0] + b[0] + c[0]) / 3;
  return std::clamp(place, std::min({a[0], b[0], c[0]}), std::max({a[0], b[0], c[0]}));
}

}  // namespace

void ClosedSurface::update(const Positions& x) {
  x_ = x;
  box_ = {};
  std::vector<Box> boxes;
  boxes.reserve(triangles_.size());
  for (const Triangle& t : triangles_) box_.extend(boxes.emplace_back(box_of(x_, t)));
  if (bvh_.size() == static_cast<Index>(boxes.size()))
    bvh_.refit(boxes);
  else
    bvh_.build(boxes);
}

// A triangle without area has edges in common with others, which have the point too.
bool ClosedSurface::has(const Vec3& p, const Triangle& t) const {
  const Vec3 a = x_.col(t[0]), b = x_.col(t[1]), c = x_.col(t[2]);
  if (!box_of(x_, t).overlaps({p, p}) || orient3d(a, b, c, p) != 0) return false;
  const int axis = projection_axis(a, b, c);
  if (axis < 0) return false;
  const Sign u = orient2d_dropping(axis, a, b, p), v = orient2d_dropping(axis, b, c, p),
             w = orient2d_dropping(axis, c, a, p);
  return std::min({u, v, w}) >= 0 || std::max({u, v, w}) <= 0;
}

Side ClosedSurface::side_of(const Vec3& p) const {
  if (!box_.overlaps({p, p})) return Side::outside;
  bool is_inside = false;
  Box ray = {p, p};
  ray.hi[0] = box_.hi[0];
  const bool is_on = bvh_.find(ray, [&](Index i) {
    const Triangle& t = triangles_[i];
    if (has(p, t)) return true;
    const Vec3 a = x_.col(t[0]), b = x_.col(t[1]), c = x_.col(t[2]);
    const Sign side = side_of_triangle(a, b, c, p);
    if (side != 0 && orient3d(a, b, c, p) == -side) is_inside = !is_inside;
    return false;
  });
  return is_on ? Side::on : is_inside ? Side::inside : Side::outside;
}

std::vector<double> ClosedSurface::crossings(double y, double z) const {
  std::vector<double> places;
  const Vec3 p(box_.lo[0], y, z);
  Box line = {p, p};
  line.hi[0] = box_.hi[0];
  bvh_.query(line, [&](Index i) {
    const Vec3 a = x_.col(triangles_[i][0]), b = x_.col(triangles_[i][1]), c = x_.col(triangles_[i][2]);
    if (side_of_triangle(a, b, c, p) != 0) places.push_back(place_on_line(a, b, c, p));
  });
  std::sort(places.begin(), places.end());
  return places;
}

ClosedSurface::Nearest ClosedSurface::nearest(const Vec3& p, double guess,
                                              const std::function<bool(Index)>& accept) const {
  Nearest nearest;
  if (triangles_.empty()) return nearest;
  // No farther than the farthest corner of the box around all.
  const double most = (p - box_.lo).cwiseAbs().cwiseMax((p - box_.hi).cwiseAbs()).norm();
  for (double reach = guess > 0 ? guess : most;; reach *= 2) {
    double least = std::numeric_limits<double>::infinity();
    bvh_.query(Box{p, p}.inflated(reach), [&](Index i) {
      if (accept && !accept(i)) return;
      const Triangle& t = triangles_[i];
      const Closest closest = closest_vertex_face(p, x_.col(t[0]), x_.col(t[1]), x_.col(t[2]));
      if (closest.distance > least || (closest.distance == least && i > nearest.triangle)) return;
      least = closest.distance;
      nearest = {i, closest};
    });
    if (least <= reach || reach >= most) return nearest;
  }
}

Edge first_open_edge(std::span<const Triangle> triangles) {
  const EdgeTable table = build_edges(triangles);
  for (std::size_t e = 0; e < table.edges.size(); ++e)
    if (table.triangles_of_edge[static_cast<Index>(e)].size() % 2 != 0) return table.edges[e];
  return {-1, -1};
}

}  // namespace unsnarl
