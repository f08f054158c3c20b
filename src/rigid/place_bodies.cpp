#include "rigid/place_bodies.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <vector>

#include "geometry/portable_math.h"
#include "geometry/rotation.h"
#include "mesh/areas.h"
#include "rigid/free_place.h"

namespace unsnarl {
namespace {

/// Clearance: a body goes beyond the first free place by this share of its motion (no unit)
constexpr double margin = 0.01;
/// Chord of the largest rotation, a right angle (fixed by geometry, in radii)
constexpr double largest_chord = 1.4142135623730951;

/// A family of motions; the parameter is the root mean square displacement of the vertices, a length.
struct BodyMotion {
  Vec3 direction = Vec3::Zero();  // of a translation, or:
  Vec3 axis = Vec3::Zero();       // of a rotation about the centre,
  double radius = 0;              // root mean square distance of the vertices from the axis

  double longest(double diagonal) const { return radius > 0 ? std::min(diagonal, largest_chord * radius) : diagonal; }
  void apply(Body& body, double distance) const {
    body.rotation = Eigen::Matrix3d::Identity();
    body.centre = body.rest_centre;
    if (radius > 0)
      body.rotation = rotation_by(2 * portable::asin(0.5 * distance / radius) * axis);
    else
      body.centre += distance * direction;
  }
};

std::vector<BodyMotion> motions_of(const Bodies& bodies, const Body& body, std::span<const IntersectingPair> contacts) {
  std::vector<BodyMotion> motions;
  const auto translate = [&](const Vec3& d) {
    if (const double length = d.norm(); length > 0)
      for (const double sign : {1.0, -1.0}) motions.push_back({.direction = sign / length * d});
  };
  const double moment = body.moments.trace(), count = static_cast<double>(body.vertices.size());
  const auto rotate = [&](const Vec3& w) {
    const double length = w.norm();
    if (!(length > 0)) return;
    const Vec3 axis = w / length;
    const double radius = std::sqrt(std::max(0.0, moment - axis.dot(body.moments * axis)) / count);
    if (radius > 0)
      for (const double sign : {1.0, -1.0}) motions.push_back({.axis = sign * axis, .radius = radius});
  };
  for (const Vec3& direction : lattice_directions()) translate(direction);
  for (int k = 0; k < 3; ++k) rotate(Vec3::Unit(k));
  for (const IntersectingPair& pair : some_contacts(contacts))
    for (Index t : {pair.a, pair.b}) {
      const Triangle& corners = bodies.triangles()[t];
      const Vec3 normal = area_vector(bodies.x(), corners);
      const Vec3 middle = (bodies.x().col(corners[0]) + bodies.x().col(corners[1]) + bodies.x().col(corners[2])) / 3;
      translate(normal);
      rotate((middle - body.rest_centre).cross(normal));
    }
  return motions;
}

class BodyPlacement {
 public:
  BodyPlacement(Bodies& bodies, const PlaceBodiesOptions& options) : bodies_(bodies), options_(options) {}

  bool run() {
    const std::span<Body> list = bodies_.list();
    std::vector<Index> order(list.size());
    std::iota(order.begin(), order.end(), Index{0});
    std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return list[a].area > list[b].area; });
    const auto in_conflict =
        std::stable_partition(order.begin(), order.end(), [&](Index b) { return bodies_.is_free(list[b]); });
    std::for_each(in_conflict, order.end(), [&](Index b) { bodies_.set_present(b, false); });
    for (auto b = in_conflict; b != order.end(); ++b) {
      list[*b].is_placed = place(list[*b]);
      // A body that still intersects something is no obstacle: nothing could be clear of both.
      if (list[*b].is_placed) bodies_.set_present(*b, true);
    }
    return is_too_far_;
  }

 private:
  /// A free place that is too far is none.
  bool is_free_at(Body& body, const BodyMotion& motion, double distance) {
    motion.apply(body, distance);
    bodies_.move(body);
    if (!bodies_.is_free(body)) return false;
    const bool is_near = bodies_.largest_displacement(body) <= options_.most_motion;
    is_too_far_ |= !is_near;
    return is_near;
  }

  bool place(Body& body) {
    const std::vector<IntersectingPair> contacts = bodies_.contacts_of(body);
    if (contacts.empty()) return true;
    const std::vector<BodyMotion> motions = motions_of(bodies_, body, contacts);
    std::vector<MotionFamily> families;
    for (const BodyMotion& motion : motions) families.push_back({body.diagonal, motion.longest(body.diagonal)});
    const auto is_free = [&](std::size_t k, double distance) { return is_free_at(body, motions[k], distance); };
    const std::optional<FreePlace> found = nearest_free_place(families, is_free, {margin, true, options_.stop});
    motions[found ? found->family : 0].apply(body, found ? found->parameter : 0);
    bodies_.move(body);
    bodies_.settle(body);
    return found.has_value();
  }

  Bodies& bodies_;
  const PlaceBodiesOptions& options_;
  bool is_too_far_ = false;
};

}  // namespace

bool place_bodies(Bodies& bodies, const PlaceBodiesOptions& options) {
  return BodyPlacement(bodies, options).run();
}

}  // namespace unsnarl
