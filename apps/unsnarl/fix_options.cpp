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
#include "unsnarl/exit_code.h"
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
        fmt::format("{0}file needs several input files; in one file, name parts with {0}object or {0}group", prefix));
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
        "--each repairs every connected piece as if it were alone, --rigid moves parts among the others; leave one of "
        "the two out");
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
        throw UsageError(fmt::format(
            "--rigid: '{}' cannot move as a rigid body: --fix-... or --only-... keeps its vertex {} fixed; leave "
            "one of the two out",
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
               const std::string& end, const std::string& group, const std::string& shortcut = "") {
  const auto named = [&](const std::string& name, auto& list, const std::string& of, const char* type) {
    // One value each time: more would swallow the name of the input.
    const bool has_shortcut = !shortcut.empty() && name == "object";
    return command
        .add_option((has_shortcut ? shortcut + "," : "") + prefix + name, list, what + of + end + ". May be repeated")
        ->type_name(type)
        ->group(group)
        ->allow_extra_args(false);
  };
  named("group", parts.groups, "the faces of this group (OBJ g, glTF mesh, Gmsh physical group, Abaqus ELSET)", "NAME");
  named("object", parts.objects,
        "the faces of this object (OBJ o, STL solid, glTF node, Gmsh entity, Abaqus part, 3MF object)", "NAME");
  named("material", parts.materials, "the faces of this material", "NAME");
  named("component", parts.components, "the connected piece of this number in the list of 'unsnarl check'", "N")
      ->check(whole_number_within(0, std::numeric_limits<std::int32_t>::max()));
  named("file", parts.files, "the input file of this name", "NAME");
}

/// Adds the options that say where the result goes, how far vertices may move, and when to stop.
void add_usual_options(CLI::App& command, FixOptions& options) {
  command
      .add_option("-o,--output", options.output,
                  "File to write the repaired mesh to; '-' for standard output. With several input files: a folder. "
                  "Names stay the same; either all files are written or none")
      ->type_name("OUT");
  command.add_flag("--in-place", options.in_place, "Overwrite IN with the repaired mesh");
  command
      .add_option("--max-displacement", options.max_displacement,
                  "Largest distance that a vertex may move, as a fraction of the bounding-box diagonal. Intersections "
                  "that need more are left. 0 (default): no limit")
      ->check(not_negative(unit::share_or_length))
      ->type_name("NUMBER");
  command
      .add_option(
          "--min-gap", options.min_gap,
          "Distance to keep between surfaces, as a fraction of the bounding-box diagonal. Where it is less, also "
          "where nothing intersects, they are moved apart. 0 (default): where they intersected, as little as is "
          "safe")
      ->check(not_negative(unit::share_or_length))
      ->type_name("NUMBER");
  command.add_flag("--gap-near-conflicts", options.gap_near_conflicts,
                   "With --min-gap: keep that distance only around what intersects, and do not measure it");
  command.add_flag("--absolute", options.absolute,
                   "--max-displacement and --min-gap are lengths in the units of the file");
  CLI::Option* const keep_partial = command.add_flag(
      "--keep-partial", options.keep_partial,
      "Write the result to OUT even if self-intersections are left or a limit was reached. Default: such a result goes "
      "to OUT.partial.EXT beside it, and OUT is not written");
  command.add_flag("--no-partial", options.no_partial, "Do not write OUT.partial.EXT")->excludes(keep_partial);
  add_time_limit(command, options.time_limit_s);
  add_memory_limit(command, options.memory_limit_mb);
}

void add_outputs_to_look_at(CLI::App& command, FixOptions& options) {
  const std::string shown = outputs_to_look_at;
  command
      .add_option("--report", options.report,
                  "Write a JSON report: number of intersections, how far vertices moved, what is left and why")
      ->type_name("FILE")
      ->group(shown);
  command
      .add_option("--picture", options.picture,
                  "Write a picture of the mesh before and after, intersecting faces in red. FILE.gif or a folder (for "
                  "PNG files): an animation of the repair")
      ->check(file_named({"png", "gif"}, true,
                         "or give a folder for pictures of an animation, which 'ffmpeg -i FOLDER/%04d.png OUT.mp4' "
                         "makes a video of"))
      ->type_name("FILE.png")
      ->group(shown);
  command.add_option("--picture-width", options.picture_width, "Width of the picture in pixels (default 1600)")
      ->check(whole_number_within(128, 16384))
      ->type_name("PIXELS")
      ->group(shown);
  command
      .add_option("--view", options.view,
                  "Write a page for a browser that shows the mesh before and after (see 'unsnarl view')")
      ->check(file_named({"html", "htm"}))
      ->type_name("PAGE.html")
      ->group(shown);
  command
      .add_option("--record", options.record,
                  "Write the steps of the repair as JSON: iterations, and the positions along the way")
      ->type_name("FILE.json")
      ->group(shown);
  command
      .add_option("--highlight", options.highlight,
                  "Write a PLY file with intersecting faces coloured and the distance that each vertex moved")
      ->check(file_named({"ply"}))
      ->type_name("FILE.ply")
      ->group(shown);
  add_progress(command, options.progress, shown);
}

void add_what_may_move(CLI::App& command, FixOptions& options) {
  const std::string what = "What may move";
  command
      .add_option("--fix-vertices", options.fix_vertices,
                  "Keep these vertices fixed: a file of vertex ids, counted from 0")
      ->type_name("FILE")
      ->group(what);
  command.add_flag("--fix-boundary", options.fix_boundary, "Keep all boundary vertices fixed")->group(what);
  add_parts(command, "--fix-", options.fix, "Keep fixed ", "", what);
  add_parts(command, "--only-", options.only, "Move only ", "; all else stays fixed", what);
  add_parts(command, "--rigid-", options.rigid, "Move as a rigid body (turned and shifted, never deformed) ", "", what,
            "--rigid");
  CLI::Option* const each =
      command
          .add_flag("--each", options.each,
                    "Repair every connected piece as if it were alone. Pieces that intersect each other stay so; this "
                    "is reported as 'obstructed' (exit code 7), and the result is written")
          ->group(what);
  command
      .add_flag("--together", options.together, "Also separate connected pieces that intersect each other (default)")
      ->excludes(each)
      ->group(what);
  add_allow(command, options.allow, what);
  command
      .add_option(
          "--nested", options.nested,
          "Which surfaces lie inside which, from the innermost outwards: names of input files, or of objects in "
          "one file. Where two of them intersect, the inner one moves inwards and the outer one outwards. All "
          "but the first must be closed. May be repeated")
      ->type_name("INNER,OUTER,..")
      ->group(what)
      ->allow_extra_args(false);
}

void add_quality_of_result(CLI::App& command, FixOptions& options) {
  const std::string quality = "What the result must be like";
  command
      .add_option(
          "--min-dihedral", options.min_dihedral_deg,
          "Unfold neighbouring faces that meet at less than this angle (degrees, below 90). Tetrahedral meshers "
          "need it: 0.1 for TetGen. 0 (default): off")
      ->check(number_below(0, 90, unit::degrees))
      ->type_name("DEGREES")
      ->group(quality);
  command
      .add_option("--precision", options.precision,
                  "Precision in which the result has no self-intersections: 'float32', as most programs read it, "
                  "'float64', or 'auto' (default): float32 where the coordinates allow it")
      ->check(one_of({"auto", "float32", "float64"}))
      ->type_name("auto|float32|float64")
      ->group(quality);
  command
      .add_flag("--recompute-normals", options.recompute_normals,
                "Update stored vertex normals (OBJ vn, PLY nx ny nz, glTF) where faces moved. Default: they stay as "
                "they are. STL facet normals are always updated")
      ->group(quality);
}

void add_sequence_options(CLI::App& command, FixOptions& options) {
  const std::string frames = "Sequences";
  CLI::Option* const sequence =
      command
          .add_flag("--sequence", options.sequence,
                    "IN are the frames of a moving mesh: numbered files with the same faces, or patterns of them in "
                    "quotes; or a mesh and a point cache (PC2, MDD). The motion stays smooth from frame to frame. The "
                    "frames are written to the folder given with -o. Run the same command again to continue after an "
                    "interruption")
          ->group(frames);
  command
      .add_option("--frames", options.frames,
                  "With --sequence: only these frames, counted from 0, without LAST. Either may be left out")
      ->type_name("FIRST:LAST")
      ->needs(sequence)
      ->group(frames);
}

}  // namespace

