#include "report/measure.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include "energy/minkowski_penalty.h"
#include "geometry/portable_math.h"
#include "geometry/sort_unique.h"
#include "mesh/areas.h"
#include "scene/component_mesh.h"

namespace unsnarl {
namespace {

/// `diagonal`: at the scale.
void measure_displacement(std::span<const double> before, std::span<const double> after, const Scale& scale,
                          double diagonal, RepairReport& report) {
  const std::size_t n = before.size() / 3;
  if (n == 0) return;
  double sum = 0, squares = 0, largest = 0;
  std::size_t untouched = 0;
  for (std::size_t v = 0; v < n; ++v) {
    double squared = 0;
    for (int k = 0; k < 3; ++k) squared += portable::pow(scale.in(after[3 * v + k]) - scale.in(before[3 * v + k]), 2);
    bool same = true;
    for (int k = 0; k < 3; ++k) same &= after[3 * v + k] == before[3 * v + k];
    untouched += same;
    sum += std::sqrt(squared);
    squares += squared;
    largest = std::max(largest, std::sqrt(squared));
  }
  const double unit = diagonal > 0 ? 1 / diagonal : 0;
  report.displacement_mean_rel = sum / static_cast<double>(n) * unit;
  report.displacement_rms_rel = std::sqrt(squares / static_cast<double>(n)) * unit;
  report.displacement_max_rel = largest * unit;
  report.untouched_share = static_cast<double>(untouched) / static_cast<double>(n);
}

/// Root mean square of the motion over `area`, that of the triangles at rest: a length.
double motion_by_area(const PreparedSurface& prepared, const Positions& x, double area) {
  double sum = 0;
  for (const Triangle& t : prepared.triangles()) sum += squared_motion(prepared.rest, x, t);
  return area > 0 ? std::sqrt(sum / area) : 0;
}

/// Signed volume after / before - 1 of the component with a volume for which it is largest in magnitude.
double volume_change(const PreparedSurface& prepared, const Components& components, const Positions& x) {
  const std::vector<std::vector<Triangle>> triangles = triangles_by_component(prepared.triangles(), components);
  double worst = 0;
  for (Index c = 0; c < components.count(); ++c) {
    if (!has_volume(components.list[c])) continue;
    const double before = signed_volume(prepared.rest, triangles[c]);
    if (before == 0) continue;
    const double change = signed_volume(x, triangles[c]) / before - 1;
    if (std::abs(change) > std::abs(worst)) worst = change;
  }
  return worst;
}

/// Largest penetration depth among the pairs that share no vertex and that motion can separate. For every direction n,
/// the triangles overlap by at least their depth along n, and where all vertices move by at most d, by at least depth -
/// 2 d afterwards: an embedded result has d > depth / 2.
double deepest_overlap(const PreparedSurface& prepared, const Diagnosis& diagnosis) {
  const std::span<const Triangle> triangles = prepared.triangles();
  double deepest = 0;
  for (const IntersectingPair& pair : diagnosis.pairs)
    if (pair.kind == PairClass::disjoint &&
        !std::binary_search(diagnosis.obstructed.begin(), diagnosis.obstructed.end(), pair))
      deepest = std::max(deepest, overlap_depth(prepared.rest, triangles[pair.a], triangles[pair.b]));
  return std::isfinite(deepest) ? deepest : 0;
}

void measure_stretch(const PreparedSurface& prepared, std::size_t edge_count, const Positions& x,
                     RepairReport& report) {
  const auto moved = [&](Index v) { return x.col(v) != prepared.rest.col(v); };
  std::vector<Edge> edges;  // those with a moved end; all others keep their length
  for (const Triangle& t : prepared.triangles())
    for (int k = 0; k < 3; ++k) {
      const auto [a, b] = std::minmax(t[k], t[(k + 1) % 3]);
      if (a != b && (moved(a) || moved(b))) edges.push_back({a, b});
    }
  sort_unique(edges);
  std::vector<double> stretch;
  stretch.reserve(edges.size());
  for (const auto& [a, b] : edges) {
    const double before = (prepared.rest.col(a) - prepared.rest.col(b)).norm(), after = (x.col(a) - x.col(b)).norm();
    if (before > 0)
      stretch.push_back(after > 0 ? std::max(after / before, before / after) : std::numeric_limits<double>::infinity());
  }
  report.edge_stretch_max = stretch.empty() ? 1 : *std::max_element(stretch.begin(), stretch.end());
  report.edge_stretch_p999 = 1;
  const std::size_t above = edge_count / 1000;  // as many may be stretched more
  if (above >= stretch.size()) return;
  const auto place = stretch.begin() + static_cast<std::ptrdiff_t>(above);
  std::nth_element(stretch.begin(), place, stretch.end(), std::greater<>());
  report.edge_stretch_p999 = *place;
}

}  // namespace

void measure_change(const SurfaceView& surface, const PreparedSurface& prepared, const Diagnosis& diagnosis,
                    std::span<const double> positions, RepairReport& report) {
  report.diagonal = diagonal_of(surface);
  const double diagonal = prepared.diagonal_of(surface.positions);
  measure_displacement(surface.positions, positions, prepared.scale, diagonal, report);
  const Positions x = prepared.gather(positions);
  const std::span<const Triangle> triangles = prepared.triangles();
  std::vector<std::uint8_t> in_conflict(triangles.size(), 0);
  for (const IntersectingPair& pair : diagnosis.pairs) in_conflict[pair.a] = in_conflict[pair.b] = 1;
  report.flipped_triangles = report.flipped_triangles_without_conflict = 0;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (area_vector(prepared.rest, triangles[t]).dot(area_vector(x, triangles[t])) >= 0) continue;
    ++report.flipped_triangles;
    report.flipped_triangles_without_conflict += in_conflict[t] == 0;
  }
  report.volume_change_rel = volume_change(prepared, diagnosis.components, x);
  const double area = total_area(prepared.rest, triangles);
  report.displacement_area_rms_rel = diagonal > 0 ? motion_by_area(prepared, x, area) / diagonal : 0;
  report.displacement_lower_bound_rel = diagonal > 0 ? 0.5 * deepest_overlap(prepared, diagnosis) / diagonal : 0;
  measure_stretch(prepared, diagnosis.edges.size(), x, report);
  report.area_change_rel = area > 0 ? total_area(x, triangles) / area - 1 : 0;
}

