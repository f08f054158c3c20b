#include "fix.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>
#include <optional>

#include "fix_summary.h"
#include "intersecting_faces.h"
#include "memory_guard.h"
#include "mesh_input.h"
#include "pictures.h"
#include "progress.h"
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
#include "usage_error.h"
#include "viewer.h"

namespace unsnarl::app {
namespace {

namespace fs = std::filesystem;

bool is_same_file(const fs::path& a, const fs::path& b) {
  std::error_code ignored;
  return a.lexically_normal() == b.lexically_normal() || fs::equivalent(a, b, ignored);
}

/// Refuses what would overwrite the input or one output with another, before any work is done.
std::string checked_output(const FixOptions& options) {
  scene_names(options.inputs);  // throws where two are the same
  const bool from_stream = options.inputs[0] == standard_stream;
  if (options.is_scene() && options.in_place)
    throw UsageError("--in-place takes one file; of several, give -o FOLDER for all of them");
  if (options.is_scene() && is_stream(options.output))
    throw UsageError(fmt::format("-o {}: several files need a folder to go to", options.output));
  if (options.in_place) {
    if (!options.output.empty()) throw UsageError("--in-place and -o exclude each other: give one of them");
    if (from_stream) throw UsageError("--in-place needs a file, not standard input");
  } else if (options.output.empty()) {
    throw UsageError("where should the result go? Give -o OUT ('-' for standard output), or --in-place");
  }
  std::vector<std::pair<std::string, std::string>> paths;  // option, path
  const std::string& output = options.in_place ? options.inputs[0] : options.output;
  if (!from_stream && !options.in_place)
    for (const std::string& input : options.inputs) paths.emplace_back("the input", input);
  if (options.is_scene())
    for (const std::string& input : options.inputs)
      paths.emplace_back("-o", (fs::path(output) / fs::path(input).filename()).string());
  else
    paths.emplace_back(options.in_place ? "the input" : "-o", output);
  for (const auto& [name, path] : {std::pair{"--report", options.report},
                                   {"--highlight", options.highlight},
                                   {"--picture", options.picture},
                                   {"--record", options.record},
                                   {"--view", options.view}})
    if (!path.empty()) paths.emplace_back(name, path);
  for (std::size_t i = 0; i < paths.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const std::string &a = paths[j].second, &b = paths[i].second;
      const bool both_streams = a == standard_stream && b == standard_stream;
      if (both_streams || (!is_stream(a) && !is_stream(b) && is_same_file(a, b)))
        throw UsageError(fmt::format("{} and {} are the same ({}); {}", paths[j].first, paths[i].first, b,
                                     paths[j].first != "the input" || paths[i].first != "-o"
                                         ? "give them different names"
                                     : options.is_scene() ? "name another folder"
                                                          : "use --in-place to overwrite the input"));
    }
  return output;
}

/// The result is the input's file with other positions, so it cannot change its format.
void check_format_of_output(const std::string& output, const Document& document) {
  const std::optional<Format> format = is_stream(output) ? std::nullopt : format_from_extension(output);
  if (format && *format != document.format())
    throw UsageError(fmt::format("{}: the result keeps the format of the input, {}; name it *.{}", output,
                                 to_string(document.format()), to_string(document.format())));
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

/// The promise of the status that what was just written breaks. Empty: none.
std::string broken_promise(const RepairResult& result, const RepairOptions& options, const Surface& input,
                           const Surface& read_back, Certifier& certifier) {
  if (read_back.corners != input.corners || read_back.offsets != input.offsets ||
      read_back.positions.size() != input.positions.size())
    return "its faces are not those of the input";
  const Certificate certificate = certifier.certify(read_back.positions);
  if (!certificate.seams_closed) return "a seam of the input is open in it";
  const PairCounts &after = certificate.pairs, &before = result.report.before;
  const std::size_t disjoint = after[PairClass::disjoint];
  const bool all = options.goal == Goal::all;
  if (result.status == Status::embedded && (all ? after.total() : disjoint) > 0)
    return fmt::format("{} pairs of faces intersect in it", all ? after.total() : disjoint);
  if (result.status == Status::embedded && all && !certificate.embedded())
    return fmt::format("{} faces have lost their area", certificate.new_zero_area_faces);
  if (disjoint > before[PairClass::disjoint] || (all && after.total() > before.total()))
    return fmt::format("more pairs of faces intersect in it than in the input: {} against {}", after.total(),
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
        display_(progress_style(options.progress, options.quiet)),
        memory_guard_(options.memory_limit_mb),
        scene_(read_scene(options.inputs, format_from_name(options.format))),
        repair_options_(repair_options(options, scene_)) {
    if (!options.is_scene()) {
      check_format_of_output(output_, scene_.document(0));
      files_.input = options_.inputs[0];
      files_.format = to_string(scene_.document(0).format());
    }
    if (options.recompute_normals && !scene_.recompute_normals())
      say("note: --recompute-normals: there are no vertex normals in {} that could be updated", names_of(scene_));
    files_.vertices = surface().view().vertex_count();
    files_.faces = surface().view().face_count();
    files_.notes = scene_.notes();
    files_.before_repair.push_back(clock_.stage("read"));
  }

  int run() {
    if (!options_.view.empty()) require_viewer();
    for (const std::string& note : scene_.notes()) say("note: {}", note);
    // A folder that is missing or must not be written to is found now rather than after the work.
    std::optional<OutputFolder> folder;
    if (options_.is_scene()) folder.emplace(output_);
    for (std::size_t i = 0; i < scene_.files().size(); ++i)
      if (!is_stream(output_)) StagedOutput(target(i), interruption_);
    if (picture_kind(options_.picture) == PictureKind::folder) prepare_picture_folder(options_.picture);

    Context context;
    context.on_progress = [&](const Context::Progress& progress) { display_.show(progress); };
    interruption_.set_handler([&] {
      context.cancel();
      if (!options_.quiet) tell("\nstopping; once more to end at once\n");
    });
    result_ = repair(surface(), repair_options_, &context);
    interruption_.set_handler(nullptr);
    display_.clear();

    const StageClock writing;
    if (is_to_be_written(result_, surface(), options_.keep_partial)) write_output();
    if (options_.is_scene()) describe_files();
    files_.after_repair.push_back(writing.stage("write"));

    write_pictures();
    write_recording();
    measure_clearances();
    files_.whole = clock_.stage("fix");
    write_report();
    write_view();
    if (!options_.quiet) {
      display_.clear();
      tell(fix_summary(result_, repair_options_, files_));
    }
    return exit_code_of(result_.status);
  }

 private:
  const Surface& surface() const { return scene_.surface(); }
  /// Path that a file of the scene is written to.
  fs::path target(std::size_t file) const {
    return options_.is_scene() ? fs::path(output_) / scene_.files()[file].name : fs::path(output_);
  }
  Certifier& certifier() {
    if (!certifier_) certifier_.emplace(surface(), repair_options_.find);
    return *certifier_;
  }

  template <class... Args>
  void say(fmt::format_string<Args...> text, Args&&... args) {
    if (options_.quiet) return;
    display_.clear();
    tell(fmt::format(text, std::forward<Args>(args)...) + "\n");
  }

  bool float32_digits() const { return result_.report.precision == Precision::float32; }

  void write_output() {
    std::vector<OutputFile> all;
    for (std::size_t i = 0; i < scene_.files().size(); ++i) {
      std::vector<OutputFile> files = scene_.patched(i, result_.positions, float32_digits());
      if (!is_stream(output_)) refuse_to_overwrite_buffers(i, files);
      if (options_.is_scene()) files[0].name = scene_.files()[i].name;
      for (OutputFile& file : files) {
        if (std::any_of(all.begin(), all.end(), [&](const OutputFile& other) { return other.name == file.name; }))
          throw UsageError(
              fmt::format("two of the files keep geometry in a file called {}, which would go to one "
                          "place; repair them apart, or rename it in one of them",
                          file.name.string()));
        all.push_back(std::move(file));
      }
    }
    if (is_stream(output_)) {
      if (all.size() > 1)
        throw UsageError("this glTF keeps its geometry in other files, which cannot go to a stream; give -o FILE");
      verify(Document::parse(all[0].bytes, scene_.document(0).format()).surface());
      write_to_stream(output_, all[0].bytes);
    } else {
      // The files of a scene all have names; what is a link in their folder is replaced.
      StagedOutput staged(options_.is_scene() ? fs::path(output_) / ".scene" : target(0), interruption_);
      staged.write(all);
      verify(read_back(staged).surface());
      staged.commit();
    }
    files_.output = output_;
  }

  SceneDocument read_back(const StagedOutput& staged) const {
    std::vector<Document> documents;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < scene_.files().size(); ++i) {
      names.push_back(scene_.files()[i].name);
      const fs::path path = options_.is_scene() ? staged.staged(names.back()) : staged.main_file();
      documents.push_back(Document::read(path, scene_.document(i).format()));
    }
    return {std::move(documents), std::move(names)};
  }

  /// The certificate is worth nothing if the file says something else.
  void verify(const Surface& written) {
    const std::string broken = broken_promise(result_, repair_options_, surface(), written, certifier());
    if (!broken.empty())
      throw std::logic_error(
          fmt::format("the file written does not hold what was certified: {}. It was removed", broken));
    if (options_.is_scene()) written_ = written.positions;
  }

  /// External buffers of a glTF keep their names, so beside the input they would replace the input's.
  void refuse_to_overwrite_buffers(std::size_t file, const std::vector<OutputFile>& files) const {
    const fs::path input = options_.inputs[file];
    if (options_.in_place || input == standard_stream) return;
    for (std::size_t i = 1; i < files.size(); ++i)
      if (const fs::path own = target(file).parent_path() / files[i].name;
          is_same_file(own, input.parent_path() / files[i].name))
        throw UsageError(
            fmt::format("{} holds part of the input and would be overwritten; write the result to another "
                        "folder, or use --in-place",
                        own.string()));
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

  void write_pictures() {
    if (options_.highlight.empty() && options_.picture.empty()) return;
    const std::vector<IntersectingPair> pairs_before = certifier().find_intersections(surface().positions);
    const std::vector<IntersectingPair> pairs_after = certifier().find_intersections(result_.positions);
    if (!options_.highlight.empty())
      write_file(options_.highlight, highlight_file(surface(), result_.positions, pairs_before, pairs_after),
                 interruption_);
    if (picture_kind(options_.picture) != PictureKind::still) {
      write_animation(options_.picture, surface(), scene_.files(), result_, interruption_);
    } else if (!options_.picture.empty()) {
      PictureOptions picture;
      picture.files = scene_.files();
      picture.width = options_.picture_width;
      picture.height = options_.picture_width / 2;
      const auto label = [](const char* when, std::size_t pairs) {
        return fmt::format("{}\n{}", when,
                           pairs == 0   ? "no self-intersections"
                           : pairs == 1 ? "1 intersecting pair of faces"
                                        : fmt::format("{} intersecting pairs of faces", pairs));
      };
      picture.before_label = label("before", pairs_before.size());
      picture.after_label = label("after", pairs_after.size());
      const SurfaceView before = surface();
      const SurfaceView after = {result_.positions, before.corners, before.offsets};
      write_file(options_.picture, picture_png(before, faces_in(pairs_before), after, faces_in(pairs_after), picture),
                 interruption_);
    }
  }

  void write_recording() {
    if (options_.record.empty()) return;
    write_file(options_.record, recording_json(result_, surface()) + "\n", interruption_);
  }

  /// Measures the file read and, where one was written, what is read back from it.
  void measure_clearances() {
    if (options_.report.empty() && options_.min_dihedral_deg <= 0) return;
    const Surface& input = surface();
    const auto measured = [&](std::span<const double> positions) {
      return measure_clearance(input, positions, repair_options_.find);
    };
    files_.clearance_before = measured(input.positions);
    if (files_.output.empty()) return;
    const std::vector<double> written = scene_.as_written(result_.positions, float32_digits());
    files_.clearance_after = written == input.positions ? files_.clearance_before : measured(written);
  }

  void write_report() {
    if (options_.report.empty()) return;
    write_file(options_.report, report_json(result_, repair_options_, files_) + "\n", interruption_);
  }

  void write_view() {
    if (options_.view.empty()) return;
    PageSource source;
    source.input_name = scene_name(options_.inputs);
    source.output_name = files_.output.empty() ? "" : page_name(files_.output);
    source.before = surface();
    source.files = scene_.files();
    source.after = result_.positions;
    source.find = repair_options_.find;
    source.goal = repair_options_.goal;
    source.report = report_json(result_, repair_options_, files_);
    source.frames = result_.frames;
    write_file(options_.view, view_page(viewer_template(), source), interruption_);
  }

  StageClock clock_;
  const FixOptions& options_;
  Interruption& interruption_;
  std::string output_;
  ProgressDisplay display_;
  MemoryGuard memory_guard_;
  SceneDocument scene_;
  RepairOptions repair_options_;
  std::optional<Certifier> certifier_;  // of the input; made when first needed
  RepairResult result_;
  std::vector<double> written_;  // positions of several files, as read back
  ReportFiles files_;
};

}  // namespace

int run_fix(const FixOptions& options, Interruption& interruption) {
  try {
    return options.sequence ? run_sequence(options, interruption) : Fix(options, interruption).run();
  } catch (const std::bad_alloc&) {
    if (options.memory_limit_mb <= 0) throw;
    tell(fmt::format("unsnarl: {} MB are not enough to read, examine and write this mesh; raise --memory-limit\n",
                     options.memory_limit_mb));
    return exit_limit;
  }
}

}  // namespace unsnarl::app
