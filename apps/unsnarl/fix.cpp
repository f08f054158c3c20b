#include "fix.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <optional>

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
#include "unsnarl/pictures.h"
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
    const bool is_result = options.inputs.size() == 2 && !is_there(wanted);
    throw UsageError("-o OUT is missing: the file to write the result to ('-' for standard output); or use --in-place" +
                     (is_result ? fmt::format(". For {0}: unsnarl fix {1} -o {0}", wanted, options.inputs[0]) : ""));
  }
  return options.in_place ? options.inputs[0] : options.output;
}

/// Path that file `i` of those given is written to.
fs::path target_of(const FixOptions& options, std::size_t i) {
  const fs::path input = options.inputs[i];
  if (options.in_place) return input;
  return options.is_scene() ? fs::path(options.output) / input.filename() : fs::path(options.output);
}

/// All files but the external ones of glTF and GIFTI.
FilePlaces checked_places(const FixOptions& options) {
  FilePlaces places;
  if (!options.in_place)
    for (const std::string& input : options.inputs) places.reads("the input", input);
  places.reads("--fix-vertices", options.fix_vertices);
  for (std::size_t i = 0; i < options.inputs.size(); ++i)
    places.writes(options.in_place ? "the input" : "-o", target_of(options, i),
                  options.is_scene() ? "use another folder" : "use --in-place to overwrite the input");
  places.writes("--report", options.report);
  places.writes("--highlight", options.highlight);
  if (picture_kind(options.picture) != PictureKind::folder) places.writes("--picture", options.picture);
  places.writes("--record", options.record);
  places.writes("--view", options.view);
  return places;
}

/// The result is the input's file with other positions, so it cannot change its format.
void check_format_of_output(const std::string& output, const Document& document, const std::string& input) {
  const std::optional<Format> format = is_stream(output) ? std::nullopt : format_from_extension(output);
  if (!format || *format == document.format()) return;
  std::string extension = fs::path(input).extension().string();  // of several, such as *.pial, the input's
  if (extension.empty() || format_from_extension(input) != document.format())
    extension = fmt::format(".{}", to_string(document.format()));
  throw UsageError(fmt::format("{}: the result keeps the format of the input, {}; name it *{}", output,
                               to_string(document.format()), extension));
}

std::string names_of(const SceneDocument& scene) {
  std::string names;
  for (const SceneFile& file : scene.files()) names += (names.empty() ? "" : ", ") + file.name;
  return names;
}

bool is_to_be_written(const RepairResult& result, const Surface& input, bool keep_partial) {
  switch (result.status) {
    case Status::embedded: return true;
    // Nothing to repair but what cannot be: a refusal.
    case Status::obstructed: return result.positions != input.positions;
    default: return keep_partial;
  }
}

/// Was something better than the input reached, which is not what was asked for?
bool is_partial(const RepairResult& result, const Surface& input) {
  switch (result.status) {
    case Status::embedded:
    case Status::obstructed:
    case Status::no_progress: return false;
    default: return result.positions != input.positions;
  }
}

/// The promise of the status that what was just written breaks. Empty: none.
std::string broken_promise(const RepairResult& result, const RepairOptions& options, const Surface& input,
                           const Surface& read_back, Certifier& certifier) {
  if (read_back.corners != input.corners || read_back.offsets != input.offsets ||
      read_back.positions.size() != input.positions.size())
    return "its faces are not those of the input";
  const Certificate certificate = certifier.certify(read_back.positions);
  if (!certificate.seams_closed) return "a seam that was closed in the input is open";
  const PairCounts &after = certificate.pairs, &before = result.report.before;
  const std::size_t disjoint = after[PairClass::disjoint];
  const bool all = options.goal == Goal::all;
  if (result.status == Status::embedded && (all ? after.total() : disjoint) > 0)
    return fmt::format("{} pairs of faces intersect", all ? after.total() : disjoint);
  if (result.status == Status::embedded && all && !certificate.embedded())
    return fmt::format("{} faces have lost their area", certificate.new_zero_area_faces);
  if (disjoint > before[PairClass::disjoint] || (all && after.total() > before.total()))
    return fmt::format("more pairs of faces intersect than in the input: {} instead of {}", after.total(),
                       before.total());
  return {};
}

