#include <numbers>

#include "geometry/portable_math.h"
#include "samples/parameter_grid.h"
#include "samples/sample_maker.h"

namespace unsnarl {
namespace {

using std::numbers::pi;

/// Paper fig. 20. A band wider than its ring meets its own other side: at half width 2 it reaches the opposite core.
Surface mobius_extended(int resolution, const SampleValues& values) {
  const double half_width = values["half_width"];
  return sample_grid({{0, 2 * pi, resolution, Seam::mirrored},
                      {-half_width, half_width, steps_for(2 * half_width, resolution, 2 * pi, 8)}},
                     [](double u, double v) {
                       const double r = 1 + v * portable::cos(u / 2);
                       return Vec3(r * portable::cos(u), v * portable::sin(u / 2), r * portable::sin(u));
                     });
}

/// A ribbon around a lemniscate, which crosses itself at right angles in the middle.
Surface lemniscate_band(int resolution, const SampleValues& values) {
  const double half_width = values["half_width"];
  const int half_twists = values.whole("half_twists");
  const auto centre = [](double t) {
    const double s = 1 / (1 + portable::sin(t) * portable::sin(t));
    return Vec3(2 * portable::cos(t) * s, 0, 2 * portable::sin(t) * portable::cos(t) * s);
  };
  return sample_grid(
      {{0, 2 * pi, resolution, half_twists % 2 != 0 ? Seam::mirrored : Seam::closed},
       {-half_width, half_width, steps_for(2 * half_width, resolution, 10, 4)},
       FaceKind::quads},
      [&](double t, double v) {
        const Vec3 along = (centre(t + 1e-4) - centre(t - 1e-4)).normalized();
        const Vec3 side = along.cross(Vec3::UnitY());
        // 0.3: the quarter of a step that keeps the rows of the two branches at different heights.
        const double angle = half_twists * (t - 0.9) / 2;
        return Vec3(centre(t) + (v + 0.1 * half_width * portable::sin(t)) *
                                    (portable::cos(angle) * Vec3::UnitY() + portable::sin(angle) * side));
      });
}

/// An annulus with full twists so wide that it reaches across its axis.
Surface twisted_annulus(int resolution, const SampleValues& values) {
  const double half_width = values["half_width"];
  const int twists = values.whole("full_twists");
  return sample_grid({{0, 2 * pi, resolution, Seam::closed},
                      {-half_width, half_width, steps_for(2 * half_width, resolution, 2 * pi, 8)}},
                     [&](double u, double v) {
                       const double r = 1 + v * portable::cos(twists * u);
                       return Vec3(r * portable::cos(u), v * portable::sin(twists * u), r * portable::sin(u));
                     });
}

}  // namespace

std::vector<SampleMaker> band_samples() {
  return {
      {{"mobius_extended",
        "Moebius band wider than its ring: non-orientable, one boundary, runs through its own other side",
        {{"half_width", 2.8, 2.1, 5, "half the width, ring radius 1"}}},
       64,
       mobius_extended},
      {{"lemniscate_band",
        "ribbon along a figure eight with half twists: non-orientable where they are odd, one double curve",
        {{"half_width", 0.45, 0.1, 1, "half the width, lobes of length 2"},
         {"half_twists", 3, 0, 9, "number of half twists", true}}},
       140,
       lemniscate_band},
      {{"twisted_annulus",
        "annulus with full twists, wider than its ring: orientable, two boundaries, branching double curves",
        {{"half_width", 1.45, 1.1, 3, "half the width, ring radius 1"},
         {"full_twists", 1, 1, 4, "number of full twists", true}}},
       72,
       twisted_annulus},
  };
}

}  // namespace unsnarl
