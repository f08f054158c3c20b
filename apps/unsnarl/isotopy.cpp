#include "isotopy.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>

#include "cancellable_work.h"
#include "command_options.h"
#include "pictures.h"
#include "staged_output.h"
#include "standard_streams.h"
#include "surface_files.h"
#include "unsnarl/curves.h"
#include "unsnarl/exit_code.h"
#include "unsnarl/isotopy.h"
#include "unsnarl/paths.h"
#include "unsnarl/version.h"
#include "unsnarl/visible_text.h"
#include "usage_error.h"

namespace unsnarl::app {
namespace {

namespace fs = std::filesystem;

std::vector<Curve> read_curves(const std::string& path, double flatten) {
  std::vector<Curve> curves = CurveDocument::read(path, flatten).curves();
  for (Curve& curve : curves) {
    curve.fixed.clear();
    // Drawings often end where they began without saying that they are closed.
    const std::size_t n = curve.points.size();
    if (!curve.closed && n >= 8 && curve.points[0] == curve.points[n - 2] && curve.points[1] == curve.points[n - 1]) {
      curve.points.resize(n - 2);
      curve.closed = true;
    }
  }
  return curves;
}

void run_backwards(Curve& curve) {
  const std::size_t n = curve.size();
  for (std::size_t a = 0, b = n - 1; a < b; ++a, --b) {
    std::swap(curve.points[2 * a], curve.points[2 * b]);
    std::swap(curve.points[2 * a + 1], curve.points[2 * b + 1]);
  }
}

double signed_area(const Curve& curve) {
  double area = 0;
  // Seen from a point of the curve: far from the origin, products of the coordinates would round the area away.
  const auto x = [&](std::size_t k) { return curve.points[2 * k] - curve.points[0]; };
  const auto y = [&](std::size_t k) { return curve.points[2 * k + 1] - curve.points[1]; };
  for (std::size_t k = 0; k < curve.size(); ++k) {
    const std::size_t l = (k + 1) % curve.size();
    area += x(k) * y(l) - x(l) * y(k);
  }
  return area;
}

/// The number of the curve that a word of --pairs names: a number, a name, or what a name has in quotes.
std::int32_t curve_named(const std::string& word, std::span<const Curve> curves, const std::string& file) {
  if (!word.empty() && word.size() < 10 && word.find_first_not_of("0123456789") == std::string::npos)
    return std::stoi(word);
  for (std::size_t c = 0; c < curves.size(); ++c)
    if (!word.empty() && (curves[c].name == word || curves[c].name.find("'" + word + "'") != std::string::npos))
      return static_cast<std::int32_t>(c);
  throw UsageError(fmt::format("--pairs: no curve of {} is named \"{}\"", visible_text(file), visible_text(word)));
}

std::vector<std::array<std::int32_t, 2>> pairs_of(const IsotopyCommandOptions& options, std::span<const Curve> start,
                                                  std::span<const Curve> end) {
  std::vector<std::array<std::int32_t, 2>> pairs;
  for (const std::string& pair : options.pairs) {
    const std::size_t sign = pair.find('=');
    if (sign == std::string::npos)
      throw UsageError(fmt::format("--pairs: \"{}\" is no pair; write START=END, such as 0=1", visible_text(pair)));
    pairs.push_back({curve_named(pair.substr(0, sign), start, options.start),
                     curve_named(pair.substr(sign + 1), end, options.end)});
  }
  return pairs;
}

std::string how(const Isotopy& isotopy) {
  std::string text;
  switch (isotopy.method) {
    case IsotopyMethod::annulus: text = "an annulus between the curves"; break;
    case IsotopyMethod::untangled_annulus: text = "an annulus between the curves, untangled"; break;
    case IsotopyMethod::shortening:
      text = fmt::format("curves shortened {:.0f} % of the way to triangles", 100 * isotopy.shortened);
      break;
  }
  return text + fmt::format("; in between at least {:.0f} % of the lengths and {:.0f} % of the areas are kept",
                            100 * isotopy.length_kept, 100 * isotopy.area_kept);
}

std::string correspondence_json(const IsotopyCommandOptions& options, const Isotopy& isotopy) {
  const auto places = [](const std::vector<IsotopyPlace>& list) {
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    for (const IsotopyPlace& place : list) json.push_back({place.edge, place.fraction});
    return json;
  };
  nlohmann::ordered_json json = {{"schema", "unsnarl-isotopy"},
                                 {"schema_version", 2},
                                 {"version", version},
                                 {"start", options.start},
                                 {"end", options.end},
                                 {"method", to_string(isotopy.method)},
                                 {"shortened", isotopy.shortened},
                                 {"length_kept", isotopy.length_kept},
                                 {"area_kept", isotopy.area_kept},
                                 {"height", isotopy.height},
                                 {"seconds", isotopy.seconds},
                                 {"curves", nlohmann::ordered_json::array()},
                                 {"rings", nlohmann::ordered_json::array()}};
  for (std::size_t c = 0; c < isotopy.points.size(); ++c)
    json["curves"].push_back({{"becomes", isotopy.partner[c]},
                              {"points", isotopy.points[c]},
                              {"on_start", places(isotopy.on_start[c])},
                              {"on_end", places(isotopy.on_end[c])}});
  for (const IsotopyRing& ring : isotopy.rings) json["rings"].push_back({{"time", ring.time}, {"curves", ring.curves}});
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace

void add_isotopy_options(CLI::App& command, IsotopyCommandOptions& options) {
  command.add_option("START", options.start, "File with closed curves: *.svg or *.json")->required();
  command.add_option("END", options.end, "File with as many closed curves")->required();
  command.add_option("-o,--output", options.folder, "Folder for the results; it must be new or empty")
      ->required()
      ->type_name("DIR");
  command
      .add_option("--points", options.points,
                  "Points of every curve in the middle of the motion, at least; more where curves have more. 0: 200")
      ->check(whole_number_within(0, 100000))
      ->type_name("N");
  command.add_option("--frames", options.frames, "Number of SVG files, evenly spaced in time (2 to 10000, default 25)")
      ->check(whole_number_within(2, 10000))
      ->type_name("N");
  command
      .add_option(
          "--pairs", options.pairs,
          "Which curve becomes which: START=END, numbers from 0 or names, such as 0=1,a=b. Others are paired so "
          "that curves lie in each other alike and are near")
      ->delimiter(',')
      ->type_name("A=B,...");
  command.add_flag("--reverse", options.reverse, "Reverse curves of END that have the other orientation");
  command
      .add_option("--flatten", options.flatten,
                  "Largest distance between a Bézier curve or arc and the polyline that replaces it, as a fraction of "
                  "the bounding-box diagonal (default 0.0001)")
      ->check(number_within(1e-12, 0.1, unit::share_of_diagonal))
      ->type_name("NUMBER");
  add_time_limit(command, options.time_limit_s);
  add_progress(command, options.progress);
  add_quiet(command, options.quiet);
  command.footer(std::string("Written into DIR:\n"
                             "  surface.obj          the surface that the curves sweep; z is time\n"
                             "  animation.svg        the curves move from START to END and back\n"
                             "  frame_0000.svg ...   the curves at evenly spaced times\n"
                             "  correspondence.json  rings, and where the points of most lie on START and END\n\n"
                             "Examples:\n"
                             "  unsnarl isotopy spiral.svg square.svg -o way\n"
                             "  unsnarl isotopy letters.svg dots.json -o way --frames 100\n\n") +
                 exit_codes({{exit_embedded, "a certified isotopy"}, {exit_limit, "time limit reached"}}));
}

int run_isotopy(const IsotopyCommandOptions& options, Interruption& interruption) {
  const std::vector<Curve> start = read_curves(options.start, options.flatten);
  std::vector<Curve> end = read_curves(options.end, options.flatten);
  IsotopyOptions wanted;
  wanted.pairs = pairs_of(options, start, end);
  if (options.reverse) {
    const std::vector<std::int32_t> partner = isotopy_partners(start, end, wanted.pairs);
    for (std::size_t c = 0; c < start.size(); ++c)
      if (signed_area(start[c]) * signed_area(end[partner[c]]) < 0) run_backwards(end[partner[c]]);
  }
  prepare_picture_folder(options.folder, "-o");

  wanted.points = options.points;
  wanted.time_limit_s = options.time_limit_s;
  const Isotopy made =
      cancellable(options.progress, options.quiet, interruption, fmt::format("{}, {}", options.start, options.end),
                  [&](Context* context) { return planar_isotopy(start, end, wanted, context); });
  if (made.status != Status::embedded) {
    if (!options.quiet) tell(fmt::format("{}: no file written\n", to_string(made.status)));
    return exit_code_of(made.status);
  }

  const auto path = [&](const std::string& name) { return (path_of(options.folder) / path_of(name)).string(); };
  const std::string surface = surface_file(made.surface, Format::obj, "isotopy by unsnarl; z is time", {});
  StagedOutput outputs(interruption);
  const Document written =
      Document::read(outputs.add(path_of(path("surface.obj")), {OutputFile{{}, surface}}), Format::obj);
  FindOptions find;
  find.weld = Weld::none;
  if (written.surface().positions != made.surface.positions || written.surface().corners != made.surface.corners ||
      !find_intersections(written.surface(), find).empty())
    throw std::logic_error("the surface to be written is not the one that was certified");
  outputs.add(path("animation.svg"), isotopy_animation_svg(made));
  for (int k = 0; k < options.frames; ++k)
    outputs.add(path(fmt::format("frame_{:04}.svg", k)),
                isotopy_frame_svg(made, static_cast<double>(k) / (options.frames - 1)));
  outputs.add(path("correspondence.json"), correspondence_json(options, made));
  outputs.commit();
  if (!options.quiet)
    tell(fmt::format(
        "{} curve{}, {} rings, {} faces; no two faces intersect, so at every time no curve crosses itself or another\n"
        "{}\nwrote {}, {:.1f} s\n",
        start.size(), start.size() == 1 ? "" : "s", made.rings.size(), made.surface.view().face_count(), how(made),
        visible_text(options.folder), made.seconds));
  return exit_embedded;
}

}  // namespace unsnarl::app
