#include "unsnarl/check.h"

#include <algorithm>
#include <set>

#include "mesh/components.h"
#include "mesh/union_find.h"
#include "pipeline/threads.h"
#include "scene/face_pairs.h"
#include "scene/prepared_surface.h"
#include "scene/topology.h"

namespace unsnarl {
namespace {

void extend_by_face(Bounds& bounds, const SurfaceView& surface, Index f) {
  for (const Index v : surface.face(f))
    for (std::size_t k = 0; k < 3; ++k) {
      const double x = surface.positions[3 * static_cast<std::size_t>(v) + k];
      bounds.min[k] = std::min(bounds.min[k], x);
      bounds.max[k] = std::max(bounds.max[k], x);
    }
}

std::vector<ConflictPlace> find_places(const SurfaceView& surface, const WeldMap& weld_map,
                                       const std::vector<IntersectingPair>& pairs, const std::vector<Index>& faces) {
  UnionFind sets(surface.face_count());
  for (const IntersectingPair& pair : pairs) sets.unite(pair.a, pair.b);
  std::vector<Index> face_at(static_cast<std::size_t>(weld_map.count), -1);
  for (Index f : faces)
    for (Index corner : surface.face(f)) {
      Index& other = face_at[weld_map.vertex_of[corner]];
      if (other >= 0) sets.unite(other, f);
      other = f;
    }
  std::vector<Index> place_of(surface.face_count(), -1);
  std::vector<ConflictPlace> places;
  for (Index f : faces) {
    Index& place = place_of[sets.find(f)];
    if (place < 0) {
      place = static_cast<Index>(places.size());
      places.emplace_back();
    }
    places[place].faces.push_back(f);
    extend_by_face(places[place].bounds, surface, f);
  }
  for (const IntersectingPair& pair : pairs) ++places[place_of[sets.find(pair.a)]].pairs;
  std::stable_sort(places.begin(), places.end(),
                   [](const ConflictPlace& a, const ConflictPlace& b) { return a.pairs > b.pairs; });
  return places;
}

void describe_components(const SurfaceView& surface, const WeldMap& weld_map, const Components& components,
                         CheckReport& found) {
  const auto component_of = [&](Index f) { return component_of_face(surface, weld_map, components, f); };
  found.components.resize(components.list.size());
  for (Index f = static_cast<Index>(surface.face_count()); f-- > 0;) {
    if (component_of(f) < 0) continue;
    ComponentFindings& component = found.components[component_of(f)];
    component.first_face = f;
    ++component.faces;
    extend_by_face(component.bounds, surface, f);
  }
  std::vector<bool> is_counted(surface.vertex_count(), false);  // a vertex is of one component only
  for (Index f = 0; f < static_cast<Index>(surface.face_count()); ++f)
    for (const Index v : surface.face(f)) {
      if (!is_counted[v]) ++found.components[component_of(f)].vertices;
      is_counted[v] = true;
    }
  std::set<Index> involved;
  for (const IntersectingPair& pair : found.pairs) {
    const Index a = component_of(pair.a), b = component_of(pair.b);
    involved.insert({a, b});
    found.pairs_within_components += a == b;
    for (const Index c : {a, b}) found.components[c].pairs_with_others += a != b;
    if (a == b) ++found.components[a].pairs_within;
  }
  found.intersecting_components = involved.size();
  for (const Component& component : components.list) found.closed_non_orientable += component.obstructed();
}

}  // namespace

CheckReport check(const SurfaceView& surface, const FindOptions& options) {
  CheckReport found;
  const ThreadLimit threads(options.threads);
  const PreparedSurface prepared = prepare(surface, options);
  found.pairs = FacePairFinder(prepared).find(prepared.rest);
  found.counts = count_by_class(found.pairs);
  found.faces = intersecting_faces(found.pairs);
  found.triangulation = prepared.triangulation.statistics.describe();
  const EdgeTable edges = build_edges(prepared.triangles());
  const Components components = find_components(surface, prepared.weld_map, prepared.triangles(), edges);
  found.topology = describe_topology(surface, prepared.weld_map, prepared.triangulation, edges, components);
  describe_components(surface, prepared.weld_map, components, found);
  found.places = find_places(surface, prepared.weld_map, found.pairs, found.faces);
  return found;
}

}  // namespace unsnarl
