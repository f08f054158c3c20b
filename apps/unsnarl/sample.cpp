#include "sample.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <stdexcept>

#include "command_options.h"
#include "mesh_input.h"
#include "staged_output.h"
#include "standard_streams.h"
#include "suggestions.h"
#include "surface_files.h"
#include "text/read_number.h"
#include "unsnarl/curves.h"
#include "unsnarl/exit_code.h"
#include "unsnarl/link.h"
#include "unsnarl/routes.h"
#include "unsnarl/samples.h"
#include "usage_error.h"

namespace unsnarl::app {
namespace {

/// Samples of curves are called by it and a kind of random_closed_curve.
constexpr std::string_view curve_prefix = "curve_";
/// Samples of knots and links are called by it and a name of knot_table.
constexpr std::string_view knot_prefix = "knot_";
/// Samples of plans are called by it and a name of route_plan_samples.
constexpr std::string_view routes_prefix = "routes_";
constexpr double curve_points = 600, curve_seed = 1;

/// The kind of curve that a sample is called after; empty: it is a surface.
std::string_view kind_of_curve(std::string_view name) {
  for (const std::string_view kind : random_curve_kinds())
    if (name.starts_with(curve_prefix) && name.substr(curve_prefix.size()) == kind) return kind;
  return {};
}

/// The entry that a sample is called after; null: it is no knot.
const KnotEntry* knot_of(std::string_view name) {
  if (!name.starts_with(knot_prefix)) return nullptr;
  for (const KnotEntry& entry : knot_table())
    if (entry.name == name.substr(knot_prefix.size())) return &entry;
  return nullptr;
}

/// The unknot that a sample is called after; null: it is none.
const UnknotEntry* unknot_of(std::string_view name) {
  if (!name.starts_with(knot_prefix)) return nullptr;
  for (const UnknotEntry& entry : unknot_table())
    if (entry.name == name.substr(knot_prefix.size())) return &entry;
  return nullptr;
}

/// The plan that a sample is called after; null: it is none.
const RoutePlanSample* plan_of(std::string_view name) {
  if (!name.starts_with(routes_prefix)) return nullptr;
  for (const RoutePlanSample& sample : route_plan_samples())
    if (sample.name == name.substr(routes_prefix.size())) return &sample;
  return nullptr;
}

/// Surfaces, curves, knots and plans.
std::vector<std::string> all_names() {
  std::vector<std::string> names;
  for (const Sample& sample : all_samples()) names.push_back(sample.name);
  for (const std::string_view kind : random_curve_kinds()) names.push_back(fmt::format("{}{}", curve_prefix, kind));
  for (const KnotEntry& entry : knot_table()) names.push_back(fmt::format("{}{}", knot_prefix, entry.name));
  for (const UnknotEntry& entry : unknot_table()) names.push_back(fmt::format("{}{}", knot_prefix, entry.name));
  for (const RoutePlanSample& sample : route_plan_samples())
    names.push_back(fmt::format("{}{}", routes_prefix, sample.name));
  return names;
}

/// Throws UsageError where no sample is called so.
void require_known(const std::string& name) {
  const std::vector<std::string> names = all_names();
  if (std::find(names.begin(), names.end(), name) != names.end()) return;
  throw UsageError(fmt::format("there is no sample '{}'.{} 'unsnarl sample --list' names all samples", name,
                               did_you_mean(name, names)));
}

/// One line on each kind of samples that are no surfaces.
std::string list_of_others() {
  std::string names;
  for (const std::string_view kind : random_curve_kinds())
    names += fmt::format("{}{}{}", names.empty() ? "" : ", ", curve_prefix, kind);
  std::string links;
  for (const KnotEntry& entry : knot_table())
    if (entry.name.find_first_not_of("0123456789_") != std::string::npos)
      links += fmt::format(", {}{}", knot_prefix, entry.name);
  std::string unknots;
  for (const UnknotEntry& entry : unknot_table())
    unknots += fmt::format("{}{}{}", unknots.empty() ? "" : ", ", knot_prefix, entry.name);
  std::string plans;
  for (const RoutePlanSample& sample : route_plan_samples())
    plans += fmt::format("{}{}{}", plans.empty() ? "" : ", ", routes_prefix, sample.name);
  return fmt::format(
      "Random closed curves, for 'unsnarl curves': {}\nKnots, for 'unsnarl seifert': {}3_1 to {}10_165, as in "
      "Rolfsen's table{}\nUnknots, for 'unsnarl knot-isotopy': {}\nPlans, for 'unsnarl routes': {}\n",
      names, knot_prefix, knot_prefix, links, unknots, plans);
}

/// A line for each surface, which begins with its name, an empty one, and the others.
std::string list_of_samples() {
  std::size_t width = 0;
  for (const Sample& sample : all_samples()) width = std::max(width, sample.name.size());
  std::string text;
  for (const Sample& sample : all_samples())
    text += fmt::format("{:<{}}  {}\n", sample.name, width, sample.description);
  return text + "\n" + list_of_others();
}

/// What a known sample is, and its parameters, in words.
std::string description_of(const std::string& name) {
  if (!kind_of_curve(name).empty())
    return fmt::format(
        "{}: a random closed curve in the plane that crosses itself\n"
        "  --set seed={}   which one (0 to 1e15)\n"
        "  --set points={}   number of points (8 to 100000)\n",
        name, curve_seed, curve_points);
  if (const KnotEntry* const entry = knot_of(name))
    return fmt::format("{}: {} points of the closure of a braid of {} strands and {} crossings\n", name,
                       knot_of_table(entry->name).point_count(), entry->strands, entry->braid.size());
  if (const UnknotEntry* const entry = unknot_of(name))
    return fmt::format("{}: {}, {} points\n", name, entry->description, knot_of_table(entry->name).point_count());
  if (const RoutePlanSample* const plan = plan_of(name)) return fmt::format("{}: {}\n", name, plan->description);
  const auto samples = all_samples();
  const auto found = std::find_if(samples.begin(), samples.end(), [&](const Sample& s) { return s.name == name; });
  std::string text = fmt::format("{}: {}\n", found->name, found->description);
  for (const SampleParameter& p : found->parameters)
    text += fmt::format("  --set {}={}   {} ({} to {})\n", p.name, p.value, p.description, p.minimum, p.maximum);
  return text;
}

std::map<std::string, double> parsed(const std::vector<std::string>& assignments) {
  std::map<std::string, double> values;
  for (const std::string& text : assignments) {
    const std::size_t equals = text.find('=');
    double value = 0;
    const char* const end = text.data() + text.size();
    const bool well_formed = equals != std::string::npos && equals > 0;
    const auto [stop, error] = read_number(well_formed ? text.data() + equals + 1 : end, end, value);
    if (!well_formed || error != std::errc{} || stop != end)
      throw UsageError(fmt::format("--set needs NAME=NUMBER, as in seed=4, not '{}'", text));
    values[text.substr(0, equals)] = value;
  }
  return values;
}

/// For samples that are written in one format and have no parameters. `kind`: what they are. Throws UsageError.
void require_plain(const SampleOptions& options, const char* kind, const std::string& format) {
  if (!options.parameters.empty())
    throw UsageError(fmt::format("--set: {} have no parameters; leave the option out", kind));
  if (options.resolution > 0)
    throw UsageError(fmt::format("--resolution: {} have no resolution; leave the option out", kind));
  if (!options.format.empty() && CLI::detail::to_lower(options.format) != format)
    throw UsageError(fmt::format("--format {}: {} are written as {}", options.format, kind, format));
  if (options.format.empty() && options.output != standard_stream &&
      !CLI::detail::to_lower(options.output).ends_with("." + format))
    throw UsageError(fmt::format("{}: name it *.{}, or add --format {}", options.output, format, format));
}

/// A curve as a file. Throws UsageError, std::invalid_argument.
std::string curve_file(const SampleOptions& options, std::string_view kind) {
  std::optional<CurveFormat> format =
      curve_format_from_extension(options.format.empty() ? options.output : options.format);
  if (!format && options.output == standard_stream && options.format.empty()) format = CurveFormat::json;
  if (!format) throw UsageError(options.output + ": name it *.svg or *.json, or add --format");
  if (options.resolution > 0) throw UsageError("--resolution: curves have no resolution; use --set points=N");
  double seed = curve_seed, points = curve_points;
  for (const auto& [name, value] : parsed(options.parameters)) {
    if (name != "seed" && name != "points")
      throw UsageError(fmt::format("--set {}: curves have the parameters seed and points only", name));
    (name == "seed" ? seed : points) = value;
  }
  if (!(seed >= 0 && seed <= 1e15)) throw UsageError(fmt::format("--set seed={}: seed must be from 0 to 1e15", seed));
  if (!(points >= 8 && points <= 100000))
    throw UsageError(fmt::format("--set points={}: points must be from 8 to 100000", points));
  const Curve curve = random_closed_curve(kind, static_cast<std::uint64_t>(seed), static_cast<int>(points));
  std::string list;
  double low_x = curve.points[0], low_y = curve.points[1], high_x = low_x, high_y = low_y;
  for (std::size_t k = 0; k < curve.points.size(); k += 2) {
    const double x = curve.points[k], y = curve.points[k + 1];
    list += format == CurveFormat::svg ? fmt::format("{}{},{}", k == 0 ? "" : " ", x, y)
                                       : fmt::format("{}[{}, {}]", k == 0 ? "" : ", ", x, y);
    low_x = std::min(low_x, x), high_x = std::max(high_x, x), low_y = std::min(low_y, y), high_y = std::max(high_y, y);
  }
  if (format == CurveFormat::json)
    return fmt::format("{{\"curves\": [{{\"name\": \"{}\", \"closed\": true, \"points\": [{}]}}]}}\n", kind, list);
  const double w = high_x - low_x, h = high_y - low_y, margin = 0.05 * std::max(w, h);
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"800\" viewBox=\"{} {} {} {}\">\n"
      "  <polygon id=\"{}\" fill=\"none\" stroke=\"black\" stroke-width=\"{}\" points=\"{}\"/>\n</svg>\n",
      low_x - margin, low_y - margin, w + 2 * margin, h + 2 * margin, kind, 0.002 * std::max(w, h), list);
}

}  // namespace

