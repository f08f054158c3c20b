#include "samples/medusa.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "samples/lattice_noise.h"
#include "samples/sphere_grid.h"
#include "samples/tube.h"

namespace unsnarl {
namespace {

constexpr double pi = std::numbers::pi;

double hill(double x, double y, double width, double height) {
  return std::exp(-(x * x / (width * width) + y * y / (height * height)));
}

/// Distance of the bust's surface from the middle of its head, in a direction; y is up, the face looks along z.
double bust(const Vec3& d) {
  double r = 1 / std::sqrt(d[0] * d[0] / 0.60 + d[1] * d[1] / 1.0 + d[2] * d[2] / 0.80);
  if (d[2] > 0) {
    r += d[2] * (0.20 * hill(d[0], d[1] + 0.10, 0.10, 0.17)  // nose
                 - 0.07 * (hill(d[0] - 0.32, d[1] - 0.10, 0.15, 0.09) + hill(d[0] + 0.32, d[1] - 0.10, 0.15, 0.09)) +
                 0.05 * hill(d[0], d[1] - 0.28, 0.45, 0.08)      // brow
                 + 0.06 * hill(d[0], d[1] + 0.42, 0.16, 0.05)    // lips
                 + 0.08 * hill(d[0], d[1] + 0.64, 0.18, 0.12));  // chin
  }
  const double down = std::max(0.0, (-d[1] - 0.72) / 0.28);  // neck and shoulders
  return r + 0.9 * down * down * (3 - 2 * down);
}

/// Directions spread evenly over the scalp: a cap around its crown, which leaves the face free.
Vec3 root_of(int snake, int count) {
  const double golden = pi * (3 - std::sqrt(5.0));
  const double height = 1 - (1 - std::cos(100 * pi / 180)) * (snake + 0.5) / count;
  const double around = golden * snake, width = std::sqrt(1 - height * height);
  const Vec3 on_cap(width * std::cos(around), height, width * std::sin(around));
  return Eigen::AngleAxisd(-0.72, Vec3::UnitX()) * on_cap;  // the crown lies behind the top
}

}  // namespace

Surface medusa(int resolution, const SampleValues& values) {
  const int count = values.whole("snakes");
  const double thick = 0.058 * values["thickness"], push = values["push"];
  MeshBuilder builder;
  builder.append(
      sample_sphere(std::max(2, resolution / 4), FaceKind::triangles, [](const Vec3& d) { return Vec3(bust(d) * d); }));
  for (int k = 0; k < count; ++k) {
    const auto random = [k](std::uint32_t what) { return hashed_unit(40 + what, static_cast<std::uint32_t>(k)); };
    const Vec3 root = root_of(k, count);
    const Vec3 side = root.unitOrthogonal();
    const Vec3 sweep = Eigen::AngleAxisd(2 * pi * random(0), root) * side, across = root.cross(sweep);
    const double reach = 0.35 + 0.45 * random(1), wave = 0.10 + 0.10 * random(2), turns = 1.5 + 1.5 * random(3);
    const double phase = 2 * pi * random(4), rise = 0.35 + 0.5 * random(5);
    // A direction that sweeps over the scalp in waves, and a height above the bust that rises: never inside it.
    const auto spine = [=](double t) {
      const Vec3 direction =
          (root + std::tan(reach * t) * sweep + wave * t * std::sin(2 * pi * turns * t + phase) * across).normalized();
      const double height = 0.09 + rise * t * (1 + 0.25 * std::sin(2 * pi * turns * t + phase + 1.3));
      return Vec3((bust(direction) + height - push * (1 - t) * (1 - t)) * direction);
    };
    const auto radius = [=](double t) {
      const double body = 1 - 0.6 * t + 0.45 * std::exp(-std::pow((t - 0.93) / 0.05, 2));  // a head near the end
      return thick * body * std::sqrt(std::min(1.0, std::min(t + 0.01, 1.01 - t) / 0.06));
    };
    builder.append(sample_tube({spine, 0, 1, false, radius, std::max(8, resolution / 2), std::max(5, resolution / 8),
                                FaceKind::triangles, true}));
  }
  return builder.take();
}

}  // namespace unsnarl
