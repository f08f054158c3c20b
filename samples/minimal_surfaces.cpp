#include <cmath>
#include <numbers>

#include "geometry/portable_math.h"
#include "samples/parameter_grid.h"
#include "samples/sample_maker.h"

namespace unsnarl {
namespace {

using std::numbers::pi;

Surface enneper(int resolution, const SampleValues& values) {
  const double reach = values["reach"];
  // A square rounded towards a disc, as its corners would fly far away; not quite symmetric, as the double curves lie
  // on lines of symmetry.
  return sample_grid({{-1, 1.01, resolution}, {-1.02, 1, resolution}}, [&](double s, double t) -> Vec3 {
    const double u = reach * s * std::sqrt(1 - 0.4 * t * t), v = reach * t * std::sqrt(1 - 0.4 * s * s);
    return Vec3(u - u * u * u / 3 + u * v * v, u * u - v * v, -v + v * v * v / 3 - v * u * u) / 2;
  });
}

/// The points (u, v) and (-u, v + pi) are one: a Moebius band, with branch points where u = 0 and sin 2v = 0.
Surface henneberg(int resolution, const SampleValues& values) {
  const double reach = values["reach"];
  return sample_grid(
      {{0.03, pi + 0.03, resolution, Seam::mirrored}, {-reach, reach, steps_for(2 * reach, resolution, 2.2, 9) | 1}},
      [](double v, double u) -> Vec3 {
        const double x =
            2 * portable::sinh(u) * portable::cos(v) - 2.0 / 3 * portable::sinh(3 * u) * portable::cos(3 * v);
        const double z =
            2 * portable::sinh(u) * portable::sin(v) + 2.0 / 3 * portable::sinh(3 * u) * portable::sin(3 * v);
        return Vec3(x, 2 * portable::cosh(2 * u) * portable::cos(2 * v), z) / 2;
      });
}

Surface catalan(int resolution, const SampleValues& values) {
  const double reach = values["reach"], end = 2 * pi * values["periods"];
  return sample_grid({{-0.21 * end, 0.79 * end, resolution},
                      {-reach, 1.02 * reach, steps_for(2 * reach, resolution, end * 0.55, 8)},
                      FaceKind::quads},
                     [](double u, double v) -> Vec3 {
                       return Vec3(u - portable::sin(u) * portable::cosh(v), 1 - portable::cos(u) * portable::cosh(v),
                                   4 * portable::sin(u / 2) * portable::sinh(v / 2)) /
                              3;
                     });
}

}  // namespace

std::vector<SampleMaker> minimal_surface_samples() {
  return {
      {{"enneper",
        "Enneper's minimal surface, large enough to meet itself: a disc with two double curves that cross",
        {{"reach", 2.2, 1.8, 4, "half the side of the rounded square of parameters"}}},
       44,
       enneper},
      {{"henneberg",
        "patch of Henneberg's minimal surface: non-orientable, branch points, branching double curves",
        {{"reach", 0.55, 0.2, 1.2, "half the height of the strip of parameters"}}},
       64,
       henneberg},
      {{"catalan",
        "patch of Catalan's minimal surface, through itself in every period",
        {{"reach", 2.0, 0.8, 3, "half the height of the strip of parameters"},
         {"periods", 2, 1, 5, "length of the patch, in periods"}}},
       80,
       catalan},
  };
}

}  // namespace unsnarl