void add_sample_options(CLI::App& command, SampleOptions& options) {
  command.add_option(
      "NAME", options.name,
      "Name of the sample; --list shows all. Surfaces for 'unsnarl fix'; random closed curves for 'unsnarl curves' "
      "(curve_star, ...); knots and links for 'unsnarl seifert' (knot_3_1 to knot_10_165); unknots for 'unsnarl "
      "knot-isotopy' (knot_circle, knot_goeritz, ...); plans for 'unsnarl routes' (routes_star_6, ...)");
  command
      .add_option(
          "-o,--output", options.output,
          "File to write to: *.obj, *.off, *.ply or *.glb (curves: *.json or *.svg; knots: *.xyz; plans: *.json); "
          "'-' for standard output")
      ->type_name("OUT");
  command.add_option("--format", options.format, "File format, if the name does not show it")->type_name("FORMAT");
  command
      .add_option("--resolution", options.resolution,
                  "Number of steps along the longest direction. 0: that of the sample")
      ->check(whole_number_within(0, 2000))
      ->type_name("N");
  command.add_option("--set", options.parameters, "Change a parameter of the sample. May be repeated")
      ->type_name("NAME=VALUE");
  command.add_flag("--list", options.list, "List all samples. With NAME: describe it and its parameters");
  command.footer(
      "Examples:\n"
      "  unsnarl sample --list\n"
      "  unsnarl sample mobius_extended --list\n"
      "  unsnarl sample mobius_extended -o band.obj --resolution 100\n"
      "  unsnarl sample curve_star --set seed=4 --set points=500 -o star.svg");
}

