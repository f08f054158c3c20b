#include "scene/prepared_surface.h"

#include <algorithm>
#include <tuple>

#include "mesh/validity.h"

namespace unsnarl {

Positions PreparedSurface::gather(std::span<const double> positions) const {
  Positions x(3, weld_map.count);
  for (Index v = 0; v < weld_map.count; ++v)
    for (int k = 0; k < 3; ++k) x(k, v) = positions[3 * static_cast<std::size_t>(weld_map.first[v]) + k];
  return x;
}

std::vector<double> PreparedSurface::scatter(std::span<const double> input, const Positions& x) const {
  std::vector<double> positions(input.begin(), input.end());
  for (std::size_t v = 0; v < weld_map.vertex_of.size(); ++v) {
    const Index id = weld_map.vertex_of[v];
    for (int k = 0; k < 3; ++k)
      if (x(k, id) != rest(k, id)) positions[3 * v + k] = x(k, id);
  }
  return positions;
}

PreparedSurface prepare(const SurfaceView& surface, const FindOptions& options) {
  require_valid(surface);
  PreparedSurface prepared;
  prepared.weld_map = weld(surface, options.weld, options.weld_tolerance);
  prepared.triangulation = triangulate(surface, prepared.weld_map.vertex_of);
  if (options.both_diagonals)
    prepared.other_diagonals = triangulate_other_diagonals(surface, prepared.weld_map.vertex_of);
  prepared.rest = prepared.gather(surface.positions);
  return prepared;
}

std::vector<IntersectingPair> pairs_of_faces(std::span<const Index> polygon, std::span<const IntersectingPair> pairs) {
  std::vector<IntersectingPair> faces;
  faces.reserve(pairs.size());
  for (const IntersectingPair& pair : pairs) {
    const auto [a, b] = std::minmax(polygon[pair.a], polygon[pair.b]);
    faces.push_back({a, b, pair.kind});
  }
  std::sort(faces.begin(), faces.end());
  const auto same_faces = [](const auto& p, const auto& q) { return p.a == q.a && p.b == q.b; };
  faces.erase(std::unique(faces.begin(), faces.end(), same_faces), faces.end());
  return faces;
}

}  // namespace unsnarl
