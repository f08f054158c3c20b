#include "seifert.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "cancellable_work.h"
#include "command_options.h"
#include "file_places.h"
#include "input_bytes.h"
#include "mesh_input.h"
#include "staged_output.h"
#include "standard_streams.h"
#include "surface_files.h"
#include "unsnarl/exit_code.h"
#include "unsnarl/knot_isotopy.h"
#include "unsnarl/paths.h"
#include "unsnarl/pictures.h"
#include "unsnarl/seifert.h"
#include "unsnarl/version.h"
#include "unsnarl/visible_text.h"
#include "usage_error.h"

namespace unsnarl::app {
namespace {

std::string as_text(const SeifertFindings& f, int handles, bool is_brought = false) {
  const char* const expected = is_brought    ? "that of the start"
                               : handles > 0 ? "the diagram's with its handles"
                                             : "the diagram's";
  std::string text = fmt::format("{} component{}, genus {}, Euler characteristic {} ({}: {})\n", f.components,
                                 f.components == 1 ? "" : "s", f.genus, f.euler_characteristic, expected,
                                 f.expected_euler_characteristic);
  text += fmt::format("Alexander polynomial {} (the diagram's: {})\n", polynomial_text(f.alexander_of_surface),
                      polynomial_text(f.alexander_of_link));
  text += fmt::format("determinant {}, signature {}", f.determinant, f.signature);
  text += f.genus_is_least ? "; the polynomial's degree proves that no connected surface has a smaller genus\n" : "\n";
  return text;
}

nlohmann::ordered_json as_json(const SeifertFindings& f) {
  return {{"intersecting_pairs", f.intersecting_pairs},
          {"oriented", f.oriented},
          {"spans_link", f.spans_link},
          {"components", f.components},
          {"closed_components", f.closed_components},
          {"genus", f.genus},
          {"euler_characteristic", f.euler_characteristic},
          {"expected_euler_characteristic", f.expected_euler_characteristic},
          {"alexander_of_surface", f.alexander_of_surface},
          {"alexander_of_link", f.alexander_of_link},
          {"determinant", f.determinant},
          {"signature", f.signature},
          {"genus_is_least", f.genus_is_least},
          {"hold", f.hold()}};
}

/// Bytes that are not UTF-8, which names of files may have, become U+FFFD.
std::string text_of(const nlohmann::ordered_json& json) {
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

int check_file(const SeifertCommandOptions& options, const Link& link, FilePlaces& places, Interruption& interruption) {
  const Document document = read_mesh(options.check, format_from_name(options.format));
  claim_input(places, "--check", options.check, document);
  places.require_writable(interruption);
  SeifertFindings found;
  try {
    found = check_seifert_surface(document.surface(), link, options.views, options.handles);
  } catch (const std::invalid_argument& e) {
    throw FileError(fmt::format("{}: {}", options.check, e.what()));
  }
  if (!options.report.empty()) write_file(options.report, text_of(as_json(found)), interruption);
  if (!options.quiet)
    tell(as_text(found, options.handles) + seifert_faults(found) +
         (found.hold() ? "a Seifert surface of the link\n" : ""));
  return found.hold() ? exit_embedded : exit_intersecting;
}

int tell_failure(const SeifertCommandOptions& options, std::string why) {
  while (why.ends_with('\n')) why.pop_back();
  if (!options.surface.empty()) {
    if (!options.quiet)
      tell(fmt::format("{}: no surface could be certified: {}\n{}: no file written\n", visible_text(options.surface),
                       why, to_string(Status::no_progress)));
    return exit_code_of(Status::no_progress);
  }
  if (!options.quiet)
    tell(
        fmt::format("{}: no surface could be certified: {}. Strands may be too close to each other for double "
                    "precision; move them apart\n{}: no file written\n",
                    visible_text(options.input), why, to_string(Status::no_progress)));
  return exit_code_of(Status::no_progress);
}

}  // namespace

void add_seifert_options(CLI::App& command, SeifertCommandOptions& options) {
  command.add_option(
      "IN", options.input,
      "File with a knot or link: points 'x y z', one per line, an empty line between components; or a planar "
      "diagram code, 'X[1,4,2,5] X[3,6,4,1] X[5,2,6,3]'; or a DT or Gauss code; or a braid, 'braid 2: 1 1 1'. '-' "
      "for standard input. Not needed with --surface");
  command
      .add_option("-o,--output", options.output,
                  "File to write the surface to: *.obj, *.off or *.ply; '-' for standard output")
      ->type_name("OUT");
  command.add_option("--format", options.format, "File format, if the name does not show it")
      ->check(one_of({"obj", "off", "ply"}))
      ->type_name("obj|off|ply");
  command
      .add_option(
          "--edge", options.edge,
          "Edge length inside the surface, as a fraction of the diagonal (0.001 to 0.5). 0 (default): that of the "
          "link, between 1/45 and 1/20 of the diagonal")
      ->check(number_within(0, 0.5, unit::share_of_diagonal))
      ->type_name("NUMBER");
  command
      .add_option("--views", options.views,
                  "Number of directions tried for the simplest diagram (3 to 10000, default 60)")
      ->check(whole_number_within(3, 10000))
      ->type_name("N");
  command
      .add_option("--handles", options.handles,
                  "Number of handles to add (0 to 100, default 0); each raises the genus by one")
      ->check(whole_number_within(0, 100))
      ->type_name("N");
  command.add_flag("--no-fair", options.no_fair,
                   "Do not smooth the surface; leave it as Seifert's algorithm builds it");
  command
      .add_option("--time-limit", options.time_limit_s,
                  "Stop smoothing, and before it --relax, after this many seconds each. 0: no limit")
      ->check(not_negative(unit::seconds))
      ->type_name("SECONDS");
  add_quiet(command, options.quiet);
  command.add_option("--check", options.check, "Certify this surface instead of making one")->type_name("MESH");
  command
      .add_option("--surface", options.surface,
                  "Start from this surface, which may intersect itself: it is untangled with its boundary held, then "
                  "smoothed")
      ->type_name("MESH");
  command.add_flag(
      "--relax", options.relax,
      "Let the knot repel itself first, until it comes to rest; the surface spans that shape. For knots of "
      "one component and up to 2,000 points");
  command.add_option("--wire", options.wire, "Write the link that the surface spans: points 'x y z', one per line")
      ->type_name("FILE.xyz");
  command
      .add_option("--tube", options.tube,
                  "Write a tube around the link: *.obj, *.off or *.ply. It does not run through itself and meets the "
                  "surface in a single band of faces along each component")
      ->type_name("FILE");
  const std::string shown = outputs_to_look_at;
  command.add_option("--report", options.report, "Write a JSON report: what was certified")
      ->type_name("FILE")
      ->group(shown);
  command.add_option("--picture", options.picture, "Write a picture of the surface before and after smoothing")
      ->check(file_named({"png"}))
      ->type_name("FILE.png")
      ->group(shown);
  add_progress(command, options.progress, shown);
  command.footer(
      std::string("Examples:\n"
                  "  unsnarl sample knot_4_1 -o knot.xyz\n"
                  "  unsnarl seifert knot.xyz -o surface.obj --picture surface.png\n"
                  "  echo 'braid 3: 1 -2 1 -2 1 -2' | unsnarl seifert - -o borromean.obj\n"
                  "  unsnarl seifert --surface start.obj -o surface.obj\n"
                  "  unsnarl seifert knot.xyz --relax --wire relaxed.xyz --tube tube.obj -o surface.obj\n"
                  "  unsnarl seifert knot.xyz --check surface.obj\n\n") +
      exit_codes({{exit_embedded, "a certified surface"}, {exit_intersecting, "none found (--check: not certified)"}}));
}

int run_seifert(const SeifertCommandOptions& options, Interruption& interruption) {
  if (options.input.empty() == options.surface.empty())
    throw UsageError("'unsnarl seifert' needs a file IN with a link, or --surface MESH, whose boundary is one");
  if (!options.surface.empty() && (!options.check.empty() || options.handles > 0))
    throw UsageError("--surface goes neither with --check nor with --handles");
  if (options.output.empty() == options.check.empty())
    throw UsageError("'unsnarl seifert' needs -o OUT, to make a surface, or --check MESH, to certify one");
  if (options.relax && !(options.check.empty() && options.surface.empty()))
    throw UsageError("--relax goes neither with --check nor with --surface: the boundary of these stays");
  if (!options.check.empty() && !(options.wire.empty() && options.tube.empty()))
    throw UsageError("--wire and --tube do not go with --check: they belong to a surface that is made");
  FilePlaces places;
  if (options.surface.empty()) places.reads("the input", options.input);
  places.writes("-o", options.output);
  places.writes("--report", options.report);
  places.writes("--picture", options.picture);
  places.writes("--wire", options.wire);
  places.writes("--tube", options.tube);
  Link link;
  Surface start;
  std::optional<int> euler_characteristic;
  if (options.surface.empty()) {
    link = read_link(options.input);
  } else {
    const Document document = read_mesh(options.surface, {});
    claim_input(places, "--surface", options.surface, document);
    start = {{document.surface().positions.begin(), document.surface().positions.end()},
             {document.surface().corners.begin(), document.surface().corners.end()},
             {document.surface().offsets.begin(), document.surface().offsets.end()}};
    try {
      SpanningBoundary boundary = spanning_boundary(start);
      link = std::move(boundary.link);
      euler_characteristic = boundary.euler_characteristic;
    } catch (const std::invalid_argument& e) {
      throw FileError(fmt::format("{}: {}", options.surface, e.what()));
    }
  }
  const std::string& source = options.surface.empty() ? options.input : options.surface;
  if (!options.check.empty()) return check_file(options, link, places, interruption);
  std::optional<Format> format = format_from_name(options.format);
  if (!format) format = format_from_extension(options.output);
  if (format != Format::obj && format != Format::off && format != Format::ply)
    throw UsageError(options.output + ": name it *.obj, *.off or *.ply, or add --format");
  std::optional<Format> tube_format;
  if (!options.tube.empty()) {
    tube_format = format_from_extension(options.tube);
    if (tube_format != Format::obj && tube_format != Format::off && tube_format != Format::ply)
      throw UsageError(options.tube + ": name it *.obj, *.off or *.ply");
  }
  places.require_writable(interruption);

  std::optional<RelaxedWire> relaxed;
  if (options.relax) {
    try {
      relaxed = cancellable(options.progress, options.quiet, interruption, source,
                            [&](Context* context) { return relaxed_wire(link, options.time_limit_s, context); });
    } catch (const std::invalid_argument& e) {
      throw FileError(fmt::format("{}: {}", source, e.what()));
    }
    if (relaxed->status == Status::cancelled) {
      if (!options.quiet) tell(fmt::format("{}: nothing was written\n", to_string(relaxed->status)));
      return exit_cancelled;
    }
    link = relaxed->link;
  }
  SeifertOptions wanted;
  wanted.edge_rel = options.edge;
  wanted.views = options.views;
  wanted.fair = !options.no_fair;
  wanted.handles = options.handles;
  wanted.time_limit_s = options.time_limit_s;
  const auto make = [&](Context* context) {
    return options.surface.empty() ? seifert_surface(link, wanted, context)
                                   : untangled_seifert_surface(start, wanted, context);
  };
  const SeifertResult result = cancellable(options.progress, options.quiet, interruption, source, make);
  if (result.status == Status::cancelled) {
    if (!options.quiet) tell(fmt::format("{}: nothing was written\n", to_string(result.status)));
    return exit_cancelled;
  }
  if (result.status == Status::no_progress) return tell_failure(options, result.message);

  const std::string bytes =
      surface_file(result.surface, *format, fmt::format("Seifert surface of {}, by unsnarl", source));
  SeifertFindings found;
  const auto certify = [&](const Document& document) {
    try {
      found = check_seifert_surface(document.surface(), link, options.views, options.handles, euler_characteristic);
    } catch (const std::invalid_argument& e) {
      throw FileError(fmt::format("{}: {}; no file written", source, e.what()));
    }
    return found.hold();
  };
  StagedOutput outputs(interruption);
  std::optional<Document> written;
  if (is_stream(options.output)) {
    written = Document::parse(bytes, *format);
    outputs.add(options.output, bytes);
  } else {
    const std::filesystem::path place = outputs.add(path_of(options.output), {OutputFile{{}, bytes}});
    written = Document::read(place, *format);
  }
  if (!certify(*written)) return tell_failure(options, seifert_faults(found));
  KnotTube tube;
  if (!options.tube.empty()) {
    tube = knot_tube(link, result.surface);
    if (tube.radius > 0) {
      const std::string tube_bytes =
          surface_file(tube.surface, *tube_format, fmt::format("tube around {}, by unsnarl", source));
      if (!is_clear_tube(Document::parse(tube_bytes, *tube_format).surface(), written->surface()))
        throw std::logic_error("the tube to be written does not hold");
      outputs.add(options.tube, tube_bytes);
    }
  }
  if (!options.wire.empty()) outputs.add(options.wire, link_text(link));
  if (!options.picture.empty()) {
    wanted.fair = false;
    PictureOptions picture;
    picture.before_label = options.surface.empty() ? "Seifert's algorithm" : "as brought";
    picture.after_label = "faired";
    picture.inset = false;
    outputs.add(options.picture, picture_png(options.surface.empty() ? seifert_surface(link, wanted).surface : start,
                                             {}, result.surface, {}, picture));
  }
  if (!options.report.empty()) {
    nlohmann::ordered_json json = {{"schema", "unsnarl-seifert-report"},
                                   {"schema_version", 2},
                                   {"version", version},
                                   {"input", source},
                                   {"output", options.output},
                                   {"points", link.point_count()},
                                   {"link_components", link.components.size()},
                                   {"crossings", result.crossings},
                                   {"seifert_circles", result.circles},
                                   {"handles", options.handles},
                                   {"vertices", result.surface.positions.size() / 3},
                                   {"faces", result.surface.view().face_count()},
                                   {"area", result.area},
                                   {"fairing_stopped", result.status == Status::time_limit},
                                   {"seconds", result.seconds}};
    if (relaxed) {
      json["at_rest"] = relaxed->at_rest;
      json["energy"] = relaxed->energy;
    }
    if (!options.tube.empty()) json["tube_radius"] = tube.radius;
    json.update(as_json(found));
    outputs.add(options.report, text_of(json));
  }
  outputs.commit();
  if (!options.quiet) {
    tell(fmt::format("{}: {} points, {} component{}", visible_text(source), link.point_count(), link.components.size(),
                     link.components.size() == 1 ? "" : "s"));
    tell(options.surface.empty()
             ? fmt::format("; seen with {} crossings and {} Seifert circles\n", result.crossings, result.circles)
             : " on the boundary, which was held\n");
    tell(fmt::format("{} faces, no two intersect; its boundary is the link, point by point\n",
                     result.surface.view().face_count()));
    tell(as_text(found, options.handles, !options.surface.empty()));
    if (relaxed)
      tell(fmt::format("the knot {}, with energy {:.2f}\n",
                       relaxed->at_rest ? "came to rest" : "was relaxed, but did not come to rest", relaxed->energy));
    if (tube.radius > 0)
      tell(
          fmt::format("a tube of radius {:.3g} does not run through itself, and meets the surface in a single band "
                      "of faces along each component\n",
                      tube.radius));
    if (!result.message.empty()) tell(result.message + "\n");
    if (result.status == Status::time_limit) tell("smoothing was stopped by the time limit\n");
    tell(fmt::format("wrote {}, {:.1f} s\n", visible_text(options.output), result.seconds));
    if (!options.tube.empty() && !(tube.radius > 0))
      tell("no tube was written: even a thin one would touch the surface elsewhere\n");
  }
  return exit_embedded;
}

}  // namespace unsnarl::app