int run_sample(const SampleOptions& options, Interruption& interruption) {
  if (!options.name.empty()) require_known(options.name);
  if (options.list) {
    write_to_stream(standard_stream, options.name.empty() ? list_of_samples() : description_of(options.name));
    return exit_embedded;
  }
  if (options.name.empty())
    throw UsageError("'unsnarl sample' needs the name of a sample; 'unsnarl sample --list' names all samples");
  if (options.output.empty()) throw UsageError("-o OUT is missing: the file to write to, or '-' for standard output");
  if (const std::string_view kind = kind_of_curve(options.name); !kind.empty()) {
    write_file(options.output, curve_file(options, kind), interruption);
    return exit_embedded;
  }
  if (knot_of(options.name) != nullptr || unknot_of(options.name) != nullptr) {
    require_plain(options, "knots", "xyz");
    write_file(options.output, link_text(knot_of_table(options.name.substr(knot_prefix.size()))), interruption);
    return exit_embedded;
  }
  if (const RoutePlanSample* const plan = plan_of(options.name)) {
    require_plain(options, "plans", "json");
    write_file(options.output, route_plan_json(sample_route_plan(plan->name)), interruption);
    return exit_embedded;
  }
  std::optional<Format> format = format_from_name(options.format);
  if (!format) format = options.output == standard_stream ? Format::obj : format_from_extension(options.output);
  if (!format) throw UsageError(options.output + ": name it *.obj, *.off, *.ply or *.glb, or add --format");
  std::string bytes;
  try {
    const Surface surface = make_sample(options.name, options.resolution, parsed(options.parameters));
    const auto sample = std::find_if(all_samples().begin(), all_samples().end(),
                                     [&](const Sample& s) { return s.name == options.name; });
    bytes = surface_file(surface, *format, fmt::format("unsnarl sample {}", options.name), sample->groups);
  } catch (const std::invalid_argument& e) {
    throw UsageError(e.what());
  }
  write_file(options.output, bytes, interruption);
  return exit_embedded;
}

}  // namespace unsnarl::app
