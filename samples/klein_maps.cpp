#include "samples/klein_maps.h"

#include <cmath>
#include <numbers>

namespace unsnarl {

using std::numbers::pi;

Vec3 klein_bottle_map(double t, double v) {
  constexpr double a = 0.75, b = 2.0;  // half the width and height of the drop
  const double u = t - pi / 2;
  const Vec3 centre(a * std::cos(u) * (1 + std::sin(u)), b * std::sin(u), 0);
  // The curve's derivative over 2 sin(t / 2): it does not vanish at the cusp (t = 0) and changes sign from one end of
  // the period to the other, which is what makes the tube close up mirrored.
  const Vec3 along(a * std::sin(t / 2) * (1 - 2 * std::sin(u)), b * std::cos(t / 2), 0);
  const Vec3 normal = Vec3(along[1], -along[0], 0).normalized();
  const double radius = 0.52 - 0.3 * std::sin(t);
  return centre + radius * (std::cos(v) * normal + std::sin(v) * Vec3::UnitZ());
}

ParameterGrid klein_bottle_grid(int resolution, FaceKind faces) {
  // The mirror image of v is pi - v.
  return {{0, 2 * pi, resolution, Seam::mirrored},
          {-pi / 2, 3 * pi / 2, steps_for(2 * pi * 0.6, resolution, 9, 8), Seam::closed},
          faces};
}

Vec3 klein_figure8_map(double u, double v, double ring) {
  const double c = std::cos(u / 2), s = std::sin(u / 2);
  const double r = ring + c * std::sin(v) - s * std::sin(2 * v);
  return {r * std::cos(u), s * std::sin(v) + c * std::sin(2 * v), r * std::sin(u)};
}

ParameterGrid klein_figure8_grid(int resolution, FaceKind faces) {
  return {{0, 2 * pi, resolution, Seam::mirrored}, {0, 2 * pi, steps_for(6, resolution, 12, 8), Seam::closed}, faces};
}

}  // namespace unsnarl
