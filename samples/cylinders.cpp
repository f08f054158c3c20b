#include <cmath>
#include <numbers>

#include "geometry/portable_math.h"
#include "samples/parameter_grid.h"
#include "samples/sample_maker.h"

namespace unsnarl {
namespace {

using std::numbers::pi;

/// Paper fig. 21, left. The radius swells once on the way, so that the windings cross instead of coinciding.
Surface cylinder_wrapped(int resolution, const SampleValues& values) {
  const int turns = values.whole("turns");
  const double swell = values["swell"], height = values["height"];
  return sample_grid({{0, 2 * pi, resolution, Seam::closed},
                      {0, height, steps_for(height, resolution, 2 * pi * turns, 6)},
                      FaceKind::quads},
                     [&](double t, double y) {
                       const double r = 1 + swell * portable::cos(t);
                       return Vec3(r * portable::cos(turns * t), y + 0.03 * portable::sin(2 * t + 0.4),
                                   r * portable::sin(turns * t));
                     });
}

/// Paper fig. 21, right. The radius runs smoothly from 1 through 0 to -1: one whole ring of vertices is one point.
Surface cylinder_inverted(int resolution, const SampleValues& values) {
  const double height = values["height"];
  const int half = steps_for(height / 2, resolution, 2 * pi, 3);
  return sample_grid({{0, 2 * pi, resolution, Seam::closed}, {-1, 1, 2 * half}}, [&](double t, double s) {
    const double r = portable::sin(pi / 2 * s);
    return Vec3(r * portable::cos(t), height / 2 * s, r * portable::sin(t));
  });
}

/// The side walls of a star polygon {corners / step}.
Surface star_prism(int resolution, const SampleValues& values) {
  const int corners = values.whole("corners"), step = values.whole("step");
  const double height = values["height"];
  const int per_side = std::max(2, resolution / corners);
  const double perimeter = corners * 2 * portable::sin(pi * step / corners);
  const auto corner = [&](int k) {
    const double angle = 2 * pi * step * k / corners;
    return Vec3(portable::cos(angle), 0, portable::sin(angle));
  };
  return sample_grid({{0, static_cast<double>(corners), corners * per_side, Seam::closed, 0.0},
                      {0, height, steps_for(height, corners * per_side, perimeter, 4)},
                      FaceKind::quads},
                     [&](double u, double y) {
                       // The small offset keeps rounding from putting a corner on the side before its own.
                       const int k = static_cast<int>(std::floor(u + 1e-9));
                       const double s = u - k;
                       const Vec3 p = (1 - s) * corner(k) + s * corner(k + 1);
                       return Vec3(p + Vec3(0, y + 0.02 * portable::sin(4 * pi * u / corners + 0.3), 0));
                     });
}

}  // namespace

std::vector<SampleMaker> cylinder_samples() {
  return {
      {{"cylinder_wrapped",
        "closed cylinder wound several times around its axis: orientable, two boundaries, many double curves",
        {{"turns", 4, 2, 12, "number of windings", true},
         {"swell", 0.25, 0.02, 0.8, "how far the radius swings, mean radius 1"},
         {"height", 1.2, 0.1, 10, "height, mean radius 1"}}},
       260,
       cylinder_wrapped},
      {{"cylinder_inverted",
        "cylinder whose radius runs smoothly through zero: a whole ring of vertices is one point",
        {{"height", 2.5, 0.5, 10, "height, radius 1 at the ends"}}},
       48,
       cylinder_inverted},
      {{"star_prism",
        "side walls of a star polygon: creased, orientable, two boundaries, isolated double lines",
        {{"corners", 7, 5, 31, "corners of the star", true},
         {"step", 3, 2, 15, "corners from one end of a side to the other", true},
         {"height", 1.0, 0.1, 10, "height, outer radius 1"}}},
       168,
       star_prism},
  };
}

}  // namespace unsnarl
