#include "energy/intersection_length.h"

#include <algorithm>

namespace unsnarl {
namespace {

/// The point where edge (u, v) runs through a face.
struct Piercing {
  Index u, v;
  const Triangle* face;
  double along;                   // the point is (1 - along) u + along v
  std::array<double, 3> weights;  // ... and the sum of weights * corners of the face
  Vec3 direction, normal;         // of the edge, of the face; any length
  Vec3 point;
};

bool pierces(const Positions& x, Index u, Index v, const Triangle& face, Piercing& found) {
  const Vec3 p = x.col(u), q = x.col(v), a = x.col(face[0]);
  const Vec3 e1 = x.col(face[1]) - a, e2 = x.col(face[2]) - a;
  const Vec3 normal = e1.cross(e2);
  const double height_p = normal.dot(p - a), height_q = normal.dot(q - a);
  if (height_p * height_q >= 0) return false;
  const double along = height_p / (height_p - height_q);
  const Vec3 point = p + along * (q - p);
  const double squared = normal.squaredNorm();
  const double w1 = (point - a).cross(e2).dot(normal) / squared, w2 = e1.cross(point - a).dot(normal) / squared;
  if (w1 < 0 || w2 < 0 || w1 + w2 > 1) return false;
  found = {u, v, &face, along, {1 - w1 - w2, w1, w2}, q - p, normal, point};
  return true;
}

/// Adds to the gradient what a force on the point means for edge and face. The point goes with the edge and slides
/// along it as far as the plane of the face moves: dp = dedge + d n.(dface - dedge) / n.d.
void add_force(const Piercing& piercing, const Vec3& force, Positions& gradient) {
  const Vec3 slide = piercing.normal * (force.dot(piercing.direction) / piercing.normal.dot(piercing.direction));
  gradient.col(piercing.u) += (1 - piercing.along) * (force - slide);
  gradient.col(piercing.v) += piercing.along * (force - slide);
  for (int k = 0; k < 3; ++k) gradient.col((*piercing.face)[k]) += piercing.weights[k] * slide;
}

}  // namespace

double intersection_length(const Positions& x, std::span<const Triangle> triangles,
                           std::span<const std::array<Index, 2>> pairs, Positions& gradient, double weight) {
  double sum = 0;
  for (const auto& [a, b] : pairs) {
    const Triangle &s = triangles[a], &t = triangles[b];
    if (std::any_of(s.begin(), s.end(), [&](Index v) { return std::find(t.begin(), t.end(), v) != t.end(); })) continue;
    std::array<Piercing, 2> ends;
    std::size_t count = 0;
    for (int k = 0; k < 3 && count < 2; ++k) {
      if (pierces(x, s[k], s[(k + 1) % 3], t, ends[count])) ++count;
      if (count < 2 && pierces(x, t[k], t[(k + 1) % 3], s, ends[count])) ++count;
    }
    const Vec3 segment = count == 2 ? Vec3(ends[1].point - ends[0].point) : Vec3::Zero();
    const double length = segment.norm();
    if (length == 0) continue;
    sum += length;
    add_force(ends[0], -weight / length * segment, gradient);
    add_force(ends[1], weight / length * segment, gradient);
  }
  return weight * sum;
}

}  // namespace unsnarl
