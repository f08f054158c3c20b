// unsnarl_peers: one run of one method of another paper on one mesh, for bench/peers.
#include <CLI/CLI.hpp>
#include <ctime>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "contact/intersection_finder.h"
#include "gallery.h"
#include "geometry/parallel.h"
#include "peer.h"
#include "recovery.h"
#include "render/png.h"
#include "report/measure.h"
#include "scene/diagnose.h"
#include "unsnarl/document.h"
#include "unsnarl/report.h"

namespace unsnarl::peers {
namespace {

using Json = nlohmann::ordered_json;

double cpu_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

struct RunOptions {
  std::string method, input, output;
  double time_limit_s = 0;
  int most_iterations = 0;
  bool recover = false;
};

Json run_method(const RunOptions& options) {
  const double begin = cpu_seconds();
  const auto stop = [&] { return options.time_limit_s > 0 && cpu_seconds() - begin > options.time_limit_s; };
  const Document document = Document::read(options.input);
  const Surface& surface = document.surface();
  const PreparedSurface prepared = prepare(surface, {});
  const Start start{prepared.rest, prepared.triangles()};
  const std::unique_ptr<Peer> peer = method_named(options.method).make(start);
  Outcome outcome = run(*peer, start, options.most_iterations, stop);
  const double method_s = cpu_seconds() - begin;
  bool recovered = false;
  if (options.recover && IntersectionFinder(prepared.triangles()).find(outcome.x).empty()) {
    recover_towards_rest(prepared, outcome.x, stop);
    recovered = true;
  }
  const std::vector<OutputFile> files = document.patched(prepared.scatter(surface.positions, outcome.x), false);
  const std::filesystem::path output = options.output;
  for (std::size_t k = 0; k < files.size(); ++k)
    write_atomically(k == 0 ? output : output.parent_path() / files[k].name, files[k].bytes);
  return {{"method", options.method},         {"iterations", outcome.iterations}, {"ended", outcome.ended},
          {"pairs_left", outcome.pairs_left}, {"method_cpu_s", method_s},         {"recovered", recovered}};
}

/// How far the second file is from the first, a mesh of the same faces: what reports of the product say of its own.
Json measure_files(const std::string& before, const std::string& after) {
  const Document input = Document::read(before), output = Document::read(after);
  const Surface& surface = input.surface();
  if (output.surface().positions.size() != surface.positions.size())
    throw FileError(after + " has " + std::to_string(output.surface().view().vertex_count()) + " vertices, " + before +
                    " has " + std::to_string(surface.view().vertex_count()) + "; give a file and its repaired one");
  const PreparedSurface prepared = prepare(surface, {});
  IntersectionFinder finder(prepared.triangles());
  const Diagnosis diagnosis = diagnose(surface, prepared, {}, finder);
  RepairReport report;
  measure_change(surface, prepared, diagnosis, output.surface().positions, report);
  Json row{{"triangles", prepared.triangles().size()},
           {"diagonal", diagonal_of(surface)},
           {"displacement_mean_rel", report.displacement_mean_rel},
           {"displacement_max_rel", report.displacement_max_rel},
           {"flipped_triangles", report.flipped_triangles},
           {"closed_components", diagnosis.topology.closed_components}};
  // Only closed components have a volume.
  if (diagnosis.topology.closed_components > 0) row["volume_change_rel"] = report.volume_change_rel;
  return row;
}

void draw_gallery(const std::vector<std::string>& labelled, const std::string& output, int columns, int width) {
  std::vector<Exhibit> exhibits;
  for (const std::string& item : labelled) {
    const std::size_t equals = item.find('=');
    if (equals == std::string::npos) throw std::invalid_argument("'" + item + "' is not LABEL=FILE");
    std::string label = item.substr(0, equals);
    for (char& c : label)
      if (c == '|') c = '\n';
    exhibits.push_back({Document::read(item.substr(equals + 1)).surface(), label});
  }
  write_png(gallery(exhibits, columns, width), output);
}

}  // namespace
}  // namespace unsnarl::peers

int main(int argc, char** argv) {
  using namespace unsnarl;
  using namespace unsnarl::peers;
  CLI::App app("Methods of other papers, for bench/peers; one thread.");
  app.require_subcommand(1);
  RunOptions options;
  CLI::App* run_command = app.add_subcommand("run", "run a method on a mesh, write the result and a line of JSON");
  std::string names;
  for (const Method& method : methods())
    names += "\n  " + std::string(method.name) + ": " + std::string(method.description);
  run_command->add_option("method", options.method, "one of" + names)->required();
  run_command->add_option("input", options.input, "mesh file")->required();
  run_command->add_option("-o,--output", options.output, "where the state with the fewest pairs goes")->required();
  run_command->add_option("--time-limit", options.time_limit_s, "CPU seconds; 0: none (default)");
  run_command->add_option("--iterations", options.most_iterations, "at most; 0: as many as the paper (default)");
  run_command->add_flag("--recover", options.recover, "then go back towards the input, if nothing intersects");
  std::string before, after;
  CLI::App* measure_command = app.add_subcommand("measure", "print how far a mesh is from another as a line of JSON");
  measure_command->add_option("before", before, "mesh file")->required();
  measure_command->add_option("after", after, "mesh file with the same faces")->required();
  std::vector<std::string> labelled;
  std::string picture;
  int columns = 3, width = 480;
  CLI::App* gallery_command = app.add_subcommand("gallery", "draw meshes side by side");
  gallery_command->add_option("labelled", labelled, "LABEL=FILE; a | starts a second line")->required();
  gallery_command->add_option("-o,--output", picture, "PNG")->required();
  gallery_command->add_option("--columns", columns, "default 3")->check(CLI::Range(1, 16));
  gallery_command->add_option("--width", width, "pixels of a panel (default 480)")->check(CLI::Range(64, 2000));
  CLI11_PARSE(app, argc, argv);
  try {
    const ThreadLimit one_thread(1);
    if (*gallery_command) {
      draw_gallery(labelled, picture, columns, width);
    } else {
      std::cout << (*run_command ? run_method(options) : measure_files(before, after)).dump() << '\n';
    }
  } catch (const std::exception& error) {
    std::cerr << "unsnarl_peers: " << error.what() << '\n';
    return 1;
  }
}
