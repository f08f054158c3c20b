#include "scene/diagnose.h"

#include <algorithm>
#include <string>
#include <utility>

#include "geometry/sort_unique.h"
#include "scene/topology.h"

namespace unsnarl {
namespace {

/// The span of a triangle's fixed vertices, as a triangle that uses some of them twice; none: nothing is fixed.
std::optional<Triangle> fixed_part(const Triangle& t, std::span<const std::uint8_t> fixed) {
  std::optional<Triangle> part;
  int count = 0;
  for (Index v : t) {
    if (fixed.empty() || !fixed[v]) continue;
    if (!part) part = Triangle{v, v, v};
    std::fill(part->begin() + count++, part->end(), v);
  }
  return part;
}

/// `faces`: of triangles on the same three vertices, each face once.
std::string message_of_duplicates(std::span<const std::int32_t> faces) {
  if (faces.size() == 1)
    return "face " + std::to_string(faces[0]) +
           " lies on the same three vertices more than once: moving vertices cannot separate its pieces";
  std::string list;
  for (const std::int32_t face : faces) list += (list.empty() ? "" : ", ") + std::to_string(face);
  return "faces " + list + " lie on the same three vertices: moving vertices cannot separate them";
}

}  // namespace

bool fixed_parts_meet(const Positions& rest, std::span<const std::uint8_t> fixed, const Triangle& first,
                      const Triangle& second) {
  const std::optional<Triangle> a = fixed_part(first, fixed), b = fixed_part(second, fixed);
  PairClass kind;
  return a && b && intersects(rest, *a, *b, kind);
}

std::optional<Obstruction::Kind> obstruction_of(const PreparedSurface& prepared, const Components& components,
                                                std::span<const std::uint8_t> fixed, const IntersectingPair& pair) {
  if (!are_of_two_components(components, pair) &&
      components.list[components.component_of_triangle[pair.a]].obstructed())
    return Obstruction::Kind::closed_non_orientable;
  if (pair.kind == PairClass::duplicate) return Obstruction::Kind::duplicate_faces;
  if (fixed_parts_meet(prepared.rest, fixed, prepared.triangles()[pair.a], prepared.triangles()[pair.b]))
    return Obstruction::Kind::fixed_faces;
  return std::nullopt;
}

Diagnosis diagnose_topology(const SurfaceView& surface, const PreparedSurface& prepared) {
  Diagnosis result;
  const std::span<const Triangle> triangles = prepared.triangles();
  EdgeTable edges = build_edges(triangles);
  result.components = find_components(surface, prepared.weld_map, triangles, edges);
  result.topology = describe_topology(surface, prepared.weld_map, prepared.triangulation, edges, result.components);
  result.edges = std::move(edges.edges);
  return result;
}

void diagnose_intersections(const PreparedSurface& prepared, std::span<const std::uint8_t> fixed,
                            IntersectionFinder& finder, Diagnosis& diagnosis, const std::function<bool()>& stop) {
  const std::span<const Triangle> triangles = prepared.triangles();
  const std::vector<Index>& polygon = prepared.triangulation.polygon;
  diagnosis.pairs = finder.find(prepared.rest, stop);

  diagnosis.fixed.assign(fixed.begin(), fixed.end());

  for (Index c = 0; c < diagnosis.components.count(); ++c) {
    const Component& component = diagnosis.components.list[c];
    if (!component.obstructed()) continue;
    const Index face = polygon[component.first_triangle];
    diagnosis.obstructions.push_back(
        {Obstruction::Kind::closed_non_orientable,
         {face},
         "the component of face " + std::to_string(face) + " (" + std::to_string(component.triangles) +
             " triangles) is closed and non-orientable: no such surface can be embedded in space"});
  }
  std::vector<std::int32_t> fixed_faces;
  std::vector<std::vector<Index>> duplicates;
  if (diagnosis.topology.duplicate_faces > 0) duplicates = duplicate_triangles(triangles);
  for (const std::vector<Index>& group : duplicates) {
    Obstruction obstruction{Obstruction::Kind::duplicate_faces, {}, {}};
    for (Index t : group) obstruction.faces.push_back(polygon[t]);
    sort_unique(obstruction.faces);
    obstruction.message = message_of_duplicates(obstruction.faces);
    diagnosis.obstructions.push_back(std::move(obstruction));
  }
  for (const IntersectingPair& pair : diagnosis.pairs) {
    const std::optional<Obstruction::Kind> kind = obstruction_of(prepared, diagnosis.components, fixed, pair);
    if (!kind) continue;
    diagnosis.obstructed.push_back(pair);
    if (*kind == Obstruction::Kind::fixed_faces)
      fixed_faces.insert(fixed_faces.end(), {polygon[pair.a], polygon[pair.b]});
  }
  if (!fixed_faces.empty()) {
    sort_unique(fixed_faces);
    const std::string count = std::to_string(fixed_faces.size());
    diagnosis.obstructions.push_back({Obstruction::Kind::fixed_faces, std::move(fixed_faces),
                                      count + " faces intersect each other in what is fixed of them"});
  }
}

Diagnosis diagnose(const SurfaceView& surface, const PreparedSurface& prepared, std::span<const std::uint8_t> fixed,
                   IntersectionFinder& finder, const std::function<bool()>& stop) {
  Diagnosis result = diagnose_topology(surface, prepared);
  diagnose_intersections(prepared, fixed, finder, result, stop);
  return result;
}

}  // namespace unsnarl
