#include "curves.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

#include "cancellable_work.h"
#include "command_options.h"
#include "file_places.h"
#include "input_bytes.h"
#include "mesh_input.h"
#include "progress.h"
#include "staged_output.h"
#include "standard_streams.h"
#include "unsnarl/curves.h"
#include "unsnarl/exit_code.h"
#include "unsnarl/paths.h"
#include "unsnarl/version.h"
#include "unsnarl/visible_text.h"
#include "usage_error.h"

namespace unsnarl::app {
namespace {

/// A message names so many places at most.
constexpr std::size_t most_places = 5;

CurveDocument read_curves(const CurvesOptions& options) {
  std::optional<CurveFormat> format;
  if (!options.format.empty()) format = curve_format_from_extension(options.format);
  if (options.input != standard_stream) {
    if (!format && !curve_format_from_extension(options.input))
      throw FileError(options.input + ": name it *.svg or *.json, or add --format");
    return CurveDocument::read(options.input, options.flatten, format);
  }
  if (!format) throw UsageError("the format of standard input is unknown; add --format svg or --format json");
  return CurveDocument::parse(read_bytes(standard_stream), *format, options.flatten);
}

/// The curves of the file, those fixed that --fix names.
std::vector<Curve> curves_to_move(const CurveDocument& document, const std::vector<std::string>& fix) {
  std::vector<Curve> curves = document.curves();
  for (const std::string& wanted : fix) {
    bool found = false;
    const auto hold = [&](std::size_t c) {
      curves[c].fixed.assign(curves[c].size(), 1);
      found = true;
    };
    for (std::size_t c = 0; c < curves.size(); ++c)
      if (document.ids()[c] == wanted) hold(c);
    std::size_t number = 0;
    const auto [end, error] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), number);
    if (!found && error == std::errc{} && end == wanted.data() + wanted.size() && number < curves.size()) hold(number);
    if (!found)
      throw UsageError(fmt::format(
          "--fix {}: no curve has this id or name; use an id or name from the file, or a number from 0 to {}", wanted,
          curves.empty() ? 0 : curves.size() - 1));
  }
  return curves;
}

std::string name_of(const std::vector<Curve>& curves, std::int32_t c) {
  return curves[c].name.empty() ? fmt::format("curve {}", c) : visible_text(curves[c].name);
}

std::string place_of(const std::vector<Curve>& curves, const CurveCrossing& crossing) {
  return fmt::format("segment {} of {} and segment {} of {}", crossing.segment_a, name_of(curves, crossing.curve_a),
                     crossing.segment_b, name_of(curves, crossing.curve_b));
}

