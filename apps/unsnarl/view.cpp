#include "view.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <nlohmann/json.hpp>

#include "file_places.h"
#include "input_bytes.h"
#include "mesh_input.h"
#include "progress.h"
#include "staged_output.h"
#include "standard_streams.h"
#include "unsnarl/depth_limit.h"
#include "unsnarl/exit_code.h"
#include "unsnarl/page.h"
#include "unsnarl/paths.h"
#include "unsnarl/report_json.h"
#include "unsnarl/visible_text.h"
#include "usage_error.h"
#include "viewer.h"

namespace unsnarl::app {
namespace {

std::string read_report(const std::string& path) {
  if (path.empty()) return {};
  std::string text = read_bytes(path, "; --report needs the report that 'unsnarl fix --report' wrote");
  if (too_deep_bracket(text) != std::string::npos)
    throw FileError(fmt::format("{}: nested too deeply; this is not a report of 'unsnarl fix'", path));
  const nlohmann::json report = nlohmann::json::parse(text, nullptr, false);
  if (!report.is_object() || report.value("schema", nlohmann::json()) != "unsnarl-report")
    throw FileError(path + ": this is not a report of 'unsnarl fix'");
  if (const auto schema = report.value("schema_version", nlohmann::json()); schema != report_schema_version)
    throw FileError(
        fmt::format("{}: this report has schema version {}, but this program reads version {}; write it again with "
                    "'unsnarl fix --report'",
                    path, schema.dump(), report_schema_version));
  return text;
}

/// The paths of the meshes to be shown.
struct Meshes {
  std::vector<std::string> inputs, repaired;  // one each, or none
};

/// The last of several paths may be OUT: a folder with the repaired versions, or of two the repaired version.
Meshes sorted_out(const ViewOptions& options) {
  Meshes meshes{options.inputs, {}};
  if (meshes.inputs.size() < 2) return meshes;
  const std::string last = meshes.inputs.back();
  std::error_code ignored;
  if (std::filesystem::is_directory(path_of(last), ignored)) {
    meshes.inputs.pop_back();
    for (const std::string& input : meshes.inputs)
      meshes.repaired.push_back((path_of(last) / path_of(input).filename()).string());
  } else if (meshes.inputs.size() == 2 && !options.scene) {
    meshes.inputs.pop_back();
    meshes.repaired = {last};
  }
  return meshes;
}

SceneDocument read_repaired(const Meshes& meshes, const SceneDocument& input, const std::optional<Format>& format) {
  SceneDocument repaired = read_inputs(meshes.repaired, format);
  for (std::size_t i = 0; i < meshes.inputs.size(); ++i) {
    const Surface &before = input.document(i).surface(), &after = repaired.document(i).surface();
    if (after.corners != before.corners || after.offsets != before.offsets ||
        after.positions.size() != before.positions.size())
      throw FileError(fmt::format(
          "{}: its faces are not those of {}; OUT must be a repaired version of IN{}", meshes.repaired[i],
          meshes.inputs[i], meshes.inputs.size() == 1 ? " (if these are two files of a scene, add --scene)" : ""));
  }
  return repaired;
}

}  // namespace

void add_view_options(CLI::App& command, ViewOptions& options) {
  add_inputs(
      command, options,
      "Mesh file, or several files that form one scene; then, if it was repaired, the repaired file or the folder "
      "with the repaired files");
  command.add_option("-o,--output", options.output, "File to write the page to; '-' for standard output")
      ->check(file_named({"html", "htm"}))
      ->type_name("PAGE.html")
      ->required();
  command.add_option("--report", options.report, "JSON report of the repair, to be shown beside the mesh")
      ->type_name("FILE");
  command.add_flag("--scene", options.scene, "Two files are a scene, not a mesh before and after");
  add_mesh_options(command, options);
  add_allow(command, options.allow, options_of_reading);
  command.footer(std::string("The page is one file. Any current browser opens it from the disk, without a network.\n\n"
                             "Examples:\n"
                             "  unsnarl view hand.obj -o hand.html\n"
                             "  unsnarl view hand.obj hand_fixed.obj -o hand.html\n"
                             "  # a scene; its repaired files are in fixed/\n"
                             "  unsnarl view brain.surf skull.gii skin.obj fixed -o head.html\n"
                             "  # repair and write the page in one call\n"
                             "  unsnarl fix hand.obj -o hand_fixed.obj --view hand.html\n\n") +
                 exit_codes({{exit_embedded, "written"}}));
}

int run_view(const ViewOptions& options, Interruption& interruption) {
  const Meshes meshes = sorted_out(options);
  if (std::count(options.inputs.begin(), options.inputs.end(), standard_stream) > 1)
    throw UsageError("only one of the files can be '-', standard input");
  FilePlaces places;
  places.reads("--report", options.report);
  places.writes("-o", options.output);
  const std::optional<Format> format = format_from_name(options.format);
  ProgressDisplay display("auto", options.quiet);
  display.begin("read");
  const SceneDocument scene = read_inputs(meshes.inputs, format);
  claim_inputs(places, "the input", meshes.inputs, scene);
  PageSource source;
  source.input_name = scene_name(meshes.inputs);
  source.before = scene.surface();
  source.files = scene.files();
  source.labels = scene.face_labels();
  std::optional<SceneDocument> repaired;
  if (!meshes.repaired.empty()) {
    repaired.emplace(read_repaired(meshes, scene, format));
    claim_inputs(places, "the input", meshes.repaired, *repaired);
    source.output_name = meshes.repaired.size() == 1 ? page_name(meshes.repaired[0]) : page_name(options.inputs.back());
    source.after = repaired->surface().positions;
  }
  const Appearance appearance = scene.appearance();
  for (const std::string& note : appearance.notes) display.say("note: {}", note);
  source.appearance = &appearance;
  display.begin("write");
  source.find = options.find_in(scene);
  source.goal = options.goal_wanted();
  source.report = read_report(options.report);
  const std::string page = view_page(built_in_page(), source);
  display.clear();
  write_file(options.output, page, interruption);
  if (!options.quiet && options.output != standard_stream)
    tell(fmt::format("wrote {} ({:.1f} MB); open it in a browser\n", visible_text(options.output), 1e-6 * page.size()));
  return exit_embedded;
}

}  // namespace unsnarl::app
