#include "report/changed_components.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include "energy/minkowski_penalty.h"
#include "geometry/portable_math.h"
#include "mesh/adjacency.h"
#include "mesh/areas.h"
#include "rigid/rigid_motion.h"
#include "scene/component_mesh.h"
#include "scene/overlapping_components.h"

namespace unsnarl {
namespace {

/// A component is named from this loss of volume or area on (fixed by the report)
constexpr double large_loss = 0.05;
/// And from this rotation on, in degrees (fixed by the report)
constexpr double large_rotation_deg = 5;
/// And from a motion of this multiple of its depth on (fixed by the report)
constexpr double far_in_depths = 2;
/// A motion below this share of the diagonal of its own box is not far: what only touches has no depth (fixed by the
/// report)
constexpr double far_in_own_diagonals = 0.01;
/// An edge is a new crease from this growth of the angle between the normals beside it on, in degrees (fixed by the
/// report)
constexpr double new_crease_deg = 45;
/// A component is named from this share of its area beside new creases on (fixed by the report)
constexpr double large_creased_share = 0.02;

/// Where the nearest point of a surface is looked for at first, in diagonals of its box; it does not change what is
/// found (no unit)
constexpr double first_guess = 0.01;

/// Before and after: what all of this is measured of.
struct Change {
  const PreparedSurface& prepared;
  const Diagnosis& diagnosis;
  const Positions& x;
  std::vector<std::vector<Triangle>> triangles;  ///< of each component
  double gap;                                    ///< a length
  double diagonal;                               ///< of the input, at the scale of the positions
};

Box box_of_all(const Positions& x) {
  Box box;
  for (Index v = 0; v < x.cols(); ++v) box.extend(Vec3(x.col(v)));
  return box;
}

/// A third of the area of the triangles at each vertex.
Eigen::VectorXd areas_of_vertices(const ComponentMesh& component) {
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(component.x.cols());
  for (const Triangle& t : component.triangles)
    for (const Index v : t) areas[v] += triangle_area(component.x, t) / 3;
  return areas;
}

double rotation_between(const ComponentMesh& before, const ComponentMesh& after) {
  const Eigen::VectorXd areas = areas_of_vertices(before);
  return areas.sum() > 0 ? best_rigid_motion(before.x, after.x, areas).degrees() : 0;
}

/// Share of its size that a component has gained; 0: it had none.
double size_change(const ComponentMesh& before, const ComponentMesh& after, bool is_closed) {
  const auto size = [&](const ComponentMesh& component) {
    return is_closed ? signed_volume(component.x, component.triangles) : total_area(component.x, component.triangles);
  };
  const double size_before = size(before);
  return size_before == 0 ? 0 : size(after) / size_before - 1;
}

/// Distance of a point inside from the surface; 0: it is not inside. `guess`: a length.
double depth_of(const Vec3& p, const SolidComponent& around, double guess) {
  return around.surface.side_of(p) == Side::inside ? around.surface.nearest(p, guess).closest.distance : 0;
}

/// The largest distance of a vertex, the middle of an edge or of a face of `of`, inside `around`, from the surface of
/// that; at least `depth`.
double depth_inside(const ComponentMesh& of, const SolidComponent& around, double depth) {
  const double guess = first_guess * box_of_all(around.mesh.x).diagonal();
  std::vector<double> at_vertex;
  for (Index v = 0; v < of.x.cols(); ++v) {
    at_vertex.push_back(depth_of(of.x.col(v), around, std::max(depth, guess)));
    depth = std::max(depth, at_vertex.back());
  }
  for (const Triangle& t : of.triangles) {
    const Vec3 a = of.x.col(t[0]), b = of.x.col(t[1]), c = of.x.col(t[2]);
    const double longest = std::sqrt(std::max({(a - b).squaredNorm(), (b - c).squaredNorm(), (c - a).squaredNorm()}));
    // Nothing of the triangle is deeper than a vertex by more than its distance from it.
    if (std::min({at_vertex[t[0]], at_vertex[t[1]], at_vertex[t[2]]}) + longest <= depth) continue;
    for (const Vec3& p : {Vec3((a + b) / 2), Vec3((b + c) / 2), Vec3((c + a) / 2), Vec3((a + b + c) / 3)})
      depth = std::max(depth, depth_of(p, around, std::max(depth, guess)));
  }
  return depth;
}

/// In the direction from a to b, the corners of t are passed in their order.
bool runs_along(const Triangle& t, Index a, Index b) {
  return (t[0] == a && t[1] == b) || (t[1] == a && t[2] == b) || (t[2] == a && t[0] == b);
}

/// In degrees; 0: one of the two triangles has no area. `sides_agree`: both look to the same side of the surface.
double angle_between(const Positions& x, const Triangle& t, const Triangle& u, bool sides_agree) {
  const Vec3 a = area_vector(x, t), b = sides_agree ? area_vector(x, u) : Vec3(-area_vector(x, u));
  return portable::atan2(a.cross(b).norm(), a.dot(b)) * 180 / std::numbers::pi;
}

/// See ChangedComponent::creased_share.
double creased_share(const ComponentMesh& before, const ComponentMesh& after) {
  const EdgeTable table = build_edges(before.triangles);
  std::vector<bool> is_creased(before.triangles.size());
  for (std::size_t e = 0; e < table.edges.size(); ++e) {
    const std::span<const Index> around = table.triangles_of_edge[static_cast<Index>(e)];
    if (around.size() != 2) continue;
    const Triangle &t = before.triangles[around[0]], &u = before.triangles[around[1]];
    const auto [a, b] = table.edges[e];
    const bool sides_agree = runs_along(t, a, b) != runs_along(u, a, b);
    if (angle_between(after.x, t, u, sides_agree) > angle_between(before.x, t, u, sides_agree) + new_crease_deg)
      is_creased[around[0]] = is_creased[around[1]] = true;
  }
  double creased = 0, all = 0;
  for (std::size_t t = 0; t < before.triangles.size(); ++t) {
    const double area = triangle_area(before.x, before.triangles[t]);
    all += area;
    if (is_creased[t]) creased += area;
  }
  return all > 0 ? creased / all : 0;
}

/// How deep components overlap others in the input.
class Depths {
 public:
  explicit Depths(const Change& change) : change_(change) {
    const Components& components = change.diagnosis.components;
    for (const auto& [a, b] : meeting_components(components, change.diagnosis.pairs)) {
      met_by_[a].push_back(b);
      met_by_[b].push_back(a);
    }
    for (const IntersectingPair& pair : change.diagnosis.pairs) {
      const Index a = components.component_of_triangle[pair.a], b = components.component_of_triangle[pair.b];
      if (a == b) intersects_itself_[a] = true;
      if (a == b || pair.kind != PairClass::disjoint) continue;
      const std::span<const Triangle> triangles = change.prepared.triangles();
      const double depth = overlap_depth(change.prepared.rest, triangles[pair.a], triangles[pair.b]);
      if (!std::isfinite(depth)) continue;
      of_pairs_[a] = std::max(of_pairs_[a], depth);
      of_pairs_[b] = std::max(of_pairs_[b], depth);
    }
  }

