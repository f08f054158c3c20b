#include "view.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "mesh_input.h"
#include "staged_output.h"
#include "standard_streams.h"
#include "unsnarl/exit_code.h"
#include "unsnarl/page.h"
#include "unsnarl/report_json.h"
#include "usage_error.h"
#include "viewer.h"

namespace unsnarl::app {
namespace {

std::string read_report(const std::string& path) {
  if (path.empty()) return {};
  std::ifstream file(path);
  if (!file) throw FileError(path + ": cannot open; --report needs the report that 'unsnarl fix --report' wrote");
  std::string text{std::istreambuf_iterator<char>(file), {}};
  const nlohmann::json report = nlohmann::json::parse(text, nullptr, false);
  if (!report.is_object() || report.value("schema", nlohmann::json()) != "unsnarl-report")
    throw FileError(path + ": this is not a report of 'unsnarl fix'");
  if (const auto schema = report.value("schema_version", nlohmann::json()); schema != report_schema_version)
    throw FileError(
        fmt::format("{}: this report has schema version {}, this program reads {}; write it anew with "
                    "'unsnarl fix --report'",
                    path, schema.dump(), report_schema_version));
  return text;
}

Document read_repaired(const ViewOptions& options, const Surface& input) {
  Document repaired = read_mesh(options.repaired, format_from_name(options.format));
  const Surface& surface = repaired.surface();
  if (surface.corners != input.corners || surface.offsets != input.offsets ||
      surface.positions.size() != input.positions.size())
    throw FileError(fmt::format("{}: its faces are not those of {}; OUT must be a repaired version of IN",
                                options.repaired, options.input));
  return repaired;
}

}  // namespace

void add_view_options(CLI::App& command, ViewOptions& options) {
  add_mesh_options(command, options);
  command.add_option("OUT", options.repaired, "The repaired mesh; leave it out to look at IN alone");
  command.add_option("-o,--output", options.output, "Where the page goes; '-' for standard output")
      ->type_name("PAGE.html")
      ->required();
  command.add_option("--report", options.report, "The JSON report of the repair, to be shown beside the meshes")
      ->type_name("FILE");
  command.footer(
      "The page is one file that any browser of today opens from the disk, without a network.\n\n"
      "Examples:\n"
      "  unsnarl view hand.obj -o hand.html\n"
      "  unsnarl view hand.obj hand_fixed.obj -o hand.html\n"
      "  unsnarl fix hand.obj -o hand_fixed.obj --view hand.html     repairs and shows in one go\n\n"
      "Exit codes: 0 written, 2 usage (or this build has no viewer), 3 cannot read, 4 cannot write, 6 interrupted,\n"
      "70 internal error.");
}

int run_view(const ViewOptions& options, Interruption& interruption) {
  require_viewer();
  if (options.input == standard_stream && options.repaired == standard_stream)
    throw UsageError("IN and OUT cannot both come from standard input");
  for (const std::string& source : {options.input, options.repaired, options.report})
    if (!is_stream(options.output) && !source.empty() && source != standard_stream) {
      std::error_code ignored;
      if (std::filesystem::equivalent(source, options.output, ignored))
        throw UsageError(fmt::format("the page would overwrite {}; give it a name of its own", source));
    }
  const Document document = read_mesh(options.input, format_from_name(options.format));
  PageSource source;
  source.input_name = page_name(options.input);
  source.before = document.surface();
  std::optional<Document> repaired;
  if (!options.repaired.empty()) {
    repaired.emplace(read_repaired(options, document.surface()));
    source.output_name = page_name(options.repaired);
    source.after = repaired->surface().positions;
  }
  source.find = options.find();
  source.goal = options.goal_wanted();
  source.report = read_report(options.report);
  const std::string page = view_page(viewer_template(), source);
  write_file(options.output, page, interruption);
  if (!options.quiet && options.output != standard_stream)
    tell(fmt::format("wrote {} ({:.1f} MB); open it in a browser\n", options.output, 1e-6 * page.size()));
  return exit_embedded;
}

}  // namespace unsnarl::app