/// Everything around one call of `fix`.
class Fix {
 public:
  Fix(const FixOptions& options, Interruption& interruption)
      : options_(options),
        interruption_(interruption),
        output_(checked_output(options)),
        places_(checked_places(options)),
        display_(options.progress, options.quiet),
        memory_guard_(options.memory_limit_mb),
        scene_(read()),
        repair_options_(repair_options(options, scene_)),
        wanted_nesting_(nesting_wanted(options, scene_)),
        nesting_(wanted_nesting_.nesting) {
    claim_external_files();
    choose_partial_names();
    if (!options.is_scene()) {
      check_format_of_output(output_, scene_.document(0), options_.inputs[0]);
      files_.input = options_.inputs[0];
      files_.format = to_string(scene_.document(0).format());
    }
    files_.vertices = surface().view().vertex_count();
    files_.faces = surface().view().face_count();
    files_.notes = scene_.notes();
    if (options.recompute_normals && !scene_.recompute_normals())
      files_.notes.push_back(fmt::format("--recompute-normals: {} has no vertex normals to update", names_of(scene_)));
    for (const std::string& doubt : wanted_nesting_.doubts) files_.notes.push_back("--nested: " + doubt);
    files_.before_repair.push_back(clock_.stage("read"));
  }

  int run() {
    for (const std::string& note : files_.notes) display_.say("note: {}", note);
    if (const std::string hint = sequence_hint(options_, scene_); !hint.empty()) display_.say("note: {}", hint);
    // A folder that is missing or must not be written to is found now rather than after the work.
    std::optional<OutputFolder> folder;
    if (options_.is_scene()) folder.emplace(output_);
    places_.require_writable(interruption_);
    if (picture_kind(options_.picture) == PictureKind::folder) prepare_picture_folder(options_.picture, "--picture");

    Context context;
    context.on_progress = [&](const Context::Progress& progress) { display_.show(progress); };
    interruption_.set_handler([&] {
      context.cancel();
      if (!options_.quiet) tell("\nstopping; press Control-C again to end at once\n");
    });
    display_.begin("diagnose");
    result_ = nesting_.chains.empty() ? repair(surface(), repair_options_, &context)
                                      : repair_nested(surface(), nesting_, repair_options_, &context);
    interruption_.set_handler(nullptr);

    write_all();
    if (!options_.quiet) {
      display_.clear();
      tell(fix_summary(result_, repair_options_, files_, other_outputs()));
    }
    return exit_code_of(result_.status, files_.nested);
  }

 private:
  SceneDocument read() {
    display_.begin("read");
    return read_scene(options_.inputs, format_from_name(options_.format));
  }

  const Surface& surface() const { return scene_.surface(); }
  fs::path target(std::size_t file) const { return target_of(options_, file); }
  Certifier& certifier() {
    if (!certifier_) certifier_.emplace(surface(), repair_options_.find);
    return *certifier_;
  }

  /// The result and all that is said of it: all files are new, or all are as they were.
  void write_all() {
    const StageClock writing;
    begin_writing();
    StagedOutput outputs(interruption_);
    if (is_to_be_written(result_, surface(), options_.keep_partial)) {
      add_result(outputs);
      files_.output = output_;
    } else if (!partial_infix_.empty() && is_partial(result_, surface())) {
      add_result(outputs, partial_infix_);
      files_.partial = partial_places();
    }
    if (options_.is_scene()) describe_files();
    if (!nesting_.chains.empty()) describe_nesting();
    files_.after_repair.push_back(writing.stage("write"));

    add_pictures(outputs);
    add_recording(outputs);
    measure_clearances();
    files_.whole = clock_.stage("fix");
    add_report(outputs);
    add_view(outputs);
    try {
      outputs.commit();
    } catch (const ChangedMeanwhile& changed) {
      keep_beside(changed);
    }
  }

  /// Writes the result beside the target, which somebody has changed meanwhile and which stays as it is.
  [[noreturn]] void keep_beside(const ChangedMeanwhile& changed) {
    if (partial_infix_.empty()) throw changed;
    StagedOutput outputs(interruption_);
    add_result(outputs, partial_infix_);
    outputs.commit();
    throw WriteError(fmt::format("{}; the result is in {}", changed.what(), fmt::join(partial_places(), ", ")));
  }

  std::vector<std::string> other_outputs() const {
    std::vector<std::string> paths;
    for (const std::string& path :
         {options_.report, options_.picture, options_.view, options_.record, options_.highlight})
      if (!path.empty() && !is_stream(path)) paths.push_back(path);
    return paths;
  }

  /// Where the main file of a result ends up: the files of a scene all have names, of a single one links are followed.
  fs::path main_place(std::size_t i) const {
    std::error_code error;
    const fs::path place = options_.is_scene() ? target(i) : fs::weakly_canonical(target(i), error);
    return error ? target(i) : place;
  }
  /// The name that external files of a result are called after; in place they keep theirs.
  fs::path name_giver(std::size_t i) const { return options_.in_place ? fs::path() : main_place(i).filename(); }

