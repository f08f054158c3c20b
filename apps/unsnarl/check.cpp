#include "check.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <set>

#include "geometry/box.h"
#include "intersecting_faces.h"
#include "mesh/components.h"
#include "mesh/union_find.h"
#include "mesh_input.h"
#include "pipeline/threads.h"
#include "report/exit_code.h"
#include "report/report_json.h"
#include "scene/face_pairs.h"
#include "scene/prepared_surface.h"
#include "scene/topology.h"
#include "staged_output.h"
#include "standard_streams.h"
#include "unsnarl/version.h"
#include "usage_error.h"

namespace unsnarl::app {
namespace {

constexpr int check_schema_version = 1;
constexpr std::size_t places_in_text = 10;  // the JSON has all of them
constexpr std::size_t components_in_text = 20;

/// A group of intersecting faces that hang together, by pairs or by vertices.
struct Place {
  std::size_t pairs = 0;
  std::vector<Index> faces;
  Box box;
};

/// A component; its number in the list is what --fix-component takes.
struct ComponentFindings {
  Index first_face = 0;
  std::size_t faces = 0;
  std::size_t pairs_within = 0, pairs_with_others = 0;
  Box box;
};

/// All that `check` finds out.
struct Findings {
  std::vector<IntersectingPair> pairs;
  PairCounts counts;
  std::vector<Index> faces;   // in any pair
  std::vector<Place> places;  // most pairs first
  Topology topology;
  std::vector<ComponentFindings> components;
  std::size_t obstructed_components = 0;
  std::size_t intersecting_components = 0;
  std::size_t pairs_within_components = 0;
  std::string triangulation;
};

void extend_by_face(Box& box, const SurfaceView& surface, Index f) {
  for (const Index v : surface.face(f)) {
    const double* p = &surface.positions[3 * static_cast<std::size_t>(v)];
    box.extend(Vec3(p[0], p[1], p[2]));
  }
}

std::vector<Place> find_places(const SurfaceView& surface, const WeldMap& weld_map,
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
  std::vector<Place> places;
  for (Index f : faces) {
    Index& place = place_of[sets.find(f)];
    if (place < 0) {
      place = static_cast<Index>(places.size());
      places.emplace_back();
    }
    places[place].faces.push_back(f);
    extend_by_face(places[place].box, surface, f);
  }
  for (const IntersectingPair& pair : pairs) ++places[place_of[sets.find(pair.a)]].pairs;
  std::stable_sort(places.begin(), places.end(), [](const Place& a, const Place& b) { return a.pairs > b.pairs; });
  return places;
}

Findings examine(const SurfaceView& surface, const FindOptions& options) {
  Findings found;
  const ThreadLimit threads(options.threads);
  const PreparedSurface prepared = prepare(surface, options);
  found.pairs = FacePairFinder(prepared).find(prepared.rest);
  found.counts = count_by_class(found.pairs);
  found.faces = faces_in(found.pairs);

  const WeldMap& weld_map = prepared.weld_map;
  const Triangulation& triangulation = prepared.triangulation;
  const EdgeTable edges = build_edges(triangulation.triangles);
  const Components components = find_components(triangulation.triangles, weld_map.count, edges);
  found.triangulation = triangulation.statistics.describe();
  found.topology = describe_topology(surface, weld_map, triangulation, edges, components);
  for (const Component& component : components.list) found.obstructed_components += component.obstructed();

  std::set<Index> involved;
  const auto component_of = [&](Index f) {
    return components.component_of_vertex[weld_map.vertex_of[surface.face(f)[0]]];
  };
  found.components.resize(components.list.size());
  for (Index f = static_cast<Index>(surface.face_count()); f-- > 0;) {
    if (component_of(f) < 0) continue;
    ComponentFindings& component = found.components[component_of(f)];
    component.first_face = f;
    ++component.faces;
    extend_by_face(component.box, surface, f);
  }
  for (const IntersectingPair& pair : found.pairs) {
    const Index a = component_of(pair.a), b = component_of(pair.b);
    involved.insert({a, b});
    found.pairs_within_components += a == b;
    for (const Index c : {a, b}) found.components[c].pairs_with_others += a != b;
    if (a == b) ++found.components[a].pairs_within;
  }
  found.intersecting_components = involved.size();
  found.places = find_places(surface, weld_map, found.pairs, found.faces);
  return found;
}

nlohmann::ordered_json as_json(const Findings& found, const CheckOptions& options, const Document& document) {
  nlohmann::ordered_json json;
  json["schema"] = "unsnarl-check";
  json["schema_version"] = check_schema_version;
  json["version"] = version;
  const SurfaceView surface = document.surface();
  json["input"] = {
      {"path", options.input},         {"format", to_string(document.format())}, {"vertices", surface.vertex_count()},
      {"faces", surface.face_count()}, {"triangulation", found.triangulation},   {"notes", document.notes()}};
  json["options"] = {{"goal", to_string(options.goal_wanted())},
                     {"weld", to_string(options.find().weld)},
                     {"weld_tolerance", options.weld_tolerance}};
  json["pairs"] = pair_counts_json(found.counts);
  json["intersecting_faces"] = found.faces.size();
  json["components"] = {{"total", found.topology.components},
                        {"intersecting", found.intersecting_components},
                        {"pairs_within", found.pairs_within_components},
                        {"pairs_between", found.pairs.size() - found.pairs_within_components},
                        {"closed_non_orientable", found.obstructed_components},
                        {"list", nlohmann::ordered_json::array()}};
  for (const ComponentFindings& component : found.components)
    json["components"]["list"].push_back({{"first_face", component.first_face},
                                          {"faces", component.faces},
                                          {"pairs_within", component.pairs_within},
                                          {"pairs_with_others", component.pairs_with_others},
                                          {"min", {component.box.lo[0], component.box.lo[1], component.box.lo[2]}},
                                          {"max", {component.box.hi[0], component.box.hi[1], component.box.hi[2]}}});
  json["topology"] = topology_json(found.topology);
  json["places"] = nlohmann::ordered_json::array();
  for (const Place& place : found.places)
    json["places"].push_back({{"pairs", place.pairs},
                              {"faces", place.faces.size()},
                              {"first_face", place.faces.front()},
                              {"min", {place.box.lo[0], place.box.lo[1], place.box.lo[2]}},
                              {"max", {place.box.hi[0], place.box.hi[1], place.box.hi[2]}}});
  return json;
}

std::string counted(std::size_t number, std::string_view one, std::string_view many) {
  return fmt::format("{} {}", number, number == 1 ? one : many);
}

std::string extent(const Box& box) {
  return fmt::format("x {:.4g} to {:.4g}, y {:.4g} to {:.4g}, z {:.4g} to {:.4g}", box.lo[0], box.hi[0], box.lo[1],
                     box.hi[1], box.lo[2], box.hi[2]);
}

std::string as_text(const Findings& found, const CheckOptions& options, const Document& document) {
  const SurfaceView surface = document.surface();
  const Topology& t = found.topology;
  std::string text;
  const auto line = [&text](const std::string& words) { text += words + "\n"; };
  line(fmt::format("{}: {}, {}, {}", options.input == standard_stream ? "mesh" : options.input,
                   counted(surface.vertex_count(), "vertex", "vertices"),
                   counted(surface.face_count(), "face", "faces"), counted(t.components, "component", "components")));
  line(fmt::format("  faces:      {}", found.triangulation));
  line(fmt::format("  components: {} closed, {} non-orientable", t.closed_components, t.non_orientable_components));
  line(fmt::format("  edges:      {} on a boundary, {} non-manifold", t.boundary_edges, t.non_manifold_edges));
  const auto defect = [&](std::size_t number, std::string_view one, std::string_view many) {
    if (number > 0) line("  note:       " + counted(number, one, many));
  };
  defect(t.duplicate_vertices, "vertex counts as one with an earlier one (same position on a seam)",
         "vertices count as one with an earlier one (same position on a seam)");
  defect(t.non_manifold_vertices, "non-manifold vertex", "non-manifold vertices");
  defect(t.duplicate_faces, "face on the same three vertices as another", "faces on the same three vertices as others");
  defect(t.zero_area_faces, "face without area", "faces without area");
  defect(t.unused_vertices, "vertex of no face", "vertices of no face");
  defect(found.obstructed_components, "closed non-orientable component, which has no embedding in space",
         "closed non-orientable components, which have no embedding in space");
  if (found.components.size() > 1)
    for (std::size_t i = 0; i < std::min(found.components.size(), components_in_text); ++i) {
      const ComponentFindings& c = found.components[i];
      line(fmt::format("  component {:<3} {:>6} {:<5} {:>5} pairs within {:>5} with others; {}", i, c.faces,
                       c.faces == 1 ? "face" : "faces", c.pairs_within, c.pairs_with_others, extent(c.box)));
    }
  if (found.components.size() > components_in_text)
    line(fmt::format("  and {} more (--json lists all)", found.components.size() - components_in_text));
  if (found.pairs.empty()) {
    line("no self-intersections");
    return text;
  }
  line(fmt::format("{} of faces intersect: {} in {}; {} within a component, {} between two",
                   counted(found.pairs.size(), "pair", "pairs"), counted(found.faces.size(), "face", "faces"),
                   counted(found.intersecting_components, "component", "components"), found.pairs_within_components,
                   found.pairs.size() - found.pairs_within_components));
  for (std::size_t i = 0; i < pair_class_count; ++i)
    if (found.counts.by_class[i] > 0)
      line(fmt::format("  {:<10} {:>9}", pair_class_names[i], found.counts.by_class[i]));
  line(counted(found.places.size(), "place:", "places:"));
  for (std::size_t i = 0; i < std::min(found.places.size(), places_in_text); ++i) {
    const Place& place = found.places[i];
    line(fmt::format("  {:>5} {:<5} {:>5} {:<5} {}", place.pairs, place.pairs == 1 ? "pair" : "pairs",
                     place.faces.size(), place.faces.size() == 1 ? "face" : "faces", extent(place.box)));
  }
  if (found.places.size() > places_in_text)
    line(fmt::format("  and {} more (--json lists all)", found.places.size() - places_in_text));
  return text;
}

std::string pairs_table(const std::vector<IntersectingPair>& pairs) {
  std::string text = "face_a,face_b,class\n";
  for (const IntersectingPair& pair : pairs)
    fmt::format_to(std::back_inserter(text), "{},{},{}\n", pair.a, pair.b,
                   pair_class_names[static_cast<std::size_t>(pair.kind)]);
  return text;
}

}  // namespace

void add_check_options(CLI::App& command, CheckOptions& options) {
  add_mesh_options(command, options);
  command.add_flag("--json", options.json, "Print the findings as JSON, with every place");
  command.add_option("--pairs", options.pairs, "Write all intersecting pairs: 0-based ids of both faces, class")
      ->type_name("FILE.csv");
  command.footer(
      "Classes of pairs:\n"
      "  disjoint    the faces share no vertex\n"
      "  one_vertex  they share one vertex and meet elsewhere too\n"
      "  folded      they share an edge and overlap\n"
      "  duplicate   they have the same three vertices\n"
      "  degenerate  one of them has no area\n\n"
      "Examples:\n"
      "  unsnarl check hand.obj\n"
      "  unsnarl check hand.obj --json | jq .pairs\n"
      "  unsnarl check - --format stl < part.stl --pairs pairs.csv\n\n"
      "Exit codes: 0 none found, 1 found, 2 usage, 3 cannot read, 4 cannot write, 6 interrupted, 70 internal error.");
}

int run_check(const CheckOptions& options, Interruption& interruption) {
  const Document document = read_mesh(options.input, format_from_name(options.format));
  const Findings found = examine(document.surface(), options.find());
  if (!options.pairs.empty()) {
    if (options.pairs == standard_stream || (options.input != standard_stream && options.pairs == options.input))
      throw UsageError("--pairs needs a file of its own");
    write_file(options.pairs, pairs_table(found.pairs), interruption);
  }
  if (options.json) {
    write_to_stream(standard_stream, as_json(found, options, document).dump(2) + "\n");
  } else if (!options.quiet) {
    for (const std::string& note : document.notes()) tell("note: " + note + "\n");
    write_to_stream(standard_stream, as_text(found, options, document));
  }
  const std::size_t that_count =
      options.goal_wanted() == Goal::all ? found.counts.total() : found.counts[PairClass::disjoint];
  return that_count == 0 ? exit_embedded : exit_intersecting;
}

}  // namespace unsnarl::app
