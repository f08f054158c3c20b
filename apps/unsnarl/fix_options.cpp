#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "fix.h"
#include "mesh_input.h"
#include "paper_options.h"
#include "pictures.h"
#include "usage_error.h"

namespace unsnarl::app {
namespace {

/// Enough to follow what happens; a recording stays small.
constexpr int recorded_frames = 100;

/// One flag a face: belongs to one of `parts`, whose options begin with `prefix`. Throws UsageError, naming the option.
std::vector<std::uint8_t> faces_named(const Parts& parts, const std::string& prefix, const FixOptions& options,
                                      const SceneDocument& scene) {
  std::vector<std::uint8_t> faces(scene.surface().view().face_count(), 0);
  const auto add = [&](const char* kind, const Parts& of_kind) {
    try {
      const auto more = faces_in_parts(scene.surface(), scene.face_labels(), of_kind, options.find());
      for (std::size_t f = 0; f < faces.size(); ++f) faces[f] |= more[f];
    } catch (const UnknownPart& e) {
      throw UsageError(fmt::format("{}{}: {}", prefix, kind, e.what()));
    }
  };
  if (!parts.files.empty() && scene.files().size() == 1)
    throw UsageError(
        fmt::format("{0}file tells several files apart; of one, name parts with {0}object and its like", prefix));
  add("group", {.groups = parts.groups});
  add("object", {.objects = parts.objects});
  add("material", {.materials = parts.materials});
  add("component", {.components = parts.components});
  add("file", {.files = parts.files});
  return faces;
}

/// One flag a vertex; empty: all may move.
std::vector<std::uint8_t> fixed_vertices(const FixOptions& options, const SceneDocument& scene) {
  const SurfaceView surface = scene.surface();
  std::vector<std::uint8_t> fixed;
  const auto add = [&fixed](std::vector<std::uint8_t> more) {
    if (fixed.empty()) fixed.resize(more.size(), 0);
    for (std::size_t v = 0; v < more.size(); ++v) fixed[v] |= more[v];
  };
  if (!options.fix_vertices.empty()) add(read_vertex_flags(options.fix_vertices, surface.vertex_count()));
  if (!options.fix.empty()) add(vertices_of_faces(surface, faces_named(options.fix, "--fix-", options, scene)));
  if (!options.only.empty()) {
    // Nothing else may change, so a vertex that a face outside uses too stays.
    std::vector<std::uint8_t> outside = faces_named(options.only, "--only-", options, scene);
    for (std::uint8_t& face : outside) face = !face;
    add(vertices_of_faces(surface, outside));
  }
  if (options.fix_boundary) add(boundary_vertices(surface, options.find()));
  return fixed;
}

/// Which vertices move as bodies: each name is one. `result` knows already what is fixed.
void set_rigid_parts(const FixOptions& options, const SceneDocument& scene, RepairOptions& result) {
  const SurfaceView surface = scene.surface();
  if (!options.rigid.empty() && options.each)
    throw UsageError(
        "--each repairs every component as if it were alone, --rigid moves parts among the others; leave "
        "one of the two out");
  const auto add = [&](const std::string& name, const Parts& parts) {
    const auto flags = vertices_of_faces(surface, faces_named(parts, "--rigid-", options, scene));
    result.rigid.resize(flags.size(), -1);
    const auto part = static_cast<std::int32_t>(result.rigid_names.size());
    result.rigid_names.push_back(name);
    for (std::size_t v = 0; v < flags.size(); ++v) {
      if (!flags[v]) continue;
      if (result.rigid[v] >= 0)
        throw UsageError(
            fmt::format("--rigid: '{}' and '{}' have vertex {} in common; name them as one part, or leave "
                        "one of them out",
                        result.rigid_names[result.rigid[v]], name, v));
      if (!result.fixed.empty() && result.fixed[v])
        throw UsageError(
            fmt::format("--rigid: '{}' is held, at vertex {} at least, by --fix-... or --only-..., and "
                        "cannot move as a body; leave one of the two out",
                        name, v));
      result.rigid[v] = part;
    }
  };
  for (const std::string& name : options.rigid.groups) add(name, {.groups = {name}});
  for (const std::string& name : options.rigid.objects) add(name, {.objects = {name}});
  for (const std::string& name : options.rigid.materials) add(name, {.materials = {name}});
  for (const std::int32_t number : options.rigid.components)
    add(fmt::format("component {}", number), {.components = {number}});
  for (const std::string& name : options.rigid.files) add(name, {.files = {name}});
}

void add_parts(CLI::App& command, const std::string& prefix, Parts& parts, const std::string& what,
               const std::string& group, const std::string& shortcut = "") {
  const auto named = [&](const std::string& name, auto& list, const std::string& of, const char* type) {
    // One value each time: more would swallow the name of the input.
    const bool has_shortcut = !shortcut.empty() && name == "object";
    return command.add_option((has_shortcut ? shortcut + "," : "") + prefix + name, list, what + of)
        ->type_name(type)
        ->group(group)
        ->allow_extra_args(false);
  };
  named("group", parts.groups,
        "faces of this group (OBJ g, glTF mesh, Gmsh physical group, Abaqus ELSET); may be repeated", "NAME");
  named("object", parts.objects,
        "faces of this object (OBJ o, STL solid, glTF node, Gmsh entity, Abaqus part, 3MF object); may be repeated",
        "NAME");
  named("material", parts.materials, "faces of this material; may be repeated", "NAME");
  named("component", parts.components, "component of this number, as 'unsnarl check' lists them; may be repeated", "N")
      ->check(whole_number_within(0, std::numeric_limits<std::int32_t>::max()));
  named("file", parts.files, "file of this name, of several; may be repeated", "NAME");
}

}  // namespace

void add_fix_options(CLI::App& command, FixOptions& options) {
  add_mesh_options(command, options);
  command.final_callback([&command, &options] {
    options.require_effect();
    if (options.absolute && command.count("--max-displacement") + command.count("--min-gap") == 0)
      throw UsageError("--absolute is about --max-displacement and --min-gap; give one of them, or leave it out");
  });
  command
      .add_option("-o,--output", options.output,
                  "Where the repaired mesh goes; '-' for standard output. Of several files: the folder where they\n"
                  "go under their names, all or none")
      ->type_name("OUT");
  command.add_flag("--in-place", options.in_place, "Overwrite IN with the repaired mesh");
  CLI::Option* const keep_partial = command.add_flag(
      "--keep-partial", options.keep_partial,
      "Write the result to OUT also where self-intersections are left or a limit was reached. Default:\n"
      "it goes to OUT.partial.EXT beside it, and OUT is not written");
  command.add_flag("--no-partial", options.no_partial, "Write no OUT.partial.EXT")->excludes(keep_partial);
  command.add_flag(
      "--recompute-normals", options.recompute_normals,
      "Turn stored vertex normals (OBJ vn, PLY nx ny nz, glTF) with the faces that moved; else they stay as\n"
      "they are. Facet normals in STL always follow");
  const std::string frames = "Sequences";
  CLI::Option* const sequence =
      command
          .add_flag(
              "--sequence", options.sequence,
              "IN are the frames of a moving mesh: numbered files of the same faces, or patterns of them in\n"
              "quotes; or a mesh and a point cache (PC2, MDD). Corrections go on smoothly in time. They go to the\n"
              "folder of -o; a call that was interrupted goes on from there")
          ->group(frames);
  command.add_option("--frames", options.frames, "Only these, counted from 0, LAST excluded; either may be left out")
      ->type_name("FIRST:LAST")
      ->needs(sequence)
      ->group(frames);
  const std::string what = "What may move";
  command
      .add_option("--fix-vertices", options.fix_vertices, "File with the 0-based ids of vertices that must not move")
      ->type_name("FILE")
      ->group(what);
  add_parts(command, "--fix-", options.fix, "Do not move the ", what);
  command.add_flag("--fix-boundary", options.fix_boundary, "Do not move vertices on a boundary")->group(what);
  CLI::Option* each =
      command.add_flag("--each", options.each,
                       "Repair every component as if it were alone. Where two run through each other they may go on\n"
                       "doing so: this is reported as 'obstructed' (exit code 7), and the result is written");
  command.add_flag("--together", options.together, "Repair the scene: components too are separated (default)")
      ->excludes(each)
      ->group(what);
  each->group(what);
  add_parts(command, "--only-", options.only, "Leave all as it is but the ", what);
  command
      .add_option("--nested", options.nested,
                  "Which surfaces lie inside which: names of files, or of one file's objects, from the innermost out.\n"
                  "Where two cross, the inner one goes in and the outer one out, also where the other way is shorter.\n"
                  "All but the first have to be closed; may be repeated")
      ->type_name("NAME,NAME,...")
      ->group(what)
      ->allow_extra_args(false);
  add_parts(command, "--rigid-", options.rigid, "Turn and shift as one body, never deform, the ", what, "--rigid");
  command
      .add_option("--max-displacement", options.max_displacement,
                  "How far any vertex may move, as a fraction of the bounding-box diagonal; 0: any distance.\n"
                  "Intersections that this cannot resolve are left")
      ->check(not_negative())
      ->type_name("X")
      ->group(what);
  command
      .add_option("--min-gap", options.min_gap,
                  "Wanted gap between sheets that are moved apart, of one component or two, as a fraction of the\n"
                  "diagonal; 0: just enough to be safe")
      ->check(not_negative())
      ->type_name("X")
      ->group(what);
  command
      .add_flag("--absolute", options.absolute, "--max-displacement and --min-gap are lengths in the units of the mesh")
      ->group(what);
  command
      .add_option("--min-dihedral", options.min_dihedral_deg,
                  "Open two faces at an edge that are folded together closer than this angle, as programs that\n"
                  "mesh volumes ask for (TetGen: 0.1); 0: leave them. In degrees, less than 90")
      ->check(number_below(0, 90))
      ->type_name("DEG")
      ->group(what);
  command
      .add_option("--precision", options.precision,
                  "Number format in which the result must hold: 'float32' as most programs read it, 'float64',\n"
                  "or 'auto' (default): float32 where the coordinates allow it")
      ->check(one_of({"auto", "float32", "float64"}))
      ->type_name("auto|float32|float64");
  const std::string limits = "Limits";
  add_time_limit(command, options.time_limit_s, limits);
  add_memory_limit(command, options.memory_limit_mb, limits);
  const std::string shown = "What is shown";
  command.add_option("--report", options.report, "Write a JSON report: counts, displacement, regions, seconds, ...")
      ->type_name("FILE")
      ->group(shown);
  command
      .add_option("--picture", options.picture,
                  "Write a picture, before and after, intersecting faces in red; FILE.gif or a folder (of PNG):\n"
                  "an animation of the repair")
      ->check(file_named({"png", "gif"}, true,
                         "or give a folder for pictures of an animation, which 'ffmpeg -i FOLDER/%04d.png OUT.mp4' "
                         "makes a video of"))
      ->type_name("FILE.png")
      ->group(shown);
  command.add_option("--picture-width", options.picture_width, "Width of that picture; 1600 by default")
      ->check(whole_number_within(128, 16384))
      ->type_name("PIXELS")
      ->group(shown);
  command.add_option("--view", options.view, "Write a page to look at: before, after, displacement (see unsnarl view)")
      ->check(file_named({"html", "htm"}))
      ->type_name("PAGE.html")
      ->group(shown);
  command.add_option("--record", options.record, "Write how it went as JSON: iterations, the surface on the way")
      ->type_name("FILE.json")
      ->group(shown);
  command
      .add_option("--highlight", options.highlight,
                  "Write a PLY in which intersecting faces are coloured, with the displacement of each vertex")
      ->check(file_named({"ply"}))
      ->type_name("FILE.ply")
      ->group(shown);
  add_progress(command, options.progress, shown);
  const std::string research = "For research";
  command.add_flag("--paper", options.paper, "Repair as the paper does it, instead of region by region")
      ->group(research);
  command.add_flag("--no-recover", options.no_recover, "Stop after untangling, without moving back toward the input")
      ->group(research);
  add_paper_options(command, options.paper_options);
  command.footer(
      "Examples:\n"
      "  unsnarl fix hand.obj -o hand_fixed.obj\n"
      "  unsnarl fix scan.ply -o fixed.ply --picture fixed.png --report fixed.json\n"
      "  unsnarl fix body.glb --in-place --max-displacement 0.01 --fix-vertices seam.txt\n"
      "  unsnarl fix scene.obj -o out.obj --fix-group anchor --fix-boundary\n"
      "  unsnarl fix brain.surf skull.gii skin.obj -o fixed --fix-file skin.obj     three files, one scene\n"
      "  unsnarl fix inner.off outer.off skin.off -o fixed --nested inner.off,outer.off,skin.off\n"
      "  unsnarl fix --sequence 'dance/*.obj' -o fixed                              frames of a moving mesh\n\n"
      "Exit codes: 0 embedded, 1 self-intersections left, 2 usage, 3 cannot read, 4 cannot write, 5 limit reached,\n"
      "6 interrupted, 7 all repaired but what no allowed motion can resolve (--nested: or a surface lies wrong),\n"
      "9 the system failed (try again), 70 internal error.\n"
      "With --only-... and --each, 0 still means that nothing in the whole file intersects; where only what they "
      "leave\n"
      "out does, the result is written and the exit code is 7.");
}

WantedNesting nesting_wanted(const FixOptions& options, const SceneDocument& scene) {
  WantedNesting wanted;
  Nesting& nesting = wanted.nesting;
  if (options.nested.empty()) return wanted;
  if (options.each || options.paper || !options.rigid.empty())
    throw UsageError(
        "--nested goes neither with --each nor with --rigid and its like, nor with --paper; leave one out");
  const SurfaceView surface = scene.surface();
  nesting.surface_of_vertex.assign(surface.vertex_count(), -1);
  const auto number_of = [&](const std::string& name) {
    const auto known = std::find(nesting.names.begin(), nesting.names.end(), name);
    const auto number = static_cast<std::int32_t>(known - nesting.names.begin());
    if (known != nesting.names.end()) return number;
    const Parts part = options.is_scene() ? Parts{.files = {name}} : Parts{.objects = {name}};
    const std::vector<std::uint8_t> flags =
        vertices_of_faces(surface, faces_in_parts(surface, scene.face_labels(), part, options.find()));
    for (std::size_t v = 0; v < flags.size(); ++v) {
      if (!flags[v]) continue;
      if (nesting.surface_of_vertex[v] >= 0)
        throw UsageError(fmt::format("--nested: '{}' and '{}' have vertex {} in common; name surfaces apart",
                                     nesting.names[nesting.surface_of_vertex[v]], name, v));
      nesting.surface_of_vertex[v] = number;
    }
    nesting.names.push_back(name);
    return number;
  };
  try {
    for (const std::string& value : options.nested) {
      nesting.chains.emplace_back();
      std::istringstream names(value);
      for (std::string name; std::getline(names, name, ',');) nesting.chains.back().push_back(number_of(name));
    }
    wanted.doubts = check_nesting(surface, nesting, options.find());
  } catch (const UnknownPart& e) {
    throw UsageError(fmt::format("--nested: {}", e.what()));
  } catch (const std::invalid_argument& e) {
    throw UsageError(fmt::format("--{}", e.what()));
  }
  return wanted;
}

RepairOptions repair_options(const FixOptions& options, const SceneDocument& scene) {
  RepairOptions result;
  result.find = options.find();
  result.goal = options.goal_wanted();
  if (options.precision == "float32") result.precision = Precision::float32;
  if (options.precision == "float64") result.precision = Precision::float64;
  if (const auto file = scene.float32_file()) {
    if (result.precision == Precision::float64)
      throw UsageError(fmt::format("--precision float64: {}: this {} file stores 32-bit numbers; leave the option out",
                                   scene.files()[*file].name, to_string(scene.document(*file).format())));
    result.precision = Precision::float32;
  }
  const double diagonal = diagonal_of(scene.surface());
  const double unit = options.absolute && diagonal > 0 ? 1 / diagonal : 1;
  result.max_displacement_rel = options.max_displacement * unit;
  result.min_gap_rel = options.min_gap * unit;
  result.min_dihedral_deg = options.min_dihedral_deg;
  result.time_limit_s = options.time_limit_s;
  result.memory_limit_mb = options.memory_limit_mb;
  if (options.paper) result.paper = options.paper_options;
  result.recover = !options.no_recover;
  const bool animated = picture_kind(options.picture) != PictureKind::still;
  if (!options.record.empty() || !options.view.empty() || animated)
    result.record = {.history = true, .frames = recorded_frames};
  result.as_written = [&scene](std::span<const double> positions, bool float32) {
    return scene.as_written(positions, float32);
  };
  result.fixed = fixed_vertices(options, scene);
  result.each_component = options.each;
  set_rigid_parts(options, scene, result);
  return result;
}

}  // namespace unsnarl::app
