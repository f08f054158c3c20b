#include "fix.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

#include "contact/intersection_finder.h"
#include "exit_code.h"
#include "intersecting_faces.h"
#include "mesh_input.h"
#include "progress.h"
#include "render/picture.h"
#include "render/png.h"
#include "repair/measure.h"
#include "repair/prepared_surface.h"
#include "repair/report_json.h"
#include "staged_output.h"
#include "standard_streams.h"
#include "surface_files.h"
#include "unsnarl/certify.h"
#include "view_page.h"

namespace unsnarl::app {
namespace {

namespace fs = std::filesystem;

class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

bool is_same_file(const fs::path& a, const fs::path& b) {
  std::error_code ignored;
  return a.lexically_normal() == b.lexically_normal() || fs::equivalent(a, b, ignored);
}

/// Refuses what would overwrite the input or one output with another, before any work is done.
std::string checked_output(const FixOptions& options) {
  const bool from_stream = options.input == standard_stream;
  if (options.in_place) {
    if (!options.output.empty()) throw UsageError("--in-place and -o exclude each other: give one of them");
    if (from_stream) throw UsageError("--in-place needs a file, not standard input");
  } else if (options.output.empty()) {
    throw UsageError("where should the result go? Give -o OUT ('-' for standard output), or --in-place");
  }
  std::vector<std::pair<std::string, std::string>> paths;  // option, path
  if (!from_stream && !options.in_place) paths.emplace_back("the input", options.input);
  paths.emplace_back(options.in_place ? "the input" : "-o", options.in_place ? options.input : options.output);
  for (const auto& [name, path] : {std::pair{"--report", options.report}, {"--highlight", options.highlight},
                                   {"--picture", options.picture}, {"--view", options.view}})
    if (!path.empty()) paths.emplace_back(name, path);
  for (std::size_t i = 0; i < paths.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const std::string &a = paths[j].second, &b = paths[i].second;
      const bool both_streams = a == standard_stream && b == standard_stream;
      if (both_streams || (!is_stream(a) && !is_stream(b) && is_same_file(a, b)))
        throw UsageError(fmt::format("{} and {} are the same ({}); {}", paths[j].first, paths[i].first, b,
                                     paths[j].first == "the input" && paths[i].first == "-o"
                                         ? "use --in-place to overwrite the input"
                                         : "give them different names"));
    }
  return paths[from_stream || options.in_place ? 0 : 1].second;
}

/// The result is the input's file with other positions, so it cannot change its format.
void check_format_of_output(const std::string& output, const Document& document) {
  const std::optional<Format> format = is_stream(output) ? std::nullopt : format_from_extension(output);
  if (format && *format != document.format())
    throw UsageError(fmt::format("{}: the result keeps the format of the input, {}; name it *.{}", output,
                                 to_string(document.format()), to_string(document.format())));
}

RepairOptions repair_options(const FixOptions& options, const Document& document) {
  RepairOptions result;
  result.find = options.find();
  result.goal = options.goal_wanted();
  if (options.precision == "float32") result.precision = Precision::float32;
  if (options.precision == "float64") result.precision = Precision::float64;
  if (document.stores_float32()) {
    if (result.precision == Precision::float64)
      throw UsageError(fmt::format("--precision float64: this {} file stores 32-bit numbers; leave the option out",
                                   to_string(document.format())));
    result.precision = Precision::float32;
  }
  const double diagonal = diagonal_of(document.surface());
  const double unit = options.absolute && diagonal > 0 ? 1 / diagonal : 1;
  result.max_displacement_rel = options.max_displacement * unit;
  result.min_gap_rel = options.min_gap * unit;
  result.time_limit_s = options.time_limit_s;
  result.memory_limit_mb = options.memory_limit_mb;
  result.paper = options.paper;
  result.recover = !options.no_recover;
  result.as_written = [&document](std::span<const double> positions, bool float32) {
    return document.as_written(positions, float32);
  };
  if (!options.fix_vertices.empty())
    result.fixed = read_vertex_flags(options.fix_vertices, document.surface().view().vertex_count());
  return result;
}

bool is_to_be_written(const RepairResult& result, const Surface& input, bool keep_partial) {
  switch (result.status) {
    case Status::embedded: return true;
    // Nothing to repair but what cannot be: a refusal.
    case Status::obstructed: return result.positions != input.positions;
    default: return keep_partial;
  }
}

/// What the file that was written holds, against what the status promises. Empty: the promise is kept.
std::string broken_promise(const RepairResult& result, const RepairOptions& options, const Surface& input,
                           const Surface& read_back) {
  if (read_back.corners != input.corners || read_back.offsets != input.offsets ||
      read_back.positions.size() != input.positions.size())
    return "its faces are not those of the input";
  const Certificate certificate = certify(input, read_back.positions, options.find);
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
        document_(read_mesh(options.input, format_from_name(options.format))),
        repair_options_(repair_options(options, document_)) {
    check_format_of_output(output_, document_);
    files_.before_repair.push_back({"read", clock_.seconds(), peak_memory_mb()});
  }

  int run() {
    if (!options_.view.empty()) require_viewer();
    for (const std::string& note : document_.notes()) say("note: {}", note);
    // A folder that is missing or must not be written to is found now rather than after the work.
    if (!is_stream(output_)) StagedOutput(output_, interruption_);

    Context context;
    context.on_progress = [&](const Context::Progress& progress) { display_.show(progress); };
    interruption_.set_handler([&] {
      context.cancel();
      if (!options_.quiet) tell("\nstopping; once more to end at once\n");
    });
    result_ = repair(surface(), repair_options_, &context);
    interruption_.set_handler(nullptr);
    display_.clear();

    const Stopwatch writing;
    if (is_to_be_written(result_, surface(), options_.keep_partial)) write_output();
    files_.after_repair.push_back({"write", writing.seconds(), peak_memory_mb()});

    const ExitCode exit_code = exit_code_of(result_.status);
    write_pictures();
    write_report(exit_code);
    write_view();
    summarise();
    return exit_code;
  }

 private:
  const Surface& surface() const { return document_.surface(); }

  template <class... Args>
  void say(fmt::format_string<Args...> text, Args&&... args) {
    if (options_.quiet) return;
    display_.clear();
    tell(fmt::format(text, std::forward<Args>(args)...) + "\n");
  }

  void write_output() {
    const bool float32_digits = result_.report.precision == Precision::float32;
    std::vector<OutputFile> files = document_.patched(result_.positions, float32_digits);
    if (is_stream(output_)) {
      if (files.size() > 1)
        throw UsageError("this glTF keeps its geometry in other files, which cannot go to a stream; give -o FILE");
      verify(Document::parse(files[0].bytes, document_.format()));
      write_to_stream(output_, files[0].bytes);
    } else {
      StagedOutput staged(output_, interruption_);
      staged.write(files);
      refuse_to_overwrite_input_buffers(staged.targets());
      verify(Document::read(staged.main_file(), document_.format()));
      staged.commit();
    }
    files_.output = output_;
  }

  /// The certificate is worth nothing if the file says something else.
  void verify(const Document& written) const {
    const std::string broken = broken_promise(result_, repair_options_, surface(), written.surface());
    if (!broken.empty())
      throw std::logic_error(
          fmt::format("the file written does not hold what was certified: {}. It was removed", broken));
  }

  /// External buffers of a glTF keep their names, so beside the input they would replace the input's.
  void refuse_to_overwrite_input_buffers(const std::vector<fs::path>& targets) const {
    if (options_.in_place || options_.input == standard_stream) return;
    const fs::path main = fs::path(output_).parent_path(), source = fs::path(options_.input).parent_path();
    for (std::size_t i = 1; i < targets.size(); ++i)
      if (const fs::path own = source / targets[i].lexically_relative(main.empty() ? "." : main);
          is_same_file(targets[i], own))
        throw UsageError(fmt::format("{} holds part of the input and would be overwritten; write the result to another "
                                     "folder, or use --in-place",
                                     targets[i].string()));
  }

  void write_pictures() {
    if (options_.highlight.empty() && options_.picture.empty()) return;
    const PreparedSurface prepared = prepare(surface(), repair_options_.find);
    IntersectionFinder finder(prepared.triangles());
    const auto pairs_at = [&](std::span<const double> positions) {
      return pairs_of_faces(prepared, finder.find(prepared.gather(positions)));
    };
    const std::vector<IntersectingPair> pairs_before = pairs_at(surface().positions);
    const std::vector<IntersectingPair> pairs_after = pairs_at(result_.positions);
    if (!options_.highlight.empty())
      write_file(options_.highlight, highlight_file(surface(), result_.positions, pairs_before, pairs_after),
                 interruption_);
    if (!options_.picture.empty()) {
      PictureOptions picture;
      const auto label = [](const char* when, std::size_t pairs) {
        return fmt::format("{}\n{}", when, pairs == 0   ? "no self-intersections"
                                           : pairs == 1 ? "1 intersecting pair of faces"
                                                        : fmt::format("{} intersecting pairs of faces", pairs));
      };
      picture.before_label = label("before", pairs_before.size());
      picture.after_label = label("after", pairs_after.size());
      const SurfaceView before = surface();
      const SurfaceView after = {result_.positions, before.corners, before.offsets};
      write_file(options_.picture,
                 encode_png(render_pair(before, faces_in(pairs_before), after, faces_in(pairs_after), picture)),
                 interruption_);
    }
  }

  void write_report(ExitCode exit_code) {
    if (options_.report.empty() && options_.view.empty()) return;
    files_.input = options_.input;
    files_.format = to_string(document_.format());
    files_.vertices = surface().view().vertex_count();
    files_.faces = surface().view().face_count();
    files_.triangulation = triangulate(surface()).statistics.describe();
    files_.notes = document_.notes();
    files_.exit_code = exit_code;
    files_.seconds = clock_.seconds();
    if (!options_.report.empty()) write_file(options_.report, report().dump(2) + "\n", interruption_);
  }

  nlohmann::ordered_json report() const { return report_json(result_, repair_options_, files_); }

  void write_view() {
    if (options_.view.empty()) return;
    PageSource source;
    source.input_name = page_name(options_.input);
    source.output_name = files_.output.empty() ? "" : page_name(files_.output);
    source.before = surface();
    source.after = result_.positions;
    source.find = repair_options_.find;
    source.goal = repair_options_.goal;
    source.report = report();
    write_file(options_.view, view_page(source), interruption_);
  }

  void summarise() {
    const RepairReport& r = result_.report;
    const auto counts = [](const PairCounts& pairs) {
      if (pairs.total() == 0) return std::string("none");
      std::string text;
      for (std::size_t i = 0; i < pair_class_count; ++i)
        if (pairs.by_class[i] > 0)
          text += fmt::format("{}{} {}", text.empty() ? "" : ", ", pairs.by_class[i], pair_class_names[i]);
      return text;
    };
    say("{}: {} vertices, {} faces, {} component{}", options_.input == standard_stream ? "mesh" : options_.input,
        surface().view().vertex_count(), surface().view().face_count(), r.topology.components,
        r.topology.components == 1 ? "" : "s");
    say("  intersecting pairs before: {}", counts(r.before));
    say("  intersecting pairs after:  {}", counts(r.after));
    if (result_.positions != surface().positions)
      say("  moved {:.3g} % of the vertices, by {:.2g} % of the diagonal at most, {:.2g} % on average",
          100 * (1 - r.untouched_share), 100 * r.displacement_max_rel, 100 * r.displacement_mean_rel);
    for (const Obstruction& obstruction : r.obstructions) say("  cannot be resolved: {}", obstruction.message);
    say("  {}{}; {:.2f} s, {:.0f} MB", explanation(), float32_remark(), clock_.seconds(), peak_memory_mb());
    if (!files_.output.empty())
      say("  {}", output_ == standard_stream ? "written to standard output" : "wrote " + output_);
    else if (result_.status != Status::obstructed)
      say("  nothing written; --keep-partial writes what was reached");
    else
      say("  nothing written, since nothing else was to be repaired");
  }

  std::string explanation() const {
    switch (result_.status) {
      case Status::embedded:
        return repair_options_.goal == Goal::all ? "embedded: no self-intersection is left"
                                                 : "no faces that share no vertex intersect any more";
      case Status::reduced: return "reduced: some self-intersections are left";
      case Status::no_progress: return "no progress: nothing better than the input was found";
      case Status::obstructed: return "obstructed: only what no motion of the vertices can resolve is left";
      case Status::time_limit: return "stopped at the time limit";
      case Status::memory_limit: return "stopped at the memory limit";
      case Status::displacement_exceeded: return "displacement exceeded: a vertex had to move further than allowed";
      case Status::cancelled: return "interrupted";
    }
    return "unknown status";
  }

  std::string float32_remark() const {
    if (result_.status != Status::embedded || result_.report.float32_embedded) return "";
    return " (in double precision; readers that round to 32 bits may see some)";
  }

  Stopwatch clock_;
  const FixOptions& options_;
  Interruption& interruption_;
  std::string output_;
  ProgressDisplay display_;
  Document document_;
  RepairOptions repair_options_;
  RepairResult result_;
  ReportFiles files_;
};

}  // namespace

void add_fix_options(CLI::App& command, FixOptions& options) {
  add_mesh_options(command, options);
  command.add_option("-o,--output", options.output, "Where the repaired mesh goes; '-' for standard output")
      ->type_name("OUT");
  command.add_flag("--in-place", options.in_place, "Overwrite IN with the repaired mesh");
  command.add_flag("--keep-partial", options.keep_partial,
                   "Write the result also where self-intersections are left or a limit was reached");
  const std::string what = "What may move";
  command.add_option("--fix-vertices", options.fix_vertices, "File with the 0-based ids of vertices that must not move")
      ->type_name("FILE")
      ->group(what);
  command
      .add_option("--max-displacement", options.max_displacement,
                  "How far any vertex may move, as a fraction of the bounding-box diagonal; 0: any distance")
      ->check(not_negative())
      ->type_name("X")
      ->group(what);
  command
      .add_option("--min-gap", options.min_gap,
                  "Wanted gap between sheets, as a fraction of the diagonal; 0: just enough to be safe")
      ->check(not_negative())
      ->type_name("X")
      ->group(what);
  command.add_flag("--absolute", options.absolute, "These two are lengths in the units of the mesh")->group(what);
  command
      .add_option("--precision", options.precision,
                  "Number format in which the result must hold: 'float32' as most programs read it, 'float64',\n"
                  "or 'auto' (default): float32 where the coordinates allow it")
      ->check(one_of({"auto", "float32", "float64"}))
      ->type_name("auto|float32|float64");
  const std::string limits = "Limits";
  command.add_option("--time-limit", options.time_limit_s, "Stop after this many seconds; 0: none")
      ->check(not_negative())
      ->type_name("S")
      ->group(limits);
  command.add_option("--memory-limit", options.memory_limit_mb, "Stop when the program holds this many MB; 0: none")
      ->check(not_negative())
      ->type_name("MB")
      ->group(limits);
  const std::string shown = "What is shown";
  command.add_option("--report", options.report, "Write a JSON report: counts, displacement, regions, seconds, ...")
      ->type_name("FILE")
      ->group(shown);
  command.add_option("--picture", options.picture, "Write a picture, before and after, intersecting faces in red")
      ->type_name("FILE.png")
      ->group(shown);
  command.add_option("--view", options.view, "Write a page to look at: before, after, displacement (see unsnarl view)")
      ->type_name("PAGE.html")
      ->group(shown);
  command.add_option("--highlight", options.highlight, "Write a PLY in which intersecting faces are coloured")
      ->type_name("FILE.ply")
      ->group(shown);
  command
      .add_option("--progress", options.progress,
                  "On standard error: a line if it is a terminal ('auto', default), JSON lines, or 'none'")
      ->check(one_of({"auto", "json", "none"}))
      ->type_name("auto|json|none")
      ->group(shown);
  const std::string research = "For research";
  command.add_flag("--paper", options.paper, "Repair as the paper does it, instead of region by region")
      ->group(research);
  command.add_flag("--no-recover", options.no_recover, "Stop after untangling, without moving back toward the input")
      ->group(research);
  command.footer(
      "Examples:\n"
      "  unsnarl fix hand.obj -o hand_fixed.obj\n"
      "  unsnarl fix scan.ply -o fixed.ply --picture fixed.png --report fixed.json\n"
      "  unsnarl fix body.glb --in-place --max-displacement 0.01 --fix-vertices seam.txt\n\n"
      "Exit codes: 0 embedded, 1 self-intersections left, 2 usage, 3 cannot read, 4 cannot write, 5 limit reached,\n"
      "6 interrupted, 7 all repaired but what no motion can resolve, 70 internal error.");
}

int run_fix(const FixOptions& options, Interruption& interruption) { return Fix(options, interruption).run(); }

}  // namespace unsnarl::app
