#include "scene/prepared_surface.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "geometry/box.h"
#include "mesh/validity.h"

namespace unsnarl {
namespace {

/// Sorts, and leaves each pair once, in the class that comes first.
void sort_unique_faces(std::vector<IntersectingPair>& pairs) {
  std::sort(pairs.begin(), pairs.end());
  const auto same_faces = [](const auto& p, const auto& q) { return p.a == q.a && p.b == q.b; };
  pairs.erase(std::unique(pairs.begin(), pairs.end(), same_faces), pairs.end());
}

}  // namespace

Positions PreparedSurface::gather(std::span<const double> positions, const Scale& other) const {
  Positions x(3, weld_map.count);
  for (Index v = 0; v < weld_map.count; ++v)
    for (int k = 0; k < 3; ++k) x(k, v) = other.in(positions[3 * static_cast<std::size_t>(weld_map.first[v]) + k]);
  return x;
}

std::vector<double> PreparedSurface::scatter(std::span<const double> input, const Positions& x) const {
  std::vector<double> positions(input.begin(), input.end());
  for (std::size_t v = 0; v < weld_map.vertex_of.size(); ++v) {
    const Index id = weld_map.vertex_of[v];
    for (int k = 0; k < 3; ++k)
      if (x(k, id) != rest(k, id)) positions[3 * v + k] = scale.out(x(k, id));
  }
  return positions;
}

double PreparedSurface::diagonal_of(std::span<const double> positions) const {
  return diagonal_of_box(positions, scale);
}

bool PreparedSurface::seams_are_closed(std::span<const double> positions) const {
  for (std::size_t v = 0; v < weld_map.vertex_of.size(); ++v) {
    const double* const first = &positions[3 * static_cast<std::size_t>(weld_map.first[weld_map.vertex_of[v]])];
    if (!std::equal(first, first + 3, &positions[3 * v])) return false;
  }
  return true;
}

PreparedSurface prepare(const SurfaceView& surface, const FindOptions& options) {
  require_valid(surface);
  if (!(options.weld_tolerance >= 0))
    throw std::invalid_argument("FindOptions::weld_tolerance is " + std::to_string(options.weld_tolerance) +
                                "; give a length, or 0 for equal positions alone");
  if (options.threads < 0)
    throw std::invalid_argument("FindOptions::threads is " + std::to_string(options.threads) +
                                "; give 0 for as many as the machine has, or their number");
  PreparedSurface prepared;
  prepared.scale = Scale(surface.positions);
  std::vector<double> scaled;
  if (!prepared.scale.is_one()) scaled = prepared.scale.in(surface.positions);
  const SurfaceView at_scale = {prepared.scale.is_one() ? surface.positions : scaled, surface.corners, surface.offsets};
  prepared.weld_map = weld(at_scale, options.weld, prepared.scale.in(options.weld_tolerance));
  prepared.triangulation = triangulate(surface, prepared.weld_map.vertex_of);
  if (options.both_diagonals)
    prepared.other_diagonals = triangulate_other_diagonals(surface, prepared.weld_map.vertex_of);
  prepared.allowed = allowed_parts(surface, options.allowed);
  prepared.part_of = prepared.allowed.of_triangles(prepared.triangulation.polygon);
  prepared.rest = prepared.gather(surface.positions);
  return prepared;
}

std::optional<PreparedSurface> cut_anew(const SurfaceView& surface, const PreparedSurface& prepared,
                                        const FindOptions& options, std::span<const double> positions) {
  if (surface.offsets.empty()) return std::nullopt;
  const SurfaceView read = {positions, surface.corners, surface.offsets};
  Triangulation cut = triangulate(read, prepared.weld_map.vertex_of), other_diagonals;
  if (options.both_diagonals) other_diagonals = triangulate_other_diagonals(read, prepared.weld_map.vertex_of);
  if (cut.triangles == prepared.triangulation.triangles &&
      other_diagonals.triangles == prepared.other_diagonals.triangles)
    return std::nullopt;
  PreparedSurface anew = prepared;
  anew.triangulation = std::move(cut);
  anew.other_diagonals = std::move(other_diagonals);
  anew.part_of = anew.allowed.of_triangles(anew.triangulation.polygon);
  return anew;
}

std::vector<IntersectingPair> pairs_of_faces(std::span<const Index> polygon, std::span<const IntersectingPair> pairs) {
  std::vector<IntersectingPair> faces;
  faces.reserve(pairs.size());
  for (const IntersectingPair& pair : pairs) {
    const auto [a, b] = std::minmax(polygon[pair.a], polygon[pair.b]);
    faces.push_back({a, b, pair.kind});
  }
  sort_unique_faces(faces);
  return faces;
}

std::vector<IntersectingPair> unite_face_pairs(std::vector<IntersectingPair> pairs,
                                               std::span<const IntersectingPair> others) {
  pairs.insert(pairs.end(), others.begin(), others.end());
  sort_unique_faces(pairs);
  return pairs;
}

}  // namespace unsnarl
