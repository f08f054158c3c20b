#include "applications/routes/segments.h"

#include "geometry/predicates.h"
#include "mesh/triangulation.h"

namespace unsnarl {
namespace {

bool pierces(const Vec3& p, const Vec3& q, const std::array<Vec3, 3>& t) {
  const Sign above = orient3d(t[0], t[1], t[2], p), below = orient3d(t[0], t[1], t[2], q);
  if (above * below >= 0) return false;  // touching has a distance of zero from a corner or edge, or from an end
  const Sign a = orient3d(p, q, t[0], t[1]), b = orient3d(p, q, t[1], t[2]), c = orient3d(p, q, t[2], t[0]);
  return (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0);
}

}  // namespace

std::vector<Vec3> places_of(const RouteAgent& agent) {
  std::vector<Vec3> places{vec(agent.start)};
  for (const RoutePoint& p : agent.waypoints) places.push_back(vec(p));
  places.push_back(vec(agent.goal));
  return places;
}

Closest closest_in_time(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 from = a - c, change = (b - d) - from;
  const double squared = change.squaredNorm();
  const double t = squared > 0 ? std::clamp(-from.dot(change) / squared, 0.0, 1.0) : 0.0;
  const Vec3 between = from + t * change;
  Closest closest;
  closest.distance = between.norm();
  if (closest.distance > 0) closest.direction = between / closest.distance;
  closest.weights = {1 - t, t, t - 1, -t};
  return closest;
}

ClosestToTriangle closest_segment_triangle(const Vec3& p, const Vec3& q, const std::array<Vec3, 3>& t) {
  ClosestToTriangle best;
  if (pierces(p, q, t)) return best;
  best.distance = std::numeric_limits<double>::infinity();
  const auto take = [&](const Closest& c, double at_p, double at_q) {
    if (c.distance < best.distance) best = {c.distance, c.direction, {at_p, at_q}};
  };
  take(closest_vertex_face(p, t[0], t[1], t[2]), 1, 0);
  take(closest_vertex_face(q, t[0], t[1], t[2]), 0, 1);
  for (int k = 0; k < 3; ++k) {
    const Closest c = closest_edge_edge(p, q, t[k], t[(k + 1) % 3]);
    take(c, c.weights[0], c.weights[1]);
  }
  return best;
}

ObstacleTriangles::ObstacleTriangles(const RoutePlan& plan) {
  for (std::size_t o = 0; o < plan.obstacles.size(); ++o)
    if (plan.obstacles[o].motion.empty()) add(plan, static_cast<int>(o));
  build();
}

ObstacleTriangles::ObstacleTriangles(const RoutePlan& plan, int obstacle) {
  add(plan, obstacle);
  build();
}

void ObstacleTriangles::add(const RoutePlan& plan, int obstacle) {
  const Surface& surface = plan.obstacles[static_cast<std::size_t>(obstacle)].surface;
  for (const Triangle& t : triangulate(surface).triangles) {
    std::array<Vec3, 3>& corners = corners_.emplace_back();
    for (int k = 0; k < 3; ++k) corners[k] = Eigen::Map<const Vec3>(surface.positions.data() + 3 * t[k]);
    obstacle_.push_back(obstacle);
  }
}

void ObstacleTriangles::build() {
  std::vector<Box> boxes;
  for (const std::array<Vec3, 3>& corners : corners_) {
    Box& box = boxes.emplace_back();
    for (const Vec3& corner : corners) box.extend(corner);
    bounds_.extend(box);
  }
  bvh_.build(boxes);
}

bool ObstacleTriangles::is_clear(const Vec3& p, const Vec3& q, double distance) const {
  Box box;
  box.extend(p);
  box.extend(q);
  return !bvh_.find(box.inflated(distance),
                    [&](Index t) { return closest_segment_triangle(p, q, corners_[t]).distance < distance; });
}

double ObstacleTriangles::distance(const Vec3& p, double most) const {
  Box box;
  box.extend(p);
  double least = most;
  bvh_.query(box.inflated(most), [&](Index t) {
    least = std::min(least, closest_vertex_face(p, corners_[t][0], corners_[t][1], corners_[t][2]).distance);
  });
  return least;
}

}  // namespace unsnarl
