#include "samples/tube.h"

#include <numbers>
#include <vector>

#include "geometry/portable_math.h"
#include "geometry/rotation.h"

namespace unsnarl {

Surface sample_tube(const Tube& tube) {
  const int rings = tube.closed ? tube.steps : tube.steps + 1;
  const double dt = (tube.t_max - tube.t_min) / tube.steps;
  const auto parameter = [&](int i) { return tube.t_min + (i + (tube.closed ? 0.37 : 0.0)) * dt; };
  const auto tangent = [&](double t) {
    // Central difference: a curve as a plain function has no derivative, and frames need no more than three digits.
    const double h = 1e-4 * (tube.t_max - tube.t_min);
    return Vec3((tube.centre(t + h) - tube.centre(t - h)).normalized());
  };

  std::vector<Vec3> normals(static_cast<std::size_t>(rings) + 1);
  Vec3 before = tangent(parameter(0));
  normals[0] = before.unitOrthogonal();
  for (int i = 1; i <= rings; ++i) {
    const Vec3 now = tangent(parameter(i));
    Vec3 carried = Eigen::Quaterniond::FromTwoVectors(before, now) * normals[i - 1];
    normals[i] = (carried - carried.dot(now) * now).normalized();
    before = now;
  }
  double twist = 0;
  if (tube.closed) {
    const Vec3 axis = tangent(parameter(0));
    twist = portable::atan2(axis.dot(normals[rings].cross(normals[0])), normals[rings].dot(normals[0]));
  }

  MeshBuilder builder;
  for (int i = 0; i < rings; ++i) {
    const double t = parameter(i);
    const Vec3 axis = tangent(t), normal = rotation_about(axis, twist * i / rings) * normals[i];
    const Vec3 binormal = axis.cross(normal);
    for (int j = 0; j < tube.sides; ++j) {
      const double angle = 2 * std::numbers::pi * (j + 0.13) / tube.sides;
      builder.add_vertex(tube.centre(t) +
                         tube.radius(t) * (portable::cos(angle) * normal + portable::sin(angle) * binormal));
    }
  }
  const auto vertex = [&](int i, int j) { return static_cast<Index>((i % rings) * tube.sides + j % tube.sides); };
  for (int i = 0; i < tube.steps; ++i)
    for (int j = 0; j < tube.sides; ++j)
      builder.add_cell(vertex(i, j), vertex(i, j + 1), vertex(i + 1, j + 1), vertex(i + 1, j), tube.faces,
                       (i + j) % 2 != 0);
  if (tube.capped && !tube.closed)
    for (const int ring : {0, rings - 1}) {
      const double t = parameter(ring);
      const double out = (ring == 0 ? -0.5 : 0.5) * tube.radius(t);
      const Index tip = builder.add_vertex(tube.centre(t) + out * tangent(t));
      for (int j = 0; j < tube.sides; ++j) {
        const Index a = vertex(ring, j), b = vertex(ring, j + 1);
        if (ring == 0)
          builder.add_face({tip, b, a});
        else
          builder.add_face({tip, a, b});
      }
    }
  return builder.take();
}

}  // namespace unsnarl
