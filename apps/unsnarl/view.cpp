#include "view.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>

#include "mesh_input.h"
#include "report/exit_code.h"
#include "staged_output.h"
#include "standard_streams.h"
#include "usage_error.h"
#include "view_page.h"

namespace unsnarl::app {
namespace {

nlohmann::ordered_json read_report(const std::string& path) {
  if (path.empty()) return nullptr;
  std::ifstream file(path);
  if (!file) throw FileError(path + ": cannot open; --report needs the report that 'unsnarl fix --report' wrote");
  nlohmann::ordered_json report = nlohmann::ordered_json::parse(file, nullptr, false);
  if (!report.is_object() || report.value("schema", "") != "unsnarl-report")
    throw FileError(path + ": this is not a report of 'unsnarl fix'");
  return report;
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
  const std::string page = view_page(source);
  write_file(options.output, page, interruption);
  if (!options.quiet && options.output != standard_stream)
    tell(fmt::format("wrote {} ({:.1f} MB); open it in a browser\n", options.output, 1e-6 * page.size()));
  return exit_embedded;
}

}  // namespace unsnarl::app
