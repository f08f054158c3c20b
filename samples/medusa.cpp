#include "samples/medusa.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <tuple>
#include <utility>
#include <vector>

#include "geometry/box.h"
#include "geometry/portable_math.h"
#include "geometry/rotation.h"
#include "samples/lattice_noise.h"
#include "samples/sphere_grid.h"
#include "samples/tube.h"

namespace unsnarl {
namespace {

using std::numbers::pi;

double hill(double x, double y, double width, double height) {
  return portable::exp(-(x * x / (width * width) + y * y / (height * height)));
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
  const double height = 1 - (1 - portable::cos(100 * pi / 180)) * (snake + 0.5) / count;
  const double around = golden * snake, width = std::sqrt(1 - height * height);
  const Vec3 on_cap(width * portable::cos(around), height, width * portable::sin(around));
  return rotation_about(Vec3::UnitX(), -0.72) * on_cap;  // the crown lies behind the top
}

/// The middle of a snake, t in [0, 1].
using Spine = std::function<Vec3(double)>;

/// Grows from `root` in a way of its own for each seed: a direction that sweeps over the scalp in waves, and a height
/// above the bust that rises. Never inside the bust.
Spine spine_from(const Vec3& root, std::uint32_t seed, double push) {
  const auto random = [seed](std::uint32_t what) { return hashed_unit(40 + what, seed); };
  const Vec3 sweep = rotation_about(root, 2 * pi * random(0)) * root.unitOrthogonal(), across = root.cross(sweep);
  const double reach = 0.35 + 0.45 * random(1), wave = 0.10 + 0.10 * random(2), turns = 1.5 + 1.5 * random(3);
  const double phase = 2 * pi * random(4), rise = 0.35 + 0.5 * random(5);
  return [=](double t) {
    const double swing = 2 * pi * turns * t + phase;
    const Vec3 direction =
        (root + portable::tan(reach * t) * sweep + wave * t * portable::sin(swing) * across).normalized();
    const double height = 0.09 + rise * t * (1 + 0.25 * portable::sin(swing + 1.3));
    return Vec3((bust(direction) + height - push * (1 - t) * (1 - t)) * direction);
  };
}

/// Places along spines; near what it holds, a snake would have to be thinner than asked for.
class Spines {
 public:
  /// The least distance of the spine from those added, and from itself beyond its next neighbourhood; 0 where that is
  /// no more than `least`.
  double clearance_above(double least, const Spine& spine) const {
    const std::vector<Vec3> own = places(spine);
    double squared = 1;
    for (std::size_t i = 0; i < own.size() && squared > least * least; ++i) {
      for (const Added& other : added_)
        if (other.box.overlaps(Box{own[i], own[i]}.inflated(std::sqrt(squared))))
          for (const Vec3& place : other.places) squared = std::min(squared, (own[i] - place).squaredNorm());
      for (std::size_t j = i + 10; j < own.size(); ++j) squared = std::min(squared, (own[i] - own[j]).squaredNorm());
    }
    return squared > least * least ? std::sqrt(squared) : 0;
  }
  void add(const Spine& spine) {
    Added added = {places(spine), {}};
    for (const Vec3& place : added.places) added.box.extend(place);
    added_.push_back(std::move(added));
  }

 private:
  static std::vector<Vec3> places(const Spine& spine) {
    std::vector<Vec3> all;
    for (int i = 0; i <= 64; ++i) all.push_back(spine(i / 64.0));
    return all;
  }
  struct Added {
    std::vector<Vec3> places;
    Box box;
  };
  std::vector<Added> added_;
};

}  // namespace

Surface medusa(int resolution, const SampleValues& values) {
  const int count = values.whole("snakes");
  const double thick = 0.058 * values["thickness"], push = values["push"];
  MeshBuilder builder;
  builder.append(
      sample_sphere(std::max(2, resolution / 4), FaceKind::triangles, [](const Vec3& d) { return Vec3(bust(d) * d); }));
  Spines spines;
  for (int k = 0; k < count; ++k) {
    // The first of many ways to grow that keeps apart from all spines before it, or the one that comes closest to that.
    const Vec3 root = root_of(k, count);
    std::uint32_t best = 64 * static_cast<std::uint32_t>(k);
    double widest = 0;
    for (std::uint32_t way = 0; way < 64 && widest < 0.06; ++way) {
      const std::uint32_t seed = 64 * static_cast<std::uint32_t>(k) + way;
      const double clearance = spines.clearance_above(widest, spine_from(root, seed, 0));
      if (clearance > widest) std::tie(widest, best) = std::pair(clearance, seed);
    }
    spines.add(spine_from(root, best, 0));
    const Spine spine = spine_from(root, best, push);
    const auto radius = [=](double t) {
      const double body =
          1 - 0.6 * t + 0.45 * portable::exp(-portable::pow((t - 0.93) / 0.05, 2));  // a head near the end
      return thick * body * std::sqrt(std::min(1.0, std::min(t + 0.01, 1.01 - t) / 0.06));
    };
    builder.append(sample_tube({spine, 0, 1, false, radius, std::max(8, resolution / 2), std::max(5, resolution / 8),
                                FaceKind::triangles, true}));
  }
  return builder.take();
}

}  // namespace unsnarl
