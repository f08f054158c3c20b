#include "knot_isotopy.h"

#include <fmt/format.h>

#include <filesystem>

#include "cancellable_work.h"
#include "command_options.h"
#include "file_places.h"
#include "input_bytes.h"
#include "mesh_input.h"
#include "pictures.h"
#include "staged_output.h"
#include "standard_streams.h"
#include "unsnarl/exit_code.h"
#include "unsnarl/knot_isotopy.h"
#include "unsnarl/paths.h"
#include "unsnarl/visible_text.h"
#include "usage_error.h"

namespace unsnarl::app {
namespace {

namespace fs = std::filesystem;

/// Double points that are named one by one.
constexpr std::size_t most_named = 12;

KnotMethod method_named(const std::string& name) {
  if (name == "direct") return KnotMethod::direct;
  return name == "relax" ? KnotMethod::relax : KnotMethod::automatic;
}

std::string as_text(const KnotIsotopyFindings& f) {
  std::string text;
  if (!f.ends_kept) text += "the first and last ring are not the two knots\n";
  if (f.meeting_triangles > 0) text += fmt::format("{} pairs of triangles in R^4 intersect\n", f.meeting_triangles);
  if (f.unproven_motions > 0)
    text +=
        fmt::format("between {} pairs of rings the moving polygon is not proven to be simple\n", f.unproven_motions);
  return text;
}

std::string as_text(const std::vector<KnotDoublePoint>& points) {
  std::string text;
  for (std::size_t k = 0; k < points.size() && k < most_named; ++k)
    text += fmt::format("  time {:.4f}, {:.5g} {:.5g} {:.5g}, sign {}\n", points[k].time, points[k].place[0],
                        points[k].place[1], points[k].place[2],
                        points[k].sign > 0   ? "+1"
                        : points[k].sign < 0 ? "-1"
                                             : "none: the triangles overlap");
  if (points.size() > most_named) text += fmt::format("  and {} more\n", points.size() - most_named);
  return text;
}

int check_file(const KnotIsotopyCommandOptions& options, const Link& start, const Link& end,
               Interruption& interruption) {
  KnotIsotopy isotopy;
  KnotIsotopyFindings found;
  parse_file(options.check, [&](const std::string& bytes) {
    isotopy = parse_knot_isotopy(bytes);
    found = check_knot_isotopy(isotopy, start, end);
  });
  isotopy.status = found.hold() ? Status::embedded : Status::no_progress;
  if (!options.report.empty()) {
    isotopy.found = "checked as it was given";
    isotopy.rings.clear();
    write_file(options.report, knot_isotopy_json(isotopy, found), interruption);
  }
  if (!options.quiet) tell(as_text(found) + (found.hold() ? "an isotopy between the two knots\n" : ""));
  return found.hold() ? exit_embedded : exit_intersecting;
}

}  // namespace

void add_knot_isotopy_options(CLI::App& command, KnotIsotopyCommandOptions& options) {
  command
      .add_option("START", options.start,
                  "File with a knot: points 'x y z', one per line; or a planar diagram code; or a braid, 'braid 2: 1 1 "
                  "1'. '-' for standard input")
      ->required();
  command.add_option("END", options.end, "File with the other knot")->required();
  command.add_option("-o,--output", options.folder, "Folder for the results; it must be new or empty")
      ->type_name("DIR");
  command
      .add_option(
          "--method", options.method,
          "relax: both knots repel themselves until they stop moving, and the two shapes are joined. direct: the "
          "cylinder of straight lines between the knots is untangled in R^4. auto (default): first relax, then "
          "direct")
      ->check(one_of({"auto", "direct", "relax"}))
      ->type_name("auto|direct|relax");
  command
      .add_option("--points", options.points,
                  "Points of the knot during the motion (16 to 2000). 0: as many as START or END has, but at least 200")
      ->check(whole_number_within(0, 2000))
      ->type_name("N");
  command
      .add_option("--frames", options.frames,
                  "Number of files with points, evenly spaced in time (2 to 1000, default 25)")
      ->check(whole_number_within(2, 1000))
      ->type_name("N");
  add_time_limit(command, options.time_limit_s);
  command.add_option("--check", options.check, "Certify this isotopy instead of making one")->type_name("ISOTOPY.json");
  command
      .add_option("--report", options.report, "Write a JSON report: what was certified, or where the search stopped")
      ->type_name("FILE");
  add_progress(command, options.progress);
  add_quiet(command, options.quiet);
  command.footer(
      std::string("Written into DIR:\n"
                  "  isotopy.json        the rings of the cylinder in R^4: times and points\n"
                  "  animation.gif       a tube around the moving knot\n"
                  "  picture.png         the knot at five times\n"
                  "  frame_0000.xyz ...  the knot at evenly spaced times\n\n"
                  "Examples:\n"
                  "  unsnarl sample knot_goeritz -o goeritz.xyz && unsnarl sample knot_circle -o circle.xyz\n"
                  "  unsnarl knot-isotopy goeritz.xyz circle.xyz -o way\n"
                  "  unsnarl knot-isotopy goeritz.xyz circle.xyz --check way/isotopy.json\n\n") +
      exit_codes({{exit_embedded, "a certified isotopy"},
                  {exit_intersecting, "none found (--check: not certified)"},
                  {exit_limit, "time limit reached"}}));
}

int run_knot_isotopy(const KnotIsotopyCommandOptions& options, Interruption& interruption) {
  if (options.folder.empty() == options.check.empty())
    throw UsageError(
        "'unsnarl knot-isotopy' needs -o DIR, to make an isotopy, or --check ISOTOPY.json, to certify one");
  FilePlaces places;
  places.reads("START", options.start);
  places.reads("END", options.end);
  places.reads("--check", options.check);
  places.writes("--report", options.report);
  const Link start = read_link(options.start), end = read_link(options.end);
  places.require_writable(interruption);
  if (!options.check.empty()) return check_file(options, start, end, interruption);
  const OutputFolder folder(path_of(options.folder));  // is gone again where nothing is written into it
  prepare_picture_folder(options.folder, "-o");

  KnotIsotopyOptions wanted;
  wanted.points = options.points;
  wanted.method = method_named(options.method);
  wanted.time_limit_s = options.time_limit_s;
  const KnotIsotopy made =
      cancellable(options.progress, options.quiet, interruption, fmt::format("{}, {}", options.start, options.end),
                  [&](Context* context) { return knot_isotopy(start, end, wanted, context); });
  if (made.status != Status::embedded) {
    if (!options.report.empty()) write_file(options.report, knot_isotopy_json(made, {}), interruption);
    if (!options.quiet) {
      if (made.status == Status::no_progress)
        tell(fmt::format("no isotopy was found; this does not prove that there is none\n{}\n", made.found));
      const auto& points = made.left_double_points.empty() ? made.straight_double_points : made.left_double_points;
      if (!points.empty()) tell("double points of the cylinder between the knots:\n" + as_text(points));
      tell(fmt::format("{}: no file written\n", to_string(made.status)));
    }
    return exit_code_of(made.status);
  }

  const auto path = [&](const std::string& name) { return (path_of(options.folder) / path_of(name)).string(); };
  StagedOutput outputs(interruption);
  KnotIsotopyFindings found = check_knot_isotopy(made, start, end);
  std::vector<OutputFile> files{{{}, knot_isotopy_json(made, found)},
                                {"animation.gif", knot_isotopy_gif(made)},
                                {"picture.png", knot_isotopy_png(made)}};
  for (int k = 0; k < options.frames; ++k)
    files.push_back({fmt::format("frame_{:04}.xyz", k),
                     link_text(knot_isotopy_slice(made, static_cast<double>(k) / (options.frames - 1)))});
  const fs::path written = outputs.add(path_of(path("isotopy.json")), files);
  found = check_knot_isotopy(parse_knot_isotopy(read_bytes(written.string())), start, end);
  if (!found.hold()) throw std::logic_error("the isotopy to be written does not hold: " + as_text(found));
  if (!options.report.empty()) {
    KnotIsotopy without_rings = made;
    without_rings.rings.clear();
    outputs.add(options.report, knot_isotopy_json(without_rings, found));
  }
  outputs.commit();
  if (!options.quiet)
    tell(
        fmt::format("{}{}\n{} rings of {} points; no two triangles of the cylinder in R^4 intersect, so at every time "
                    "the knot\ndoes not meet itself; the same holds for points that move straight from ring to ring\n"
                    "wrote {}, {:.1f} s\n",
                    made.found, made.reversed ? "; END was reversed" : "", made.rings.size(),
                    made.rings[1].points.size() / 3, visible_text(options.folder), made.seconds));
  return exit_embedded;
}

}  // namespace unsnarl::app
