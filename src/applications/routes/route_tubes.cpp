#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "applications/routes/segments.h"
#include "geometry/portable_math.h"

namespace unsnarl {
namespace {

/// Vertices lie within the tubes by this, so that rounding them does not take them out (unit: radius)
constexpr double inside_of_radius = 1e-9;
/// Vertices lie within the tubes by this at least, so that rounding them does not take them out (unit: largest
/// coordinate)
constexpr double inside_of_coordinate = 1e-15;
/// Where the sum of two unit directions is shorter, the route turns back on the spot (no unit)
constexpr double turned_back = 1e-3;

/// One tube: rings of points around centres, closed by a point at each end.
class Tube {
 public:
  Tube(Surface& surface, int sides) : surface_(surface), sides_(sides) {}

  void add_tip(const Vec3& p) {
    const std::int32_t tip = add(p);
    if (ring_ < 0) {
      tip_ = tip;
      return;
    }
    for (int k = 0; k < sides_; ++k) face(tip, at(ring_, k), at(ring_, k + 1));
  }
  /// e, f: unit, across the route; a ring runs from e to f.
  void add_ring(const Vec3& centre, double radius, const Vec3& e, const Vec3& f) {
    const auto first = static_cast<std::int32_t>(surface_.positions.size() / 3);
    for (int k = 0; k < sides_; ++k) {
      const double angle = 2 * std::numbers::pi * k / sides_;
      add(centre + radius * (portable::cos(angle) * e + portable::sin(angle) * f));
    }
    for (int k = 0; k < sides_; ++k) {
      if (ring_ < 0) {
        face(tip_, at(first, k + 1), at(first, k));
      } else {
        face(at(ring_, k), at(ring_, k + 1), at(first, k + 1));
        face(at(ring_, k), at(first, k + 1), at(first, k));
      }
    }
    ring_ = first;
  }

 private:
  std::int32_t add(const Vec3& p) {
    surface_.positions.insert(surface_.positions.end(), {p[0], p[1], p[2]});
    return static_cast<std::int32_t>(surface_.positions.size() / 3) - 1;
  }
  std::int32_t at(std::int32_t ring, int k) const { return ring + k % sides_; }
  void face(std::int32_t a, std::int32_t b, std::int32_t c) {
    surface_.corners.insert(surface_.corners.end(), {a, b, c});
  }

  Surface& surface_;
  int sides_;
  std::int32_t tip_ = -1, ring_ = -1;
};

void add_tube(const Route& route, double radius, int sides, Surface& surface) {
  std::vector<Vec3> p;
  double largest = 0;
  for (const RoutePoint& point : route.points) {
    if (!p.empty() && p.back() == vec(point)) continue;  // the agent stands there
    p.push_back(vec(point));
    largest = std::max(largest, p.back().cwiseAbs().maxCoeff());
  }
  const std::size_t n = p.size();
  const double r = std::min(radius * (1 - inside_of_radius), radius - inside_of_coordinate * largest);
  const int cap_rings = std::max(1, sides / 4 - 1);
  Tube tube(surface, sides);
  Vec3 e = Vec3::Zero();
  for (std::size_t k = 0; k < n; ++k) {
    const Vec3 before = k > 0 ? (p[k] - p[k - 1]).normalized() : (p[1] - p[0]).normalized();
    const Vec3 after = k + 1 < n ? (p[k + 1] - p[k]).normalized() : before;
    // The plane that halves the angle, so that the rings of two edges fit; frames turn as little as they can.
    const Vec3 middle = before + after;
    const Vec3 along = middle.norm() > turned_back ? Vec3(middle.normalized()) : before;
    const Vec3 across = e - along.dot(e) * along;
    e = across.norm() > turned_back ? Vec3(across.normalized()) : along.unitOrthogonal();
    const Vec3 f = along.cross(e);
    if (k == 0) {
      tube.add_tip(p[0] - r * along);
      for (int c = cap_rings; c > 0; --c) {
        const double angle = 0.5 * std::numbers::pi * c / (cap_rings + 1);
        tube.add_ring(p[0] - r * portable::sin(angle) * along, r * portable::cos(angle), e, f);
      }
    }
    tube.add_ring(p[k], r, e, f);
    if (k + 1 == n) {
      for (int c = 1; c <= cap_rings; ++c) {
        const double angle = 0.5 * std::numbers::pi * c / (cap_rings + 1);
        tube.add_ring(p[k] + r * portable::sin(angle) * along, r * portable::cos(angle), e, f);
      }
      tube.add_tip(p[k] + r * along);
    }
  }
}

}  // namespace

Surface route_tubes(const RoutePlan& plan, std::span<const Route> routes, int sides, std::vector<SceneFile>* parts) {
  if (sides < 3 || sides > 256) throw std::invalid_argument(fmt::format("sides is {}; give 3 to 256", sides));
  if (routes.size() != plan.agents.size())
    throw std::invalid_argument(fmt::format("there are {} routes, but {} agents", routes.size(), plan.agents.size()));
  Surface surface;
  for (std::size_t i = 0; i < routes.size(); ++i) {
    if (routes[i].points.size() < 2)
      throw std::invalid_argument(fmt::format("the route of '{}' has fewer than two points", plan.agents[i].name));
    const std::size_t vertex = surface.positions.size() / 3, face = surface.corners.size() / 3;
    add_tube(routes[i], plan.agents[i].radius, sides, surface);
    if (parts != nullptr)
      parts->push_back({plan.agents[i].name, vertex, surface.positions.size() / 3 - vertex, face,
                        surface.corners.size() / 3 - face});
  }
  return surface;
}

Surface with_obstacles(const RoutePlan& plan, Surface surface, std::vector<SceneFile>* parts) {
  if (surface.offsets.empty())
    for (std::size_t k = 0; k <= surface.corners.size(); k += 3)
      surface.offsets.push_back(static_cast<std::int32_t>(k));
  for (const RouteObstacle& obstacle : plan.obstacles) {
    const SurfaceView own = obstacle.surface;
    const std::size_t vertex = surface.positions.size() / 3, face = surface.offsets.size() - 1;
    surface.positions.insert(surface.positions.end(), own.positions.begin(), own.positions.end());
    for (std::size_t f = 0; f < own.face_count(); ++f) {
      for (const std::int32_t v : own.face(f)) surface.corners.push_back(v + static_cast<std::int32_t>(vertex));
      surface.offsets.push_back(static_cast<std::int32_t>(surface.corners.size()));
    }
    if (parts != nullptr) parts->push_back({obstacle.name, vertex, own.vertex_count(), face, own.face_count()});
  }
  return surface;
}

}  // namespace unsnarl