  /// A length; none: it is not known.
  std::optional<double> of(Index component) {
    const auto met = met_by_.find(component);
    if (intersects_itself_.contains(component)) return std::nullopt;
    if (met == met_by_.end()) return 0;
    for (const Index other : met->second)
      if (!is_closed(component) && !is_closed(other)) return std::nullopt;
    double depth = of_pairs_[component];
    for (const Index other : met->second)
      depth = std::max(depth, of_meeting({std::min(component, other), std::max(component, other)}));
    return depth;
  }

 private:
  /// How deep either of two components reaches into the other, where this is closed.
  double of_meeting(const ComponentPair& pair) {
    const auto [entry, is_new] = of_meeting_.try_emplace(pair, 0);
    const auto& [a, b] = pair;
    if (is_new && is_closed(b)) entry->second = depth_inside(solid(a).mesh, solid(b), entry->second);
    if (is_new && is_closed(a)) entry->second = depth_inside(solid(b).mesh, solid(a), entry->second);
    return entry->second;
  }
  bool is_closed(Index component) const { return change_.diagnosis.components.list[component].closed(); }
  const SolidComponent& solid(Index component) {
    const auto found = solids_.find(component);
    if (found != solids_.end()) return found->second;
    return solids_.try_emplace(component, component_mesh(change_.prepared.rest, change_.triangles[component]))
        .first->second;
  }

