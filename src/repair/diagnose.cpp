#include "repair/diagnose.h"

#include <algorithm>
#include <string>
#include <utility>

namespace unsnarl {
namespace {

bool all_fixed(const Triangle& t, std::span<const std::uint8_t> fixed) {
  return !fixed.empty() && fixed[t[0]] && fixed[t[1]] && fixed[t[2]];
}

void add_unique_sorted(std::vector<std::int32_t>& faces) {
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
}

}  // namespace

Diagnosis diagnose(const SurfaceView& surface, const PreparedSurface& prepared, std::span<const std::uint8_t> fixed,
                   IntersectionFinder& finder) {
  Diagnosis result;
  const std::span<const Triangle> triangles = prepared.triangles();
  const std::vector<Index>& polygon = prepared.triangulation.polygon;
  EdgeTable edges = build_edges(triangles);
  result.components = find_components(triangles, prepared.identification.count, edges);
  result.topology =
      describe_topology(surface, prepared.identification, prepared.triangulation, edges, result.components);
  result.edges = std::move(edges.edges);
  result.pairs = finder.find(prepared.rest);

  const std::vector<Index>& component_of = result.components.component_of_triangle;
  for (Index c = 0; c < result.components.count(); ++c) {
    const Component& component = result.components.list[c];
    if (!component.obstructed()) continue;
    const Index face = polygon[component.first_triangle];
    result.obstructions.push_back(
        {Obstruction::Kind::closed_non_orientable,
         {face},
         "the component of face " + std::to_string(face) + " (" + std::to_string(component.triangles) +
             " triangles) is closed and non-orientable: no such surface can be embedded in space"});
  }
  std::vector<std::int32_t> fixed_faces;
  std::vector<std::vector<Index>> duplicates;
  if (result.topology.duplicate_faces > 0) duplicates = duplicate_triangles(triangles);
  for (const std::vector<Index>& group : duplicates) {
    Obstruction obstruction{Obstruction::Kind::duplicate_faces, {}, {}};
    for (Index t : group) obstruction.faces.push_back(polygon[t]);
    std::string list;
    for (Index face : obstruction.faces) list += (list.empty() ? "" : ", ") + std::to_string(face);
    obstruction.message = "faces " + list + " lie on the same three vertices: moving vertices cannot part them";
    result.obstructions.push_back(std::move(obstruction));
  }
  for (const IntersectingPair& pair : result.pairs) {
    const Index component = component_of[pair.a];
    const bool both_fixed = all_fixed(triangles[pair.a], fixed) && all_fixed(triangles[pair.b], fixed);
    const bool non_orientable = component == component_of[pair.b] && result.components.list[component].obstructed();
    if (both_fixed) fixed_faces.insert(fixed_faces.end(), {polygon[pair.a], polygon[pair.b]});
    if (both_fixed || non_orientable || pair.kind == PairClass::duplicate) result.obstructed.push_back(pair);
  }
  if (!fixed_faces.empty()) {
    add_unique_sorted(fixed_faces);
    const std::string count = std::to_string(fixed_faces.size());
    result.obstructions.push_back({Obstruction::Kind::fixed_faces, std::move(fixed_faces),
                                   count + " faces with all vertices fixed intersect each other"});
  }
  return result;
}

}  // namespace unsnarl