void add_fix_options(CLI::App& command, FixOptions& options) {
  add_inputs(command, options);
  add_usual_options(command, options);
  add_mesh_options(command, options);
  command.final_callback([&command, &options] {
    options.require_effect();
    if (options.paper && !options.allow.empty())
      throw UsageError("--paper knows nothing of pairs that may intersect; leave --paper or --allow out");
    if (options.absolute && command.count("--max-displacement") + command.count("--min-gap") == 0)
      throw UsageError(
          "--absolute has an effect only with --max-displacement or --min-gap; add one of them, or leave "
          "--absolute out");
    if (options.gap_near_conflicts && command.count("--min-gap") == 0)
      throw UsageError("--gap-near-conflicts has an effect only with --min-gap; add it, or leave the other out");
  });
  add_outputs_to_look_at(command, options);
  add_what_may_move(command, options);
  add_quality_of_result(command, options);
  add_sequence_options(command, options);
  command
      .add_flag("--no-recover", options.no_recover,
                "Stop when the intersections are removed, without moving back toward the input")
      ->group(research_options);
  command.add_flag("--paper", options.paper, "Use the method of the paper on the whole mesh")->group(research_options);
  add_paper_options(command, options.paper_options);
  command.footer(
      std::string("Examples:\n"
                  "  unsnarl fix hand.obj -o hand_fixed.obj\n"
                  "  unsnarl fix scan.ply -o fixed.ply --picture fixed.png --report fixed.json\n"
                  "  unsnarl fix body.glb --in-place --max-displacement 0.01\n"
                  "  unsnarl fix scene.obj -o out.obj --fix-group anchor --fix-boundary\n"
                  "  # several files that form one scene\n"
                  "  unsnarl fix brain.surf skull.gii skin.obj -o fixed --fix-file skin.obj\n"
                  "  unsnarl fix inner.off outer.off -o fixed --nested inner.off,outer.off\n"
                  "  # the frames of a moving mesh\n"
                  "  unsnarl fix --sequence 'dance/*.obj' -o fixed\n\n") +
      exit_codes({{exit_embedded, "embedded: no self-intersections"},
                  {exit_intersecting, "self-intersections are left"},
                  {exit_limit, "limit of time, memory or displacement reached"},
                  {exit_obstructed,
                   "everything was repaired that can be repaired with these options;\n      or with --nested: a "
                   "surface is on the wrong side"},
                  {exit_allowed, "no self-intersections but those that --allow lets pass"},
                  {exit_gap_not_met, "no self-intersections, but a gap is smaller than --min-gap asks"}}) +
      "\n\n"
      "With --only-... and --each, 0 still means that the whole file has no self-intersections. If only the parts that "
      "these options leave out still intersect, the result is written and the exit code is 7.");
}

