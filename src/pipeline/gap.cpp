#include "pipeline/gap.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "mesh/areas.h"
#include "scene/rounding.h"

namespace unsnarl {
namespace {

/// The gap wanted between sheets, in units in the last place of the format to be written: rounding moves each of the
/// two by half a unit in every coordinate, which is less than two units of distance; the rest is reserve.
constexpr double gap_units = 8;
/// float32 is asked for only where that gap is at most this share of the faces' mean altitude; else coordinates are too
/// coarse for them. Of seven meshes the needles of a CAD export are at 0.045 (it took 83 s to find out that rounding
/// leaves them intersecting), bodies, characters, tangles and a mesh with degenerate faces between 5e-5 and 1e-3.
constexpr double largest_gap_of_altitude = 0.02;

}  // namespace

double gap_of_format(const Scene& scene, std::span<const Index> vertices, bool float32, const Scale& scale) {
  double largest = 0;
  for (Index v : vertices) largest = std::max(largest, scene.rest.col(v).cwiseAbs().maxCoeff());
  return gap_units * (float32 ? float32_unit(largest, scale) : float64_unit(largest, scale));
}

bool float32_can_hold(const Scene& scene, std::span<const IntersectingPair> pairs, const Scale& scale) {
  std::vector<Triangle> conflict;
  double largest = 0;
  for (const IntersectingPair& pair : pairs)
    for (Index t : {pair.a, pair.b}) {
      conflict.push_back(scene.triangles[t]);
      for (Index v : conflict.back()) largest = std::max(largest, scene.rest.col(v).cwiseAbs().maxCoeff());
    }
  const double unit = float32_unit(largest, scale);
  return std::isfinite(unit) && gap_units * unit <= largest_gap_of_altitude * mean_least_altitude(scene.rest, conflict);
}

}  // namespace unsnarl