void measure_components(const PreparedSurface& prepared, const Diagnosis& diagnosis,
                        const std::vector<IntersectingPair>& left, RepairReport& report) {
  const Components& known = diagnosis.components;
  std::vector<ComponentReport> components(known.list.size());
  const auto count = [&](const std::vector<IntersectingPair>& pairs, std::size_t ComponentReport::*counter) {
    std::vector<std::vector<IntersectingPair>> own(components.size());
    for (const IntersectingPair& pair : pairs)
      if (!are_of_two_components(known, pair)) own[known.component_of_triangle[pair.a]].push_back(pair);
    for (std::size_t c = 0; c < own.size(); ++c)
      components[c].*counter = pairs_of_faces(prepared.triangulation.polygon, own[c]).size();
  };
  count(diagnosis.pairs, &ComponentReport::pairs_before);
  count(left, &ComponentReport::pairs_after);
  for (std::size_t c = 0; c < components.size(); ++c) {
    if (components[c].pairs_before + components[c].pairs_after == 0) continue;
    components[c].component = c;
    components[c].first_face = prepared.triangulation.polygon[known.list[c].first_triangle];
    report.components.push_back(components[c]);
  }
}

void name_pairs_between_components(const PreparedSurface& prepared, const Diagnosis& diagnosis,
                                   const std::vector<IntersectingPair>& left, RepairReport& report) {
  std::vector<IntersectingPair> between;
  for (const IntersectingPair& pair : left)
    if (are_of_two_components(diagnosis.components, pair)) between.push_back(pair);
  if (between.empty()) return;
  between = pairs_of_faces(prepared.triangulation.polygon, between);
  Obstruction obstruction{Obstruction::Kind::between_components, {}, {}};
  for (const IntersectingPair& pair : between) obstruction.faces.insert(obstruction.faces.end(), {pair.a, pair.b});
  sort_unique(obstruction.faces);
  obstruction.message = std::to_string(between.size()) +
                        " pairs of faces of different components intersect: each component was repaired by itself";
  report.obstructions.push_back(std::move(obstruction));
}

void name_duplicates_by_other_cuts(std::span<const IntersectingPair> by_other_cuts, RepairReport& report) {
  Obstruction obstruction{Obstruction::Kind::duplicate_faces, {}, {}};
  for (const IntersectingPair& pair : by_other_cuts)
    if (pair.kind == PairClass::duplicate) obstruction.faces.insert(obstruction.faces.end(), {pair.a, pair.b});
  if (obstruction.faces.empty()) return;
  sort_unique(obstruction.faces);
  obstruction.message = "pieces of " + std::to_string(obstruction.faces.size()) +
                        " polygons lie on the same three vertices where they are split along other diagonals";
  report.obstructions.push_back(std::move(obstruction));
}

}  // namespace unsnarl
