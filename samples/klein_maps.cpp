#include "samples/klein_maps.h"

#include <numbers>

#include "geometry/portable_math.h"

namespace unsnarl {

using std::numbers::pi;

Vec3 klein_bottle_map(double t, double v) {
  constexpr double a = 0.75, b = 2.0;  // half the width and height of the drop
  const double u = t - pi / 2;
  const Vec3 centre(a * portable::cos(u) * (1 + portable::sin(u)), b * portable::sin(u), 0);
  // The curve's derivative over 2 sin(t / 2): it does not vanish at the cusp (t = 0) and changes sign from one end of
  // the period to the other, which is what makes the tube close up mirrored.
  const Vec3 along(a * portable::sin(t / 2) * (1 - 2 * portable::sin(u)), b * portable::cos(t / 2), 0);
  const Vec3 normal = Vec3(along[1], -along[0], 0).normalized();
  const double radius = 0.52 - 0.3 * portable::sin(t);
  return centre + radius * (portable::cos(v) * normal + portable::sin(v) * Vec3::UnitZ());
}

ParameterGrid klein_bottle_grid(int resolution, FaceKind faces) {
  // The mirror image of v is pi - v.
  return {{0, 2 * pi, resolution, Seam::mirrored},
          {-pi / 2, 3 * pi / 2, steps_for(2 * pi * 0.6, resolution, 9, 8), Seam::closed},
          faces};
}

Vec3 klein_figure8_map(double u, double v, double ring) {
  const double c = portable::cos(u / 2), s = portable::sin(u / 2);
  const double r = ring + c * portable::sin(v) - s * portable::sin(2 * v);
  return {r * portable::cos(u), s * portable::sin(v) + c * portable::sin(2 * v), r * portable::sin(u)};
}

ParameterGrid klein_figure8_grid(int resolution, FaceKind faces) {
  return {{0, 2 * pi, resolution, Seam::mirrored}, {0, 2 * pi, steps_for(6, resolution, 12, 8), Seam::closed}, faces};
}

}  // namespace unsnarl