std::string count_of(std::size_t count, const char* what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

/// Everything around one call.
class Curves {
 public:
  Curves(const CurvesOptions& options, Interruption& interruption)
      : options_(options),
        interruption_(interruption),
        display_(options.progress, options.quiet),
        document_(read_curves(options)) {}

  int run() {
    check_outputs();
    for (const std::string& note : document_.notes()) display_.say("note: {}", note);
    const std::vector<Curve> input = curves_to_move(document_, options_.fix);
    if (!options_.integrand.empty()) write_integrand(input);
    if (options_.output.empty()) return exit_embedded;

    CurveOptions wanted;
    wanted.gap_rel = options_.gap;
    wanted.junction_rel = options_.junction;
    wanted.fix_ends = options_.fix_ends;
    wanted.move_strands = options_.move_strands;
    wanted.recover = !options_.no_recover;
    wanted.time_limit_s = options_.time_limit_s;
    result_ = cancellable(display_, options_.quiet, interruption_, options_.input,
                          [&](Context* context) { return untangle_curves(input, wanted, context); });
    display_.clear();

    const bool any_moved = result_.report.moved_points + result_.report.inserted_points > 0;
    const bool is_written = result_.status == Status::embedded || (result_.status == Status::obstructed && any_moved) ||
                            options_.keep_partial;
    StagedOutput outputs(interruption_);
    if (is_written) add_output(outputs);
    if (!options_.picture.empty()) add_picture(outputs);
    if (!options_.report.empty()) add_report(is_written, outputs);
    outputs.commit();
    if (!options_.quiet) summarise(is_written);
    return exit_code_of(result_.status);
  }

 private:
  void check_outputs() const {
    if (options_.output.empty() && options_.integrand.empty())
      throw UsageError("-o OUT is missing: the file to write the result to, or '-' for standard output");
    const std::optional<CurveFormat> format =
        is_stream(options_.output) ? std::nullopt : curve_format_from_extension(options_.output);
    if (format && *format != document_.format())
      throw UsageError(fmt::format("{}: the result keeps the format of the input, {}; name it *.{}", options_.output,
                                   to_string(document_.format()), to_string(document_.format())));
    FilePlaces places;
    places.reads("the input", options_.input);
    places.writes("-o", options_.output);
    places.writes("--report", options_.report);
    places.writes("--picture", options_.picture);
    places.writes("--integrand", options_.integrand);
    places.require_writable(interruption_);
  }

  void add_output(StagedOutput& outputs) {
    const std::string bytes = written_curves(document_, result_);
    require_kept(bytes);
    if (is_stream(options_.output)) {
      outputs.add(options_.output, bytes);
      return;
    }
    const std::filesystem::path place = outputs.add(path_of(options_.output), {OutputFile{{}, bytes}});
    require_kept(read_bytes(place.string()));
  }

  void require_kept(const std::string& bytes) const {
    const std::string faults = curve_file_faults(document_, bytes, result_);
    if (!faults.empty())
      throw WriteError(fmt::format(
          "{}: no file written: after rounding to the numbers of this file, {}. If elements have transforms, "
          "apply them to the coordinates first",
          options_.output, faults));
  }

  void write_integrand(const std::vector<Curve>& curves) {
    if (options_.integrand_curve < 0 || static_cast<std::size_t>(options_.integrand_curve) >= curves.size())
      throw UsageError(fmt::format("--integrand-curve {}: the file has {}; curves are counted from 0",
                                   options_.integrand_curve, count_of(curves.size(), "curve")));
    write_file(options_.integrand, curve_integrand_png(curves[options_.integrand_curve], options_.bandwidth),
               interruption_);
  }

  void add_picture(StagedOutput& outputs) const {
    const std::string picture =
        curve_picture_svg(result_.joined, result_.report.before, result_.curves, result_.report.left);
    outputs.add(options_.picture, picture);
  }

  void add_report(bool is_written, StagedOutput& outputs) const {
    nlohmann::ordered_json json = {{"schema", "unsnarl-curves-report"},
                                   {"schema_version", 3},
                                   {"version", version},
                                   {"input", options_.input},
                                   {"output", is_written ? options_.output : ""}};
    json.update(nlohmann::ordered_json::parse(curve_report_json(result_)));
    outputs.add(options_.report, json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
  }

  void summarise(bool is_written) const {
    const CurveReport& r = result_.report;
    std::string text = fmt::format("{}: {}, {}\n", visible_text(options_.input),
                                   count_of(result_.curves.size(), "curve"), count_of(r.points, "point"));
    if (r.crossings_before == 0) {
      text += "no crossings; the file stays as it is\n";
    } else {
      text += fmt::format("{}: {} before, {} after\n", to_string(result_.status),
                          count_of(r.crossings_before, "crossing"), r.crossings_after);
      const auto length = [&](double rel, const char* of = "") {
        return fmt::format("{:.2g} %{} ({:.2g})", 100 * rel, of, rel * r.diagonal);
      };
      text += fmt::format(
          "points moved {} on average, {} at most\n"
          "distance of the result from the drawing of the input: {} on average, {} at most\n"
          "distance of the drawing from the result: {} on average, {} at most; lost: {:.2g} % of its length\n",
          length(r.displacement_mean_rel, " of the diagonal"), length(r.displacement_max_rel),
          length(r.distance_mean_rel), length(r.distance_max_rel), length(r.drawing_distance_mean_rel),
          length(r.drawing_distance_max_rel), 100 * r.drawing_lost);
    }
    for (std::size_t k = 0; k < std::min(r.fixed.size(), most_places); ++k)
      text +=
          fmt::format("cannot be repaired: {} cross, and both must stay fixed\n", place_of(result_.curves, r.fixed[k]));
    if (r.fixed.empty())
      for (std::size_t k = 0; k < std::min(r.left.size(), most_places); ++k)
        text += fmt::format("still crossing: {}\n", place_of(result_.curves, r.left[k]));
    text += is_written ? fmt::format("wrote {}, {:.2f} s\n", visible_text(options_.output), r.seconds)
                       : "no file written; --keep-partial writes the incomplete result\n";
    tell(text);
  }

  const CurvesOptions& options_;
  Interruption& interruption_;
  ProgressDisplay display_;
  CurveDocument document_;
  CurveResult result_;
};

}  // namespace

void add_curves_options(CLI::App& command, CurvesOptions& options) {
  command.add_option("IN", options.input, "File with curves: *.svg or *.json; '-' for standard input")->required();
  command.add_option("-o,--output", options.output, "File to write the result to; '-' for standard output")
      ->type_name("OUT");
  command.add_option("--format", options.format, "File format, if the name does not show it")
      ->check(one_of({"svg", "json"}))
      ->type_name("svg|json");
  command.add_flag("--keep-partial", options.keep_partial,
                   "Write the result even if crossings are left or a limit was reached");
  const CLI::Validator fraction = number_within(1e-12, 0.1, unit::share_of_diagonal);
  command
      .add_option("--flatten", options.flatten,
                  "Largest distance between a Bézier curve or arc and the polyline that replaces it, as a fraction of "
                  "the bounding-box diagonal (default 0.0001)")
      ->check(fraction)
      ->type_name("NUMBER");
  command
      .add_option("--gap", options.gap,
                  "Distance between curves where a crossing was removed, as a fraction of the diagonal (default 0.004)")
      ->check(fraction)
      ->type_name("NUMBER");
  command
      .add_option("--junction", options.junction,
                  "An open curve that ends this near to another one ends on it, and stays there: a fraction of the "
                  "diagonal (default 1e-9), to which flattened curves add --flatten")
      ->check(number_within(0, 0.1, unit::share_of_diagonal))
      ->type_name("NUMBER");
  command.add_flag("--move-strands", options.move_strands,
                   "Keep the points of every curve and their order, and move strands past each other. Default: curves "
                   "get points beside their crossings and are joined there in another way, which keeps the drawing");
  const std::string what = "What may move";
  command
      .add_option("--fix", options.fix,
                  "Keep fixed the curves of this id (SVG) or name (JSON), or the curve of this number, counted from 0. "
                  "May be repeated")
      ->type_name("ID")
      ->allow_extra_args(false)
      ->group(what);
  command.add_flag("--fix-ends", options.fix_ends, "Keep the ends of open curves fixed")->group(what);
  add_time_limit(command, options.time_limit_s);
  add_quiet(command, options.quiet);
  const std::string shown = outputs_to_look_at;
  command
      .add_option("--report", options.report,
                  "Write a JSON report: number of crossings, how far points moved, what is left")
      ->type_name("FILE")
      ->group(shown);
  command.add_option("--picture", options.picture, "Write a picture of the curves before and after, crossings in red")
      ->check(file_named({"svg"}))
      ->type_name("FILE.svg")
      ->group(shown);
  command
      .add_option("--integrand", options.integrand,
                  "Write a picture of the integrand of the self-contact energy over pairs of points of one curve (the "
                  "paper's Fig. 4). Works without -o")
      ->check(file_named({"png"}))
      ->type_name("FILE.png")
      ->group(research_options);
  command
      .add_option("--integrand-curve", options.integrand_curve,
                  "With --integrand: number of the curve, counted from 0 (default 0)")
      ->check(whole_number_within(0, std::numeric_limits<std::int32_t>::max()))
      ->type_name("N")
      ->group(research_options);
  command
      .add_option("--bandwidth", options.bandwidth,
                  "With --integrand: bandwidth of the energy, as a fraction of the diagonal (default 0.05)")
      ->check(number_within(1e-6, 10.0, unit::share_of_diagonal))
      ->type_name("NUMBER")
      ->group(research_options);
  add_progress(command, options.progress, shown);
  command
      .add_flag("--no-recover", options.no_recover, "Stop when no crossing is left, without opening gaps and smoothing")
      ->group(research_options);
  command.footer(
      std::string(
          "Examples:\n"
          "  unsnarl curves drawing.svg -o out.svg --picture compare.svg\n"
          "  unsnarl curves map.svg -o out.svg --fix coast --fix-ends\n"
          "  unsnarl sample curve_star -o star.json && unsnarl curves star.json -o out.json --integrand map.png\n\n"
          "JSON: {\"curves\": [{\"points\": [[x, y], ...], \"closed\": true, \"fixed\": [point, ...], \"name\": "
          "\"...\"}]}; only \"points\" is needed.\n\n") +
      exit_codes({{exit_embedded, "no crossings"},
                  {exit_intersecting, "crossings are left"},
                  {exit_limit, "time limit reached"},
                  {exit_obstructed, "only crossings of segments that must stay fixed are left"}}));
}

int run_curves(const CurvesOptions& options, Interruption& interruption) {
  return Curves(options, interruption).run();
}

}  // namespace unsnarl::app
