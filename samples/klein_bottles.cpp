#include <cmath>

#include "samples/klein_maps.h"
#include "samples/sample_maker.h"

namespace unsnarl {
namespace {

/// Leaves out a disc of parameters around (u, v), measured in fractions of the two periods.
auto without_disc(double u, double v, double radius, const ParameterGrid& grid) {
  return [=, du = grid.u.maximum - grid.u.minimum, dv = grid.v.maximum - grid.v.minimum](double a, double b) {
    const double along = (a - u) / du * 2, across = (b - v) / dv;
    return along * along + across * across > radius * radius;
  };
}

Surface klein_bottle_punctured(int resolution, const SampleValues& values) {
  ParameterGrid grid = klein_bottle_grid(resolution, FaceKind::triangles);
  // On the wide side, away from the neck's passage.
  grid.keep = without_disc(0.75 * grid.u.maximum, grid.v.minimum + 0.5, values["hole"], grid);
  return sample_grid(grid, klein_bottle_map);
}

Surface klein_figure8_punctured(int resolution, const SampleValues& values) {
  ParameterGrid grid = klein_figure8_grid(resolution, FaceKind::quads);
  grid.keep = without_disc(0.4 * grid.u.maximum, 0.27 * grid.v.maximum, values["hole"], grid);
  return sample_grid(grid, [](double u, double v) { return klein_figure8_map(u, v, 2.2); });
}

}  // namespace

std::vector<SampleMaker> klein_bottle_samples() {
  const SampleParameter hole = {"hole", 0.14, 0.03, 0.3, "radius of the hole, in periods of the parameters"};
  return {
      {{"klein_bottle_punctured",
        "Klein bottle without a disc: non-orientable, one boundary, one double circle",
        {hole}},
       76,
       klein_bottle_punctured},
      {{"klein_figure8_punctured",
        "figure-eight Klein bottle without a disc: a double circle that is a Moebius core",
        {hole}},
       72,
       klein_figure8_punctured},
  };
}

}  // namespace unsnarl