  /// What lies where external files are to go may belong to something else.
  void claim_external_files() {
    if (!options_.in_place) claim_inputs(places_, "the input", options_.inputs, scene_);
    for (std::size_t i = 0; i < scene_.files().size(); ++i) {
      const Document& document = scene_.document(i);
      const bool streams = is_stream(output_);
      const std::vector<fs::path> names = external_files(document, streams ? fs::path() : name_giver(i));
      if (streams && !names.empty())
        throw UsageError(
            "this file keeps its numbers in other files, so the result cannot go to standard output; use -o FILE");
      if (names.empty()) continue;
      const fs::path main = main_place(i);
      const std::vector<fs::path> replaced = options_.in_place ? names : external_files(main, document.format());
      places_.writes_beside("an external file of " + scene_.files()[i].name, main, names,
                            "write the result to another folder");
      for (const fs::path& name : names) {
        const fs::path place = main.parent_path() / name;
        if (is_there(place) && std::find(replaced.begin(), replaced.end(), name) == replaced.end())
          throw UsageError(
              fmt::format("{} exists and would be overwritten by a file of the same name that belongs to the "
                          "result; write the result to another folder",
                          place.string()));
      }
    }
  }

  /// Chooses names for a partial result beside the output, which no other input or output of this call has: it may
  /// go on from an earlier partial result.
  void choose_partial_names() {
    if (options_.no_partial || is_stream(output_)) return;
    const auto is_free = [&](const std::string& infix) {
      for (std::size_t i = 0; i < scene_.files().size(); ++i) {
        const fs::path main = with_infix(target(i), infix);
        std::vector<fs::path> places = {main};
        for (const fs::path& name : external_files(scene_.document(i), target(i).filename(), infix))
          places.push_back(main.parent_path() / name);
        for (const fs::path& place : places)
          if (places_.has(place) || !can_be_replaced(place)) return false;
      }
      return true;
    };
    partial_infix_ = partial_infix;
    for (int number = 2; !is_free(partial_infix_); ++number)
      partial_infix_ = fmt::format("{}.{}", partial_infix, number);
  }

  std::vector<std::string> partial_places() const {
    std::vector<std::string> paths;
    for (std::size_t i = 0; i < scene_.files().size(); ++i)
      paths.push_back(with_infix(target(i), partial_infix_).string());
    return paths;
  }

  /// Shows that outputs are written, unless one goes to standard output, which may be the same terminal.
  void begin_writing() {
    const std::array outputs = {output_,       options_.report, options_.picture,
                                options_.view, options_.record, options_.highlight};
    if (std::any_of(outputs.begin(), outputs.end(), is_stream))
      display_.clear();
    else
      display_.begin("write");
  }

  bool float32_digits() const { return result_.report.precision == Precision::float32; }

