#include "check.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <new>

#include "file_places.h"
#include "gap_words.h"
#include "memory_guard.h"
#include "mesh_input.h"
#include "pair_class_words.h"
#include "progress.h"
#include "staged_output.h"
#include "standard_streams.h"
#include "unsnarl/check.h"
#include "unsnarl/clearance.h"
#include "unsnarl/exit_code.h"
#include "unsnarl/parts.h"
#include "unsnarl/report_json.h"
#include "unsnarl/visible_text.h"
#include "usage_error.h"

namespace unsnarl::app {
namespace {

constexpr std::size_t places_in_text = 10;  // the JSON has all of them
constexpr std::size_t components_in_text = 20;
constexpr std::size_t parts_in_text = 20;  // of each kind

std::string counted(std::size_t number, std::string_view one, std::string_view many) {
  return fmt::format("{} {}", number, number == 1 ? one : many);
}

std::string extent(const Bounds& box) {
  return fmt::format("x {:.4g} to {:.4g}, y {:.4g} to {:.4g}, z {:.4g} to {:.4g}", box.min[0], box.max[0], box.min[1],
                     box.max[1], box.min[2], box.max[2]);
}

/// A line for each part that the file names, by what --fix-object and the like call it.
std::string list_of_parts(const std::vector<NamedPart>& parts) {
  std::map<NamedPart::Kind, std::size_t> listed;
  std::string text;
  for (const NamedPart& part : parts)
    if (++listed[part.kind] <= parts_in_text)
      text += fmt::format("  {} {}: {}, {}\n", to_string(part.kind), visible_text(part.name),
                          counted(part.faces, "face", "faces"), counted(part.vertices, "vertex", "vertices"));
  for (const auto& [kind, count] : listed)
    if (count > parts_in_text)
      text += fmt::format("  and {} more {}s (--json lists all)\n", count - parts_in_text, to_string(kind));
  return text;
}

std::string as_text(const CheckReport& found, const CheckOptions& options, const SceneDocument& scene,
                    const ReportFiles& files) {
  const SceneReport& by_file = files.scene;
  const SurfaceView surface = scene.surface();
  const Topology& t = found.topology;
  std::string text;
  const auto line = [&text](const std::string& words) { text += visible_text(words) + "\n"; };
  const std::string& input = options.inputs[0];
  line(fmt::format("{}: {}, {}, {}",
                   options.is_scene()         ? fmt::format("{} files", options.inputs.size())
                   : input == standard_stream ? "mesh"
                                              : input,
                   counted(surface.vertex_count(), "vertex", "vertices"),
                   counted(surface.face_count(), "face", "faces"), counted(t.components, "component", "components")));
  for (const SceneFileReport& file : by_file.files)
    line(fmt::format("  file {}: {}, {}", file.file.name, counted(file.file.vertices, "vertex", "vertices"),
                     counted(file.file.faces, "face", "faces")));
  line(fmt::format("  faces:      {}", found.triangulation));
  text += list_of_parts(files.parts);
  line(fmt::format("  components: {} closed, {} non-orientable", t.closed_components, t.non_orientable_components));
  line(fmt::format("  edges:      {} on a boundary, {} non-manifold", t.boundary_edges, t.non_manifold_edges));
  const auto defect = [&](std::size_t number, std::string_view one, std::string_view many) {
    if (number > 0) line("  note:       " + counted(number, one, many));
  };
  defect(t.duplicate_vertices, "vertex welded to an earlier one (same position on a seam)",
         "vertices welded to an earlier one (same position on a seam)");
  defect(t.non_manifold_vertices, "non-manifold vertex", "non-manifold vertices");
  defect(t.duplicate_faces, "face on the same three vertices as another", "faces on the same three vertices as others");
  defect(t.zero_area_faces, "face without area", "faces without area");
  defect(t.unused_vertices, "vertex of no face", "vertices of no face");
  defect(found.closed_non_orientable, "closed non-orientable component, which always intersects itself",
         "closed non-orientable components, which always intersect themselves");
  if (found.components.size() > 1)
    for (std::size_t i = 0; i < std::min(found.components.size(), components_in_text); ++i) {
      const ComponentFindings& c = found.components[i];
      line(fmt::format("  component {:<3} {:>6} {:<5} {:>6} {:<8} {:>5} {:<5} within {:>5} with others; {}", i, c.faces,
                       c.faces == 1 ? "face" : "faces", c.vertices, c.vertices == 1 ? "vertex" : "vertices",
                       c.pairs_within, c.pairs_within == 1 ? "pair" : "pairs", c.pairs_with_others, extent(c.bounds)));
    }
  if (found.components.size() > components_in_text)
    line(fmt::format("  and {} more (--json lists all)", found.components.size() - components_in_text));
  if (!options.allow.empty())
    line(counted(found.allowed.total(), "pair of faces intersects that may", "pairs of faces intersect that may") +
         " (--allow)");
  if (found.counts.total() == 0) {
    line(found.allowed.total() > 0 ? "no other self-intersections" : "no self-intersections");
    if (found.gap) line(gap_in_words(*found.gap, diagonal_of(surface)));
    return text;
  }
  line(fmt::format("{}: {} in {}; {} within a component, {} between two",
                   counted(found.counts.total(), "pair of faces intersects", "pairs of faces intersect"),
                   counted(found.faces.size(), "face", "faces"),
                   counted(found.intersecting_components, "component", "components"), found.pairs_within_components,
                   found.counts.total() - found.pairs_within_components));
  for (std::size_t i = 0; i < pair_class_count; ++i)
    if (found.counts.by_class[i] > 0)
      line(fmt::format("  {:>10} {} ({})", found.counts.by_class[i], pair_class_words[i], pair_class_names[i]));
  for (const ScenePairs& pairs : by_file.pairs) {
    if (pairs.before.total() == 0) continue;
    const std::string &a = by_file.files[pairs.a].file.name, &b = by_file.files[pairs.b].file.name;
    line(fmt::format("  {:>10} {}", pairs.before.total(),
                     pairs.a == pairs.b ? "within " + a : fmt::format("between {} and {}", a, b)));
  }
  if (!found.overlapping_components.empty()) line("advice: " + advice_on_overlaps(found.overlapping_components));
  line(counted(found.places.size(), "place:", "places:"));
  for (std::size_t i = 0; i < std::min(found.places.size(), places_in_text); ++i) {
    const ConflictPlace& place = found.places[i];
    line(fmt::format("  {:>5} {:<5} {:>5} {:<5} {}", place.pairs, place.pairs == 1 ? "pair" : "pairs",
                     place.faces.size(), place.faces.size() == 1 ? "face" : "faces", extent(place.bounds)));
  }
  if (found.places.size() > places_in_text)
    line(fmt::format("  and {} more (--json lists all)", found.places.size() - places_in_text));
  return text;
}

/// Components by the names that the files give to their faces.
void name_components(const SceneDocument& scene, CheckReport& found) {
  for (OverlappingComponent& component : found.overlapping_components)
    component.name = part_of_face(scene.face_labels(), component.first_face);
}

ReportFiles described(const CheckOptions& options, const SceneDocument& scene, const CheckReport& found) {
  ReportFiles files;
  files.vertices = scene.surface().view().vertex_count();
  files.faces = scene.surface().view().face_count();
  files.notes = scene.notes();
  files.parts = named_parts(scene.surface(), scene.face_labels());
  if (!options.is_scene()) {
    files.input = options.inputs[0];
    files.format = to_string(scene.document(0).format());
    return files;
  }
  files.scene = scene_report(scene.surface(), scene.files(), found.pairs);
  count_allowed_pairs(found.allowed_pairs, {}, files.scene);
  for (std::size_t i = 0; i < options.inputs.size(); ++i) {
    files.scene.files[i].input = options.inputs[i];
    files.scene.files[i].format = to_string(scene.document(i).format());
  }
  return files;
}

std::string pairs_table(const std::vector<IntersectingPair>& pairs) {
  std::string text = "face_a,face_b,class\n";
  for (const IntersectingPair& pair : pairs)
    fmt::format_to(std::back_inserter(text), "{},{},{}\n", pair.a, pair.b,
                   pair_class_names[static_cast<std::size_t>(pair.kind)]);
  return text;
}

/// Pairs are listed for who writes them, or tells the files of a scene by them.
CheckLimits limits_of(const CheckOptions& options) {
  CheckLimits limits{.time_limit_s = options.time_limit_s, .memory_limit_mb = options.memory_limit_mb};
  if (options.pairs.empty() && !options.is_scene()) limits.pairs_listed = 0;
  return limits;
}

GapReport measured(const CheckOptions& options, const FindOptions& find, const SurfaceView& surface) {
  const double diagonal = diagonal_of(surface);
  return measure_gap(surface, options.absolute && diagonal > 0 ? options.min_gap / diagonal : options.min_gap, find);
}

int checked(const CheckOptions& options, Interruption& interruption) {
  if (options.pairs == standard_stream) throw UsageError("--pairs needs a file name, not '-'");
  const MemoryGuard memory_guard(options.memory_limit_mb);
  ProgressDisplay display("auto", options.quiet);
  display.begin("read");
  const SceneDocument scene = read_inputs(options.inputs, format_from_name(options.format));
  FilePlaces places;
  claim_inputs(places, "the input", options.inputs, scene);
  places.writes("--pairs", options.pairs);
  places.require_writable(interruption);
  display.begin("find");
  const FindOptions find = options.find_in(scene);
  CheckReport found = check(scene.surface(), find, limits_of(options));
  name_components(scene, found);
  if (options.min_gap > 0 && found.counts.total() == 0) found.gap = measured(options, find, scene.surface());
  const ReportFiles files = described(options, scene, found);
  display.clear();
  if (!options.pairs.empty()) write_file(options.pairs, pairs_table(found.pairs), interruption);
  if (options.json) {
    write_to_stream(standard_stream, check_json(found, options.goal_wanted(), find, files) + "\n");
  } else if (!options.quiet) {
    for (const std::string& note : scene.notes()) tell("note: " + visible_text(note) + "\n");
    write_to_stream(standard_stream, as_text(found, options, scene, files));
  }
  const auto is_any = [&](const PairCounts& pairs) {
    return (options.goal_wanted() == Goal::all ? pairs.total() : pairs[PairClass::disjoint]) > 0;
  };
  if (is_any(found.counts)) return exit_intersecting;
  if (is_any(found.allowed)) return exit_allowed;
  return found.gap && !found.gap->is_met() ? exit_gap_not_met : exit_embedded;
}

}  // namespace

void add_check_options(CLI::App& command, CheckOptions& options) {
  add_inputs(command, options);
  command.add_flag("--json", options.json, "Print the result as JSON, with every place where faces intersect");
  command
      .add_option("--pairs", options.pairs,
                  "Write all intersecting pairs of faces: the ids of both, counted from 0, and the class")
      ->type_name("FILE.csv");
  command
      .add_option("--min-gap", options.min_gap,
                  "Find the smallest gap between surfaces, and say whether it is at least this, a fraction of the "
                  "bounding-box diagonal. 0 (default): no gap is looked for")
      ->check(not_negative(unit::share_or_length))
      ->type_name("NUMBER");
  command.add_flag("--absolute", options.absolute, "--min-gap is a length in the units of the file");
  add_time_limit(command, options.time_limit_s);
  add_memory_limit(command, options.memory_limit_mb);
  add_mesh_options(command, options);
  add_allow(command, options.allow, options_of_reading);
  command.final_callback([&command, &options] {
    options.require_effect();
    if (options.absolute && command.count("--min-gap") == 0)
      throw UsageError("--absolute has an effect only with --min-gap; add it, or leave --absolute out");
  });
  command.footer(std::string("Classes of pairs:\n"
                             "  disjoint    the faces share no vertex\n"
                             "  one_vertex  they share one vertex, and meet elsewhere too\n"
                             "  folded      they share an edge and overlap\n"
                             "  duplicate   they have the same three vertices\n"
                             "  degenerate  one of them has no area\n\n"
                             "Examples:\n"
                             "  unsnarl check hand.obj\n"
                             "  # within and between three files\n"
                             "  unsnarl check brain.surf skull.gii skin.obj\n"
                             "  unsnarl check hand.obj --json | jq .pairs\n"
                             "  unsnarl check - --format stl < part.stl --pairs pairs.csv\n\n") +
                 exit_codes({{exit_embedded, "no self-intersections"},
                             {exit_intersecting, "self-intersections found"},
                             {exit_limit, "limit of time or memory reached"},
                             {exit_allowed, "only pairs that --allow lets pass intersect"},
                             {exit_gap_not_met, "no self-intersections, but a gap is smaller than --min-gap asks"}}));
}

int run_check(const CheckOptions& options, Interruption& interruption) {
  try {
    return checked(options, interruption);
  } catch (const std::bad_alloc&) {
    if (options.memory_limit_mb <= 0) throw;
    throw LimitReached(Status::memory_limit);
  }
}

}  // namespace unsnarl::app
