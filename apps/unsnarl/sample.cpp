#include "sample.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <stdexcept>

#include "command_options.h"
#include "mesh_input.h"
#include "staged_output.h"
#include "standard_streams.h"
#include "surface_files.h"
#include "unsnarl/exit_code.h"
#include "unsnarl/samples.h"
#include "usage_error.h"

namespace unsnarl::app {
namespace {

std::string list_of_samples() {
  std::size_t width = 0;
  for (const Sample& sample : all_samples()) width = std::max(width, sample.name.size());
  std::string text;
  for (const Sample& sample : all_samples())
    text += fmt::format("{:<{}}  {}\n", sample.name, width, sample.description);
  return text;
}

std::string description_of(const std::string& name) {
  const auto samples = all_samples();
  const auto found = std::find_if(samples.begin(), samples.end(), [&](const Sample& s) { return s.name == name; });
  if (found == samples.end())
    throw UsageError(fmt::format("there is no sample '{}'; 'unsnarl sample --list' names them all", name));
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
    const auto [stop, error] = std::from_chars(well_formed ? text.data() + equals + 1 : end, end, value);
    if (!well_formed || error != std::errc{} || stop != end)
      throw UsageError(fmt::format("--set {}: give NAME=NUMBER", text));
    values[text.substr(0, equals)] = value;
  }
  return values;
}

}  // namespace

void add_sample_options(CLI::App& command, SampleOptions& options) {
  command.add_option("NAME", options.name, "Which one; see --list");
  command.add_option("-o,--output", options.output, "Where it goes: *.obj, *.off or *.ply; '-' for standard output")
      ->type_name("OUT");
  command.add_option("--format", options.format, "obj, off or ply, where the name does not tell")->type_name("FORMAT");
  command
      .add_option("--resolution", options.resolution, "Sampling steps along the longest direction; 0: the sample's own")
      ->check(CLI::Range(0, 2000).description(""))
      ->type_name("N");
  command.add_option("--set", options.parameters, "Change a parameter; may be repeated")->type_name("NAME=VALUE");
  command.add_flag("--list", options.list, "List all samples; with NAME: describe that one and its parameters");
  command.footer(
      "Examples:\n"
      "  unsnarl sample --list\n"
      "  unsnarl sample mobius_extended --list\n"
      "  unsnarl sample mobius_extended -o band.obj --resolution 100");
}

int run_sample(const SampleOptions& options, Interruption& interruption) {
  if (options.list) {
    write_to_stream(standard_stream, options.name.empty() ? list_of_samples() : description_of(options.name));
    return exit_embedded;
  }
  if (options.name.empty()) throw UsageError("which sample? 'unsnarl sample --list' names them all");
  if (options.output.empty()) throw UsageError("where should it go? Give -o OUT ('-' for standard output)");
  std::optional<Format> format = format_from_name(options.format);
  if (!format) format = options.output == standard_stream ? Format::obj : format_from_extension(options.output);
  if (!format) throw UsageError(options.output + ": name it *.obj, *.off or *.ply, or add --format");
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
