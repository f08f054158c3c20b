#include "scene/diagnose.h"

#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "geometry/sort_unique.h"
#include "scene/topology.h"

namespace unsnarl {
namespace {

/// `faces`: of triangles on the same three vertices, each face once.
std::string message_of_duplicates(std::span<const std::int32_t> faces) {
  if (faces.size() == 1)
    return "face " + std::to_string(faces[0]) +
           " lies on the same three vertices more than once: moving vertices cannot separate its pieces";
  std::string list;
  for (const std::int32_t face : faces) list += (list.empty() ? "" : ", ") + std::to_string(face);
  return "faces " + list + " lie on the same three vertices: moving vertices cannot separate them";
}

/// Faces that intersect in what is held of them, and the rigid parts of the latter; with repetitions.
struct ObstructedFaces {
  std::vector<std::int32_t> fixed, rigid;
  std::vector<Index> parts;
};

/// Any two of these triangles may pass through each other.
bool all_pass(const PreparedSurface& prepared, std::span<const Index> triangles) {
  const Passing passing = prepared.passing();
  for (const Index t : triangles)
    for (const Index u : triangles)
      if (t != u && passing.meet(prepared.triangles(), t, u)) return false;
  return passing.has_parts();
}

/// Two triangles of the component of each part, or one, which stand for all of it: what passes depends on parts alone.
std::vector<Index> two_of_each_part(const PreparedSurface& prepared, const Components& components, Index component) {
  std::map<Index, int> count;
  std::vector<Index> triangles;
  for (Index t = 0; t < static_cast<Index>(prepared.part_of.size()); ++t)
    if (components.component_of_triangle[t] == component && ++count[prepared.part_of[t]] <= 2) triangles.push_back(t);
  return triangles;
}

void name_components_without_embedding(const PreparedSurface& prepared, Diagnosis& diagnosis) {
  for (Index c = 0; c < diagnosis.components.count(); ++c) {
    const Component& component = diagnosis.components.list[c];
    if (!component.obstructed() || all_pass(prepared, two_of_each_part(prepared, diagnosis.components, c))) continue;
    const Index face = prepared.triangulation.polygon[component.first_triangle];
    diagnosis.obstructions.push_back(
        {Obstruction::Kind::closed_non_orientable,
         {face},
         "the component of face " + std::to_string(face) + " (" + std::to_string(component.triangles) +
             " triangles) is closed and non-orientable: no such surface can be embedded in space"});
  }
}

void name_duplicates(const PreparedSurface& prepared, Diagnosis& diagnosis) {
  if (diagnosis.topology.duplicate_faces == 0) return;
  for (const std::vector<Index>& group : duplicate_triangles(prepared.triangles())) {
    if (all_pass(prepared, group)) continue;
    Obstruction obstruction{Obstruction::Kind::duplicate_faces, {}, {}};
    for (const Index t : group) obstruction.faces.push_back(prepared.triangulation.polygon[t]);
    sort_unique(obstruction.faces);
    obstruction.message = message_of_duplicates(obstruction.faces);
    diagnosis.obstructions.push_back(std::move(obstruction));
  }
}

void name_held_faces(const PairPolicy& policy, ObstructedFaces obstructed, Diagnosis& diagnosis) {
  sort_unique(obstructed.fixed);
  sort_unique(obstructed.rigid);
  sort_unique(obstructed.parts);
  const std::string fixed = std::to_string(obstructed.fixed.size()), rigid = std::to_string(obstructed.rigid.size());
  if (!obstructed.fixed.empty())
    diagnosis.obstructions.push_back({Obstruction::Kind::fixed_faces, std::move(obstructed.fixed),
                                      fixed + " faces intersect inside parts that you told unsnarl to keep fixed"});
  if (obstructed.rigid.empty()) return;
  std::string names;
  for (const Index part : obstructed.parts) names += (names.empty() ? "" : ", ") + policy.rigid_parts().name(part);
  diagnosis.obstructions.push_back(
      {Obstruction::Kind::rigid_faces, std::move(obstructed.rigid),
       rigid + " faces of rigid parts intersect others of the same part (" + names + "), which moves as it is"});
}

void name_obstructions(const PreparedSurface& prepared, const PairPolicy& policy, ObstructedFaces obstructed,
                       Diagnosis& diagnosis) {
  name_components_without_embedding(prepared, diagnosis);
  name_duplicates(prepared, diagnosis);
  name_held_faces(policy, std::move(obstructed), diagnosis);
}

}  // namespace

Diagnosis diagnose_topology(const SurfaceView& surface, const PreparedSurface& prepared) {
  Diagnosis result;
  const std::span<const Triangle> triangles = prepared.triangles();
  EdgeTable edges = build_edges(triangles);
  result.components = find_components(surface, prepared.weld_map, triangles, edges);
  result.topology = describe_topology(surface, prepared.weld_map, prepared.triangulation, edges, result.components);
  result.edges = std::move(edges.edges);
  return result;
}

void diagnose_intersections(const PreparedSurface& prepared, const PairPolicy& policy, IntersectionFinder& finder,
                            Diagnosis& diagnosis, const std::function<bool()>& stop) {
  diagnosis.pairs = finder.find(prepared.rest, stop);
  ObstructedFaces obstructed;
  for (const IntersectingPair& pair : diagnosis.pairs) {
    const Triangle &a = prepared.triangles()[pair.a], &b = prepared.triangles()[pair.b];
    const std::optional<LeftReason> reason = policy.reason_to_leave(a, b, pair.kind);
    if (!reason || !is_obstruction(*reason)) continue;
    diagnosis.obstructed.push_back(pair);
    const std::array<Index, 2> faces = {prepared.triangulation.polygon[pair.a], prepared.triangulation.polygon[pair.b]};
    if (*reason == LeftReason::fixed_faces) obstructed.fixed.insert(obstructed.fixed.end(), faces.begin(), faces.end());
    if (*reason != LeftReason::rigid_faces) continue;
    obstructed.rigid.insert(obstructed.rigid.end(), faces.begin(), faces.end());
    obstructed.parts.push_back(policy.rigid_part_that_meets_itself(a, b));
  }
  name_obstructions(prepared, policy, std::move(obstructed), diagnosis);
}

Diagnosis diagnose(const SurfaceView& surface, const PreparedSurface& prepared, std::span<const std::uint8_t> fixed,
                   IntersectionFinder& finder, const std::function<bool()>& stop) {
  Diagnosis result = diagnose_topology(surface, prepared);
  PairPolicy policy(result.components, Goal::all, false);
  policy.hold(fixed, prepared.rest);
  diagnose_intersections(prepared, policy, finder, result, stop);
  return result;
}

}  // namespace unsnarl
