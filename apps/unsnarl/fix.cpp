#include "fix.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "cancellable_work.h"
#include "file_places.h"
#include "fix_summary.h"
#include "memory_guard.h"
#include "mesh_input.h"
#include "pictures.h"
#include "progress.h"
#include "sequence/hint.h"
#include "sequence/sequence.h"
#include "staged_output.h"
#include "standard_streams.h"
#include "surface_files.h"
#include "unsnarl/certify.h"
#include "unsnarl/exit_code.h"
#include "unsnarl/page.h"
#include "unsnarl/paths.h"
#include "unsnarl/pictures.h"
#include "unsnarl/repair_file_steps.h"
#include "unsnarl/report_json.h"
#include "unsnarl/stage_clock.h"
#include "unsnarl/version.h"
#include "unsnarl/visible_text.h"
#include "usage_error.h"
#include "viewer.h"

namespace unsnarl::app {
namespace {

namespace fs = std::filesystem;

bool is_there(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

/// Path of the result, or of the folder of several.
std::string checked_output(const FixOptions& options) {
  scene_names(options.inputs);  // throws where two are the same
  if (options.is_scene() && options.in_place)
    throw UsageError("--in-place works with one file; for several files use -o FOLDER");
  if (options.is_scene() && is_stream(options.output))
    throw UsageError(fmt::format("-o {}: with several input files, -o needs a folder", options.output));
  if (options.in_place) {
    if (!options.output.empty()) throw UsageError("--in-place and -o exclude each other; leave one of the two out");
    if (options.inputs[0] == standard_stream) throw UsageError("--in-place needs a file, not standard input");
  } else if (options.output.empty()) {
    const std::string wanted = options.inputs.back();
    const bool is_result = options.inputs.size() == 2 && !is_there(path_of(wanted));
    throw UsageError("-o OUT is missing: the file to write the result to ('-' for standard output); or use --in-place" +
                     (is_result ? fmt::format(". For {0}: unsnarl fix {1} -o {0}", wanted, options.inputs[0]) : ""));
  }
  return options.in_place ? options.inputs[0] : options.output;
}

/// Path that file `i` of those given is written to.
fs::path target_of(const FixOptions& options, std::size_t i) {
  const fs::path input = path_of(options.inputs[i]);
  if (options.in_place) return input;
  return options.is_scene() ? path_of(options.output) / input.filename() : path_of(options.output);
}

/// All files but the external ones of glTF and GIFTI.
FilePlaces checked_places(const FixOptions& options) {
  FilePlaces places;
  if (!options.in_place)
    for (const std::string& input : options.inputs) places.reads("the input", input);
  places.reads("--fix-vertices", options.fix_vertices);
  for (std::size_t i = 0; i < options.inputs.size(); ++i)
    places.writes(options.in_place ? "the input" : "-o", target_of(options, i).string(),
                  options.is_scene() ? "use another folder" : "use --in-place to overwrite the input");
  places.writes("--report", options.report);
  places.writes("--highlight", options.highlight);
  if (picture_kind(options.picture) != PictureKind::folder) places.writes("--picture", options.picture);
  places.writes("--record", options.record);
  places.writes("--view", options.view);
  return places;
}

std::string names_of(const SceneDocument& scene) {
  std::string names;
  for (const SceneFile& file : scene.files()) names += (names.empty() ? "" : ", ") + file.name;
  return names;
}

FilesToRepair read(const FixOptions& options, const std::string& output) {
  RepairFileOptions places;
  places.in_place = options.in_place;
  std::vector<fs::path> inputs;
  for (const std::string& input : options.inputs) inputs.push_back(path_of(input));
  FilesToRepair files =
      files_to_repair(std::make_shared<SceneDocument>(read_inputs(options.inputs, format_from_name(options.format))),
                      inputs, options.in_place ? fs::path() : path_of(output), places);
  if (is_stream(output)) files.targets.clear();
  return files;
}

/// Claims the places of external files. Throws UsageError where one belongs to something else.
void claim_external_files(const FixOptions& options, const FilesToRepair& files, FilePlaces& places) {
  if (!options.in_place) claim_inputs(places, "the input", options.inputs, *files.scene);
  for (std::size_t i = 0; i < files.inputs.size(); ++i) {
    const std::vector<fs::path> names = files.names_beside(i);
    if (names.empty()) continue;
    if (files.targets.empty())
      throw UsageError(
          "this file keeps its numbers in other files, so the result cannot go to standard output; use -o FILE");
    places.writes_beside("an external file of " + files.scene->files()[i].name, files.main_place(i), names,
                         "write the result to another folder");
  }
}

/// Throws UsageError where the result cannot be at its place.
void claim_places(const FixOptions& options, FilesToRepair& files, FilePlaces& places) {
  claim_external_files(options, files, places);
  try {
    check_places(files, options.no_partial, [&](const fs::path& place) { return places.has(place); });
  } catch (const std::invalid_argument& refused) {
    throw UsageError(refused.what());
  }
}

RepairFileOptions file_options(const FixOptions& options, FilesToRepair& files) {
  RepairFileOptions wanted;
  wanted.repair = repair_options(options, *files.scene);
  WantedNesting nesting = nesting_wanted(options, *files.scene);
  wanted.nesting = std::move(nesting.nesting);
  wanted.keep_partial = options.keep_partial;
  if (options.recompute_normals && !files.scene->recompute_normals())
    files.notes.push_back(
        fmt::format("--recompute-normals: {} has no vertex normals to update", names_of(*files.scene)));
  for (const std::string& doubt : nesting.doubts) files.notes.push_back("--nested: " + doubt);
  return wanted;
}

RepairResult repaired(const FixOptions& options, const SurfaceView& surface, const RepairFileOptions& wanted,
                      ProgressDisplay& display, Interruption& interruption) {
  Context context;
  context.on_progress = [&](const Context::Progress& progress) { display.show(progress); };
  const CancelledByInterruption cancelled(interruption, context, options.quiet);
  display.begin("diagnose");
  return wanted.nesting.chains.empty() ? repair(surface, wanted.repair, &context)
                                       : repair_nested(surface, wanted.nesting, wanted.repair, &context);
}

/// Shows that outputs are written, unless one goes to standard output, which may be the same terminal.
void begin_writing(const FixOptions& options, ProgressDisplay& display) {
  const std::array outputs = {options.output, options.report, options.picture,
                              options.view,   options.record, options.highlight};
  if (std::any_of(outputs.begin(), outputs.end(), is_stream))
    display.clear();
  else
    display.begin("write");
}

std::vector<std::string> other_outputs(const FixOptions& options) {
  std::vector<std::string> paths;
  for (const std::string& path : {options.report, options.picture, options.view, options.record, options.highlight})
    if (!path.empty() && !is_stream(path)) paths.push_back(path);
  return paths;
}

void add_pictures(const FixOptions& options, const SceneDocument& scene, const RepairOptions& repair,
                  const RepairResult& result, StagedOutput& outputs) {
  if (options.highlight.empty() && options.picture.empty()) return;
  const Surface& surface = scene.surface();
  Certifier certifier(surface, repair.find);
  const std::vector<IntersectingPair> pairs_before = certifier.find_intersections(surface.positions);
  const std::vector<IntersectingPair> pairs_after = certifier.find_intersections(result.positions);
  if (!options.highlight.empty())
    outputs.add(options.highlight, highlight_file(surface, result.positions, pairs_before, pairs_after));
  if (picture_kind(options.picture) != PictureKind::still) {
    add_animation(options.picture, surface, scene.files(), result, outputs);
  } else if (!options.picture.empty()) {
    PictureOptions picture;
    picture.files = scene.files();
    picture.width = options.picture_width;
    picture.height = options.picture_width / 2;
    picture.before_label =
        picture_label("before", pairs_before.size(), certifier.find_allowed_pairs(surface.positions).size());
    picture.after_label =
        picture_label("after", pairs_after.size(), certifier.find_allowed_pairs(result.positions).size());
    const SurfaceView before = surface;
    const SurfaceView after = {result.positions, before.corners, before.offsets};
    outputs.add(options.picture,
                picture_png(before, intersecting_faces(pairs_before), after, intersecting_faces(pairs_after), picture));
  }
}

void add_view(const FixOptions& options, const SceneDocument& scene, const RepairOptions& repair,
              const RepairedFiles& done, ProgressDisplay& display, StagedOutput& outputs) {
  if (options.view.empty()) return;
  const Appearance appearance = scene.appearance();
  for (const std::string& note : appearance.notes) display.say("note: {}", note);
  PageSource source;
  source.appearance = &appearance;
  source.input_name = scene_name(options.inputs);
  source.output_name = done.report.output.empty() ? "" : page_name(done.report.output);
  source.before = scene.surface();
  source.files = scene.files();
  source.labels = scene.face_labels();
  source.after = done.result.positions;
  source.find = repair.find;
  source.goal = repair.goal;
  source.report = report_json(done.result, repair, done.report);
  source.frames = done.result.frames;
  outputs.add(options.view, view_page(built_in_page(), source));
}

/// All that is said of the result, in files that are put in place with it.
void add_what_is_shown(const FixOptions& options, const FilesToRepair& files, const RepairOptions& repair,
                       const StageClock& clock, RepairedFiles& done, ProgressDisplay& display, StagedOutput& outputs) {
  add_pictures(options, *files.scene, repair, done.result, outputs);
  if (!options.record.empty()) outputs.add(options.record, recording_json(done.result, files.scene->surface()) + "\n");
  if (!options.report.empty() || options.min_dihedral_deg > 0) measure_clearances(files, repair, done);
  done.report.whole = clock.stage("fix");
  if (!options.report.empty()) outputs.add(options.report, report_json(done.result, repair, done.report) + "\n");
  add_view(options, *files.scene, repair, done, display, outputs);
}

/// Repairs one mesh, or the files of one scene: all files are new, or all are as they were.
int fix_files(const FixOptions& options, Interruption& interruption) {
  const StageClock clock;
  const std::string output = checked_output(options);
  FilePlaces places = checked_places(options);
  ProgressDisplay display(options.progress, options.quiet);
  const MemoryGuard memory_guard(options.memory_limit_mb);
  display.begin("read");
  FilesToRepair files = read(options, output);
  const RepairFileOptions wanted = file_options(options, files);
  claim_places(options, files, places);
  const StageReport reading = clock.stage("read");
  for (const std::string& note : files.notes) display.say("note: {}", note);
  if (const std::string hint = sequence_hint(options, *files.scene); !hint.empty()) display.say("note: {}", hint);

  // A folder that is missing or must not be written to is found now rather than after the work.
  std::optional<OutputFolder> folder;
  if (options.is_scene()) folder.emplace(path_of(output));
  places.require_writable(interruption);
  if (picture_kind(options.picture) == PictureKind::folder) prepare_picture_folder(options.picture, "--picture");

  RepairResult result = repaired(options, files.scene->surface(), wanted, display, interruption);
  begin_writing(options, display);
  StagedOutput outputs(interruption);
  RepairedFiles done = stage_result(files, std::move(result), wanted, outputs.files());
  if (!done.bytes.empty()) outputs.add(output, std::move(done.bytes));
  done.report.before_repair.push_back(reading);
  add_what_is_shown(options, files, wanted.repair, clock, done, display, outputs);
  outputs.write_streams();
  put_in_place(files, done.result, wanted, outputs.files());

  if (!options.quiet) {
    display.clear();
    tell(fix_summary(done.result, wanted.repair, done.report, other_outputs(options)));
  }
  return exit_code_of(done.result.status, done.report.nested);
}

/// The report about an input that was not repaired, so that no earlier one is taken for its own. Nothing but a report
/// is overwritten: the files that a broken input refers to are not known.
void write_refusal(const FixOptions& options, std::string_view status, ExitCode exit_code, const std::string& error,
                   Interruption& interruption) {
  const fs::path path = path_of(options.report);
  if (path.empty() || (is_there(path) && !is_stream(path.string()) && path.extension() != ".json")) return;
  const nlohmann::ordered_json json = {
      {"schema", "unsnarl-report"},
      {"schema_version", report_schema_version},
      {"version", version},
      {"status", status},
      {"exit_code", static_cast<int>(exit_code)},
      {"input", {{"path", fmt::format("{}", fmt::join(options.inputs, ", "))}}},
      {"output", {{"written", false}, {"path", nullptr}, {"partial", nlohmann::ordered_json::array()}}},
      {"error", error}};
  write_file(options.report, json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n", interruption);
}

}  // namespace

int run_fix(const FixOptions& options, Interruption& interruption) {
  try {
    return options.sequence ? run_sequence(options, interruption) : fix_files(options, interruption);
  } catch (const FileError& error) {
    if (!options.sequence) write_refusal(options, "invalid_input", exit_invalid_input, error.what(), interruption);
    throw;
  } catch (const SystemError& error) {
    if (!options.sequence) write_refusal(options, "system_error", exit_system_error, error.what(), interruption);
    throw;
  }
}

}  // namespace unsnarl::app
