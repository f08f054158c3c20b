#include "scene/overlapping_components.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "mesh/areas.h"
#include "scene/component_mesh.h"

namespace unsnarl {
namespace {

/// Lines through a component along which the share of its volume in others is measured [E207] (unit: lines)
constexpr int lines_through_component = 64;

/// Steps of a sequence that fills a square evenly: powers of 1 / 1.3247, the plastic number (fixed by arithmetic)
constexpr std::array<double, 2> even_steps = {0.7548776662466927, 0.5698402909980532};

using Intervals = std::vector<std::array<double, 2>>;  // of x

void add_inside(const ClosedSurface& surface, double y, double z, Intervals& inside) {
  const std::vector<double> crossings = surface.crossings(y, z);
  for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) inside.push_back({crossings[i], crossings[i + 1]});
}

double length_of(const Intervals& intervals) {
  double length = 0;
  for (const auto& [begin, end] : intervals) length += end - begin;
  return length;
}

/// Sorted, and those that overlap as one.
Intervals united(Intervals intervals) {
  std::sort(intervals.begin(), intervals.end());
  Intervals result;
  for (const auto& [begin, end] : intervals) {
    if (result.empty() || begin > result.back()[1]) result.push_back({begin, end});
    result.back()[1] = std::max(result.back()[1], end);
  }
  return result;
}

/// Length of what lies in one of `intervals` and one of `others`, both ascending and without overlaps.
double common_length(const Intervals& intervals, const Intervals& others) {
  double length = 0;
  for (std::size_t i = 0, j = 0; i < intervals.size() && j < others.size();) {
    const auto& [a, b] = intervals[i];
    const auto& [c, d] = others[j];
    length += std::max(0.0, std::min(b, d) - std::max(a, c));
    ++(b < d ? i : j);
  }
  return length;
}

/// Points spread evenly over the triangles as they are seen along x; fewer or none where they are seen from their
/// edges. The k-th lies in the k-th of equal parts of their area, at the k-th place of a sequence that fills a
/// triangle.
std::vector<Vec3> points_seen_along_x(const ComponentMesh& mesh) {
  std::vector<double> area_up_to;
  double area = 0;
  for (const Triangle& t : mesh.triangles) area_up_to.push_back(area += std::abs(area_vector(mesh.x, t)[0]));
  std::vector<Vec3> points;
  if (!(area > 0)) return points;
  for (int k = 0; k < lines_through_component; ++k) {
    const auto place =
        std::lower_bound(area_up_to.begin(), area_up_to.end(), area * (k + 0.5) / lines_through_component);
    const Triangle& t = mesh.triangles[std::min<std::size_t>(place - area_up_to.begin(), area_up_to.size() - 1)];
    double u = std::fmod((k + 1) * even_steps[0], 1), v = std::fmod((k + 1) * even_steps[1], 1);
    if (u + v > 1) u = 1 - u, v = 1 - v;
    points.push_back((1 - u - v) * mesh.x.col(t[0]) + u * mesh.x.col(t[1]) + v * mesh.x.col(t[2]));
  }
  return points;
}

/// Share of the volume of a component that lies in any of the others.
double share_inside(const SolidComponent& solid, std::span<const SolidComponent* const> others) {
  double whole = 0, shared = 0;
  for (const Vec3& p : points_seen_along_x(solid.mesh)) {
    Intervals inside, in_others;
    add_inside(solid.surface, p[1], p[2], inside);
    for (const SolidComponent* other : others) add_inside(other->surface, p[1], p[2], in_others);
    if (inside.empty()) continue;
    // A line is met as often as it crosses the component, and counts as much less.
    const double weight = 1 / static_cast<double>(inside.size());
    whole += weight * length_of(inside);
    shared += weight * common_length(inside, united(std::move(in_others)));
  }
  return whole > 0 ? shared / whole : 0;
}

}  // namespace

std::vector<OverlappingComponent> overlapping_components(const PreparedSurface& prepared, const Components& components,
                                                         std::span<const ComponentPair> meeting) {
  std::map<Index, std::vector<Index>> met_by;
  for (const auto& [a, b] : meeting)
    if (has_volume(components.list[a]) && has_volume(components.list[b]))
      met_by[a].push_back(b), met_by[b].push_back(a);
  if (met_by.empty()) return {};
  const std::vector<std::vector<Triangle>> triangles = triangles_by_component(prepared.triangles(), components);
  std::map<Index, SolidComponent> solids;
  std::map<Index, bool> is_hollow;
  for (const auto& [c, others] : met_by) {
    const SolidComponent& solid = solids.try_emplace(c, component_mesh(prepared.rest, triangles[c])).first->second;
    is_hollow[c] = signed_volume(solid.mesh.x, solid.mesh.triangles) < 0;
  }
  std::vector<OverlappingComponent> overlapping;
  for (const auto& [c, met] : met_by) {
    std::vector<const SolidComponent*> others;
    for (const Index other : met)
      if (is_hollow[other] == is_hollow[c]) others.push_back(&solids.at(other));
    const double share = others.empty() ? 0 : share_inside(solids.at(c), others);
    if (share <= large_overlap_share) continue;
    const Index first_face = prepared.triangulation.polygon[components.list[c].first_triangle];
    overlapping.push_back({static_cast<std::size_t>(c), first_face, {}, share});
  }
  return overlapping;
}

}  // namespace unsnarl
