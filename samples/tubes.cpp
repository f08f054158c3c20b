#include <numbers>

#include "geometry/portable_math.h"
#include "samples/parameter_grid.h"
#include "samples/sample_maker.h"
#include "samples/tube.h"

namespace unsnarl {
namespace {

using std::numbers::pi;

Surface knotted_tube(const SpaceCurve& centre, double length, double radius, int resolution, FaceKind faces) {
  return sample_tube({centre, 0, 2 * pi, true, [=](double) { return radius; }, resolution,
                      steps_for(2 * pi * radius, resolution, length, 6), faces});
}

Surface trefoil_tube(int resolution, const SampleValues& values) {
  const auto centre = [](double t) -> Vec3 {
    return Vec3(portable::sin(t) + 2 * portable::sin(2 * t), portable::cos(t) - 2 * portable::cos(2 * t),
                -portable::sin(3 * t)) /
           2;
  };
  return knotted_tube(centre, 15, values["radius"], resolution, FaceKind::triangles);
}

Surface figure_eight_knot_tube(int resolution, const SampleValues& values) {
  const auto centre = [](double t) -> Vec3 {
    const double r = 2 + portable::cos(2 * t);
    return Vec3(r * portable::cos(3 * t), portable::sin(4 * t), r * portable::sin(3 * t)) / 2;
  };
  return knotted_tube(centre, 22, values["radius"], resolution, FaceKind::quads);
}

/// Straight open tubes across each other.
Surface crossing_tubes(int resolution, const SampleValues& values) {
  const double radius = values["radius"];
  MeshBuilder builder;
  for (int k = 0; k < 2; ++k) {
    const double angle = (k == 0 ? -1 : 1) * values["angle"] * pi / 360;
    const Vec3 along(portable::cos(angle), portable::sin(angle), 0.05 * k);
    const Vec3 middle(0.013 * k, 0.021 * k, values["offset"] * k);
    builder.append(sample_tube({[=](double t) { return Vec3(middle + (t + 0.03 * k) * along); }, -1.5, 1.5, false,
                                [=](double t) { return radius * (1 + 0.1 * portable::cos(2 * t)); }, resolution,
                                steps_for(2 * pi * radius, resolution, 3, 8), FaceKind::quads}));
  }
  return builder.take();
}

}  // namespace

std::vector<SampleMaker> tube_samples() {
  return {
      {{"trefoil_tube",
        "tube around a trefoil knot, thick enough to touch itself all along",
        {{"radius", 0.56, 0.1, 1, "radius of the tube, knot of size 3"}}},
       100,
       trefoil_tube},
      {{"figure_eight_knot_tube",
        "tube around a figure-eight knot, running through itself at its crossings",
        {{"radius", 0.34, 0.1, 0.8, "radius of the tube, knot of size 3"}}},
       180,
       figure_eight_knot_tube},
      {{"crossing_tubes",
        "two open tubes through each other: four boundaries, one double curve or two",
        {{"radius", 0.35, 0.1, 1, "radius of the tubes, length 3"},
         {"angle", 70, 10, 90, "angle between the tubes, in degrees"},
         {"offset", 0.2, 0, 1, "distance between their axes"}}},
       36,
       crossing_tubes},
  };
}

}  // namespace unsnarl
