#include <complex>
#include <numbers>

#include "geometry/portable_math.h"
#include "geometry/rotation.h"
#include "samples/parameter_grid.h"
#include "samples/projective_maps.h"
#include "samples/sample_maker.h"

namespace unsnarl {
namespace {

using std::numbers::pi;

/// The projective plane without a disc is a Moebius band: half the equator around, latitude across, the two poles'
/// surroundings being the (one) disc that is left out.
Surface punctured(const DirectionMap& f, int resolution, double hole_degrees) {
  const double latitude = pi / 2 - hole_degrees * pi / 180;
  // A generic turn: neither hole nor samples on the lines of symmetry of the map.
  const Eigen::Matrix3d turn = rotation_about(Vec3::UnitX(), 0.93) * rotation_about(Vec3::UnitZ(), 0.51);
  return sample_grid(
      {{0, pi, resolution, Seam::mirrored}, {-latitude, latitude, steps_for(2 * latitude, resolution, pi, 8)}},
      [&](double u, double v) {
        const Vec3 direction(portable::cos(v) * portable::cos(u), portable::cos(v) * portable::sin(u),
                             portable::sin(v));
        return f(turn * direction);
      });
}

SampleMaker punctured_sample(const char* name, const char* description, const DirectionMap& f) {
  return {{name, description, {{"hole", 20, 3, 60, "radius of the hole, in degrees of the sphere"}}},
          48,
          [f](int resolution, const SampleValues& values) { return punctured(f, resolution, values["hole"]); }};
}

}  // namespace

std::vector<SampleMaker> projective_plane_samples() {
  return {
      punctured_sample("boy_punctured",
                       "Boy's surface without a disc: non-orientable, a double curve with a triple point", boy_map),
      punctured_sample("cross_cap_punctured",
                       "cross-cap without a disc: non-orientable, a double line between two pinch points",
                       cross_cap_map),
      punctured_sample("roman_punctured",
                       "Steiner's Roman surface without a disc: three double lines, a triple point, six pinch points",
                       roman_map),
  };
}

}  // namespace unsnarl