  /// Adds the result under its names, or beside those with an infix, and certifies what is read back.
  void add_result(StagedOutput& outputs, const std::string& infix = {}) {
    if (is_stream(output_)) {
      std::string bytes = scene_.patched(0, result_.positions, float32_digits())[0].bytes;
      verify(Document::parse(bytes, scene_.document(0).format()).surface());
      return outputs.add(output_, std::move(bytes));
    }
    // The files of a scene all have names; what is a link in their folder is replaced.
    const auto links = options_.is_scene() ? StagedFiles::Links::replaced : StagedFiles::Links::followed;
    std::vector<Document> documents;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < scene_.files().size(); ++i) {
      const std::vector<OutputFile> files = scene_.patched(i, result_.positions, float32_digits(),
                                                           infix.empty() ? name_giver(i) : target(i).filename(), infix);
      const fs::path written = outputs.add(with_infix(target(i), infix), files, links);
      documents.push_back(Document::read(written, scene_.document(i).format()));
      names.push_back(scene_.files()[i].name);
    }
    verify(SceneDocument(std::move(documents), std::move(names)).surface());
  }

  /// The certificate is worth nothing if the file says something else.
  void verify(const Surface& written) {
    const std::string broken = broken_promise(result_, repair_options_, surface(), written, certifier());
    if (!broken.empty())
      throw std::logic_error(fmt::format("the written file was removed, because reading it back shows: {}", broken));
    if (options_.is_scene() || !nesting_.chains.empty()) written_ = written.positions;
  }

  /// Counts what lies inside what, as read back where it was written.
  void describe_nesting() {
    const std::span<const double> after = written_.empty() ? result_.positions : written_;
    files_.nested =
        nested_pairs(surface(), after, certifier().find_intersections(after), nesting_, repair_options_.find);
  }

  /// By file, as read back where it was written.
  void describe_files() {
    const std::span<const double> after = written_.empty() ? result_.positions : written_;
    files_.scene = scene_report(surface(), scene_.files(), certifier().find_intersections(surface().positions), after,
                                certifier().find_intersections(after));
    for (std::size_t i = 0; i < scene_.files().size(); ++i) {
      SceneFileReport& file = files_.scene.files[i];
      file.input = options_.inputs[i];
      file.format = to_string(scene_.document(i).format());
      if (!files_.output.empty()) file.output = target(i).string();
    }
  }

  void add_pictures(StagedOutput& outputs) {
    if (options_.highlight.empty() && options_.picture.empty()) return;
    const std::vector<IntersectingPair> pairs_before = certifier().find_intersections(surface().positions);
    const std::vector<IntersectingPair> pairs_after = certifier().find_intersections(result_.positions);
    if (!options_.highlight.empty())
      outputs.add(options_.highlight, highlight_file(surface(), result_.positions, pairs_before, pairs_after));
    if (picture_kind(options_.picture) != PictureKind::still) {
      add_animation(options_.picture, surface(), scene_.files(), result_, outputs);
    } else if (!options_.picture.empty()) {
      PictureOptions picture;
      picture.files = scene_.files();
      picture.width = options_.picture_width;
      picture.height = options_.picture_width / 2;
      picture.before_label = picture_label("before", pairs_before.size());
      picture.after_label = picture_label("after", pairs_after.size());
      const SurfaceView before = surface();
      const SurfaceView after = {result_.positions, before.corners, before.offsets};
      outputs.add(options_.picture, picture_png(before, intersecting_faces(pairs_before), after,
                                                intersecting_faces(pairs_after), picture));
    }
  }

  void add_recording(StagedOutput& outputs) const {
    if (options_.record.empty()) return;
    outputs.add(options_.record, recording_json(result_, surface()) + "\n");
  }

  /// Measures the file read and, where one was written, what is read back from it.
  void measure_clearances() {
    if (options_.report.empty() && options_.min_dihedral_deg <= 0) return;
    const Surface& input = surface();
    const auto measured = [&](std::span<const double> positions, std::size_t pairs) {
      return measure_clearance(input, positions, repair_options_.find, pairs == 0);
    };
    files_.clearance_before = measured(input.positions, result_.report.before.total());
    if (files_.output.empty()) return;
    const std::vector<double> written = scene_.as_written(result_.positions, float32_digits());
    files_.clearance_after =
        written == input.positions ? files_.clearance_before : measured(written, result_.report.after.total());
  }

  void add_report(StagedOutput& outputs) const {
    if (options_.report.empty()) return;
    outputs.add(options_.report, report_json(result_, repair_options_, files_) + "\n");
  }

  void add_view(StagedOutput& outputs) {
    if (options_.view.empty()) return;
    const Appearance appearance = scene_.appearance();
    for (const std::string& note : appearance.notes) display_.say("note: {}", note);
    PageSource source;
    source.appearance = &appearance;
    source.input_name = scene_name(options_.inputs);
    source.output_name = files_.output.empty() ? "" : page_name(files_.output);
    source.before = surface();
    source.files = scene_.files();
    source.after = result_.positions;
    source.find = repair_options_.find;
    source.goal = repair_options_.goal;
    source.report = report_json(result_, repair_options_, files_);
    source.frames = result_.frames;
    outputs.add(options_.view, view_page(built_in_page(), source));
  }

  StageClock clock_;
  const FixOptions& options_;
  Interruption& interruption_;
  std::string output_;
  std::string partial_infix_;  // of the names of a partial result; empty: none is kept
  FilePlaces places_;
  ProgressDisplay display_;
  MemoryGuard memory_guard_;
  SceneDocument scene_;
  RepairOptions repair_options_;
  WantedNesting wanted_nesting_;
  const Nesting& nesting_;              // no chains: it does not matter
  std::optional<Certifier> certifier_;  // of the input; made when first needed
  RepairResult result_;
  std::vector<double> written_;  // positions of several files, or of nested surfaces, as read back
  ReportFiles files_;
};

/// The report about an input that was not repaired, so that no earlier one is taken for its own. Nothing but a report
/// is overwritten: the files that a broken input refers to are not known.
void write_refusal(const FixOptions& options, std::string_view status, ExitCode exit_code, const std::string& error,
                   Interruption& interruption) {
  const fs::path path = options.report;
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
    return options.sequence ? run_sequence(options, interruption) : Fix(options, interruption).run();
  } catch (const FileError& error) {
    if (!options.sequence) write_refusal(options, "invalid_input", exit_invalid_input, error.what(), interruption);
    throw;
  } catch (const SystemError& error) {
    if (!options.sequence) write_refusal(options, "system_error", exit_system_error, error.what(), interruption);
    throw;
  }
}

}  // namespace unsnarl::app