WantedNesting nesting_wanted(const FixOptions& options, const SceneDocument& scene) {
  WantedNesting wanted;
  Nesting& nesting = wanted.nesting;
  if (options.nested.empty()) return wanted;
  if (options.each || options.paper || !options.rigid.empty() || !options.allow.empty())
    throw UsageError(
        "--nested cannot be combined with --allow, --each, --paper, --rigid or --rigid-...; leave one of them out");
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
        throw UsageError(
            fmt::format("--nested: '{}' and '{}' have vertex {} in common; name surfaces that share no vertex",
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
  result.find = options.find_in(scene);
  result.goal = options.goal_wanted();
  if (options.precision == "float32") result.precision = Precision::float32;
  if (options.precision == "float64") result.precision = Precision::float64;
  if (const auto file = scene.float32_file()) {
    if (result.precision == Precision::float64)
      throw UsageError(
          fmt::format("--precision float64: {} is a {} file, which stores 32-bit numbers; leave the option out",
                      scene.files()[*file].name, to_string(scene.document(*file).format())));
    result.precision = Precision::float32;
  }
  const double diagonal = diagonal_of(scene.surface());
  const double unit = options.absolute && diagonal > 0 ? 1 / diagonal : 1;
  result.max_displacement_rel = options.max_displacement * unit;
  result.min_gap_rel = options.min_gap * unit;
  result.gap_near_conflicts = options.gap_near_conflicts;
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