  const Change& change_;
  std::map<Index, std::vector<Index>> met_by_;
  std::map<Index, bool> intersects_itself_;
  std::map<Index, double> of_pairs_;  // the deepest pair of triangles of each component
  std::map<ComponentPair, double> of_meeting_;
  std::map<Index, SolidComponent> solids_;
};

/// The vertex of a component that moved farthest, and how far; -1: none moved.
std::pair<Index, double> farthest_vertex(const Change& change, Index component) {
  std::pair<Index, double> farthest = {-1, 0};
  for (const Triangle& t : change.triangles[component])
    for (const Index v : t)
      if (const double moved = (change.x.col(v) - change.prepared.rest.col(v)).norm(); moved > farthest.second)
        farthest = {v, moved};
  return farthest;
}

bool is_named(const ChangedComponent& changed) {
  return changed.has_shrunk || changed.is_turned || changed.is_far || changed.is_creased;
}

/// What became of a component that moved.
ChangedComponent measured(const Change& change, Index number, const std::pair<Index, double>& farthest,
                          Depths& depths) {
  const Component& component = change.diagnosis.components.list[number];
  const ComponentMesh before = component_mesh(change.prepared.rest, change.triangles[number]);
  const ComponentMesh after = before.at(change.x);
  ChangedComponent changed;
  changed.component = static_cast<std::size_t>(number);
  changed.first_face = change.prepared.triangulation.polygon[component.first_triangle];
  changed.is_closed = has_volume(component);
  changed.size_change_rel = size_change(before, after, changed.is_closed);
  changed.has_shrunk = changed.size_change_rel < -large_loss;
  changed.rotation_deg = rotation_between(before, after);
  changed.is_turned = changed.rotation_deg > large_rotation_deg;
  changed.creased_share = creased_share(before, after);
  changed.is_creased = changed.creased_share > large_creased_share;
  changed.displacement_rel = farthest.second / change.diagonal;
  changed.farthest_vertex = change.prepared.weld_map.first[farthest.first];
  const bool may_be_far = farthest.second > change.gap + far_in_own_diagonals * box_of_all(before.x).diagonal();
  if (!may_be_far && !is_named(changed)) return changed;
  changed.depth_rel = depths.of(number);
  changed.is_far = may_be_far && changed.depth_rel && farthest.second > change.gap + far_in_depths * *changed.depth_rel;
  if (changed.depth_rel) *changed.depth_rel /= change.diagonal;
  return changed;
}

std::string length_text(double rel, double diagonal) {
  return fmt::format("{:.2g} ({:.2g} % of the diagonal)", rel * diagonal, 100 * rel);
}

}  // namespace

std::vector<ChangedComponent> changed_components(const PreparedSurface& prepared, const Diagnosis& diagnosis,
                                                 const Positions& x, double gap, double diagonal) {
  const Change change = {prepared, diagnosis, x, triangles_by_component(prepared.triangles(), diagnosis.components),
                         gap,      diagonal};
  Depths depths(change);
  std::vector<ChangedComponent> result;
  for (Index c = 0; c < diagnosis.components.count(); ++c) {
    const std::pair<Index, double> farthest = farthest_vertex(change, c);
    if (farthest.first < 0) continue;
    const ChangedComponent changed = measured(change, c, farthest, depths);
    if (is_named(changed)) result.push_back(changed);
  }
  const auto rank = [](const ChangedComponent& changed) {
    return std::tuple(changed.has_shrunk ? changed.size_change_rel : 0, -changed.displacement_rel);
  };
  std::stable_sort(result.begin(), result.end(), [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
  return result;
}

std::string advice_on_overlaps(std::span<const OverlappingComponent> overlapping) {
  if (overlapping.empty()) return {};
  return fmt::format(
      "{} by more than {:.0f} % of {} volume: meant as one solid? unite them elsewhere; meant to pass? --allow; "
      "rigid? --rigid-component",
      overlapping.size() == 1 ? "1 part overlaps others" : fmt::format("{} parts overlap", overlapping.size()),
      100 * large_overlap_share, overlapping.size() == 1 ? "its" : "their");
}

std::string describe(const ChangedComponent& changed, double diagonal) {
  std::vector<std::string> what;
  const char* const size = changed.is_closed ? "volume" : "area";
  if (changed.has_shrunk && changed.size_change_rel < -1) what.push_back("was turned inside out");
  if (changed.has_shrunk && changed.size_change_rel >= -1)
    what.push_back(fmt::format("lost {:.2g} % of its {}", -100 * changed.size_change_rel, size));
  if (changed.is_turned) what.push_back(fmt::format("turned by {:.2g} degrees", changed.rotation_deg));
  if (changed.is_far)
    what.push_back(fmt::format("moved by {} where it overlapped by {:.2g}",
                               length_text(changed.displacement_rel, diagonal), *changed.depth_rel * diagonal));
  if (changed.is_creased)
    what.push_back(fmt::format("has new creases on {:.2g} % of its area", 100 * changed.creased_share));
  return fmt::format("component {}{} {}", changed.component, changed.name.empty() ? "" : " (" + changed.name + ")",
                     fmt::join(what, ", "));
}

}  // namespace unsnarl
