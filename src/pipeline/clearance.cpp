#include "unsnarl/clearance.h"

#include <cmath>
#include <numbers>
#include <vector>

#include "contact/intersection_finder.h"
#include "contact/smallest_gap.h"
#include "geometry/parallel.h"
#include "mesh/adjacency.h"
#include "mesh/components.h"
#include "mesh/dihedral_angles.h"
#include "mesh/validity.h"
#include "scene/prepared_surface.h"

namespace unsnarl {
namespace {

void take(const SmallestGap& gap, const PreparedSurface& prepared, double& distance,
          std::array<std::int32_t, 2>& faces) {
  const std::vector<Index>& polygon = prepared.triangulation.polygon;
  distance = std::isfinite(gap.distance) ? prepared.scale.out(gap.distance) : gap.distance;
  if (gap.first >= 0) faces = {polygon[gap.first], polygon[gap.second]};
}

}  // namespace

Clearance measure_clearance(const SurfaceView& input, std::span<const double> positions, const FindOptions& options,
                            bool is_embedded) {
  require_positions(input, positions);
  const ThreadLimit threads(options.threads);
  const PreparedSurface prepared = prepare(input, options);
  const Positions x = prepared.gather(positions);
  const std::span<const Triangle> triangles = prepared.triangles();
  const std::vector<Index>& polygon = prepared.triangulation.polygon;
  Clearance result;
  const std::vector<Hinge> hinges = hinges_of(triangles);
  if (const SmallestAngle angle = smallest_angle(x, hinges); angle.hinge >= 0) {
    result.dihedral_deg = angle.radians * 180 / std::numbers::pi;
    result.dihedral_faces = {polygon[hinges[angle.hinge].first], polygon[hinges[angle.hinge].second]};
  }
  const Components components = find_components(input, prepared.weld_map, triangles, build_edges(triangles));
  std::vector<IntersectingPair> pairs;
  if (!is_embedded) pairs = IntersectionFinder(triangles, prepared.passing()).find(x);
  for (const IntersectingPair& pair : pairs) {
    result.gap = 0;
    if (components.component_of_triangle[pair.a] != components.component_of_triangle[pair.b]) result.component_gap = 0;
  }
  if (result.gap > 0) take(smallest_gap(triangles, x, {}, prepared.passing()), prepared, result.gap, result.gap_faces);
  if (result.component_gap > 0 && components.count() > 1)
    take(smallest_gap(triangles, x, components.component_of_triangle, prepared.passing()), prepared,
         result.component_gap, result.component_gap_faces);
  return result;
}

}  // namespace unsnarl
