#pragma once

#include <array>

#include "contact/bvh.h"
#include "contact/distances.h"
#include "geometry/types.h"
#include "unsnarl/routes.h"

namespace unsnarl {

inline Vec3 vec(const RoutePoint& p) {
  return {p[0], p[1], p[2]};
}

/// Start, way-points, goal.
std::vector<Vec3> places_of(const RouteAgent& agent);

/// The closest approach of two points that move straight and evenly at the same time, from a to b and from c to d; as a
/// pair of places on the segments (a, b) and (c, d).
Closest closest_in_time(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// Where a segment is closest to a triangle: the vector from there is weights[0] p + weights[1] q - a point of the
/// triangle, of this length along `direction`. Distance and direction are zero where they meet.
struct ClosestToTriangle {
  double distance = 0;
  Vec3 direction = Vec3::Zero();
  std::array<double, 2> weights = {0, 0};
};
ClosestToTriangle closest_segment_triangle(const Vec3& p, const Vec3& q, const std::array<Vec3, 3>& triangle);

/// The triangles of all obstacles that stand, or of one that moves, where its surface is.
class ObstacleTriangles {
 public:
  explicit ObstacleTriangles(const RoutePlan& plan);
  ObstacleTriangles(const RoutePlan& plan, int obstacle);

  bool empty() const { return corners_.empty(); }
  Index size() const { return static_cast<Index>(corners_.size()); }
  const std::array<Vec3, 3>& corners(Index t) const { return corners_[t]; }
  int obstacle(Index t) const { return obstacle_[t]; }
  const Box& bounds() const { return bounds_; }

  /// Calls visit(Index) for the triangles whose boxes overlap this one, in an order that the triangles alone decide.
  template <class Visit>
  void near(const Box& box, Visit&& visit) const {
    bvh_.query(box, visit);
  }
  /// Whether the segment stays at least this far from all.
  bool is_clear(const Vec3& p, const Vec3& q, double distance) const;
  /// Distance to the nearest one, up to `most`.
  double distance(const Vec3& p, double most) const;

 private:
  void add(const RoutePlan& plan, int obstacle);
  void build();

  std::vector<std::array<Vec3, 3>> corners_;
  std::vector<int> obstacle_;
  Box bounds_;
  Bvh bvh_;
};

}  // namespace unsnarl
