// One run of an experiment of Minarčík, Liu, Crane, Li: "Untangling Surfaces via Shape and Mesh Repulsion": a row of
// the tables that bench/ablations makes, as one line of JSON on standard output.
#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <initializer_list>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "contact/intersection_finder.h"
#include "geometry/parallel.h"
#include "mesh/areas.h"
#include "recover/recover.h"
#include "render/picture.h"
#include "render/png.h"
#include "report/measure.h"
#include "samples/tube.h"
#include "scene/diagnose.h"
#include "scene/patch.h"
#include "scene/prepared_surface.h"
#include "unsnarl/certify.h"
#include "unsnarl/document.h"
#include "unsnarl/repair.h"
#include "unsnarl/samples.h"
#include "untangle/paper_untangle.h"

namespace unsnarl {
namespace {

using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

struct Options {
  std::string input, picture, label;
  int threads = 2;
  double time_limit_s = 30;
  PaperOptions paper;
  bool frozen = false;
  bool recover = false;  // as the paper does, after untangling
  bool repair_as_paper = false;
  std::vector<std::string> without;  // strategies of the repair
};

/// A surface, and all of it as one patch.
struct Subject {
  Surface surface;
  PreparedSurface prepared;
  Diagnosis diagnosis;
  Scene scene;
  Patch patch;

  explicit Subject(Surface given) : surface(std::move(given)) {
    prepared = prepare(surface, {});
    IntersectionFinder finder(prepared.triangles());
    diagnosis = diagnose(surface, prepared, {}, finder);
    scene = make_scene(prepared.rest, prepared.triangulation.triangles,
                       std::vector<std::uint8_t>(prepared.weld_map.count, 0));
    std::vector<Index> free;
    for (Index v = 0; v < scene.vertex_count(); ++v)
      if (!scene.triangles_of_vertex[v].empty()) free.push_back(v);
    patch = cut_patch(scene, SceneIndex(scene), free, 0);
    patch.edge_length = mean_edge_length(scene.rest, scene.triangles);
  }

  std::vector<double> positions() {
    SceneIndex index(scene);
    paste_patch(patch, scene, index);
    return prepared.scatter(surface.positions, scene.x);
  }
};

void add_measures(Subject& subject, const std::vector<double>& positions, const std::string& prefix, Json& row) {
  RepairReport report;
  measure_change(subject.surface, subject.prepared, subject.diagnosis, positions, report);
  const double triangles = static_cast<double>(subject.prepared.triangles().size());
  row[prefix + "pairs"] =
      IntersectionFinder(subject.prepared.triangles()).find(subject.prepared.gather(positions)).size();
  row[prefix + "displacement_mean_rel"] = report.displacement_mean_rel;
  row[prefix + "displacement_max_rel"] = report.displacement_max_rel;
  row[prefix + "edge_stretch_p999"] = report.edge_stretch_p999;
  row[prefix + "turned_share"] = static_cast<double>(report.flipped_triangles) / triangles;
  row[prefix + "volume_ratio"] = 1 + report.volume_change_rel;  // negative: inside out
}

std::vector<Index> faces_in_pairs(const Subject& subject, const std::vector<double>& positions) {
  std::vector<Index> faces;
  for (const IntersectingPair& pair :
       find_intersections(SurfaceView{positions, subject.surface.corners, subject.surface.offsets}))
    faces.insert(faces.end(), {pair.a, pair.b});
  return faces;
}

void write_picture(const Options& options, Subject& subject, const std::vector<double>& before,
                   const std::vector<double>& after, const std::string& before_label = "before") {
  if (options.picture.empty()) return;
  const auto view = [&](const std::vector<double>& x) {
    return SurfaceView{x, subject.surface.corners, subject.surface.offsets};
  };
  PictureOptions picture;
  picture.width = 1000;
  picture.height = 500;
  picture.inset = false;
  picture.before_label = before_label;
  picture.after_label = options.label.empty() ? "after" : options.label;
  write_png(
      render_pair(view(before), faces_in_pairs(subject, before), view(after), faces_in_pairs(subject, after), picture),
      options.picture);
}

/// Recovery as the paper does it (§3.4), with gaps of a few units in the last place.
void recover_as_paper(Subject& subject, const std::function<bool()>& stop, Json& row) {
  const auto begin = Clock::now();
  RecoverOptions recovery = RecoverOptions::paper();
  recovery.min_gap = 1e-6 * subject.patch.rest.cwiseAbs().maxCoeff();
  row["newton_steps"] = recover(subject.patch, recovery, stop).iterations;
  row["recovery_s"] = seconds_since(begin);
  add_measures(subject, subject.positions(), "recovered_", row);
}

Json untangle(const Options& options) {
  Subject subject(Document::read(options.input).surface());
  const auto begin = Clock::now();
  const auto stop = [&] { return seconds_since(begin) > options.time_limit_s; };
  const PaperResult result = paper_untangle(subject.patch, options.paper, subject.prepared.triangulation.polygon, stop);
  Json row;
  row["triangles"] = subject.scene.triangle_count();
  row["pairs_before"] = subject.diagnosis.pairs.size();
  row["clean"] = result.clean;
  row["iterations"] = result.iterations;
  row["evaluations"] = result.evaluations;
  row["disjoint_left"] = result.disjoint_left;
  row["seconds"] = seconds_since(begin);
  row["bandwidth_rel"] = result.mean_bandwidth / diagonal_of(subject.surface);
  std::vector<double> positions = subject.positions();
  add_measures(subject, positions, "", row);
  if (options.recover && row["pairs"] == 0) {
    recover_as_paper(subject, stop, row);
    positions = subject.positions();
  }
  write_picture(options, subject, subject.surface.positions, positions);
  return row;
}

/// The whole of repair(), by default or as in the paper.
Json repair_all(const Options& options) {
  Subject subject(Document::read(options.input).surface());
  RepairOptions repair_options;
  if (options.repair_as_paper) repair_options.paper.emplace();
  repair_options.without_strategies = options.without;
  repair_options.find.threads = options.threads;
  repair_options.time_limit_s = options.time_limit_s;
  const auto begin = Clock::now();
  const RepairResult result = repair(subject.surface, repair_options);
  Json row;
  row["triangles"] = subject.scene.triangle_count();
  row["pairs_before"] = subject.diagnosis.pairs.size();
  row["status"] = to_string(result.status);
  row["clean"] = result.status == Status::embedded;
  row["seconds"] = seconds_since(begin);
  row["disjoint_left"] = result.report.after[PairClass::disjoint];
  row["untouched_share"] = result.report.untouched_share;
  add_measures(subject, result.positions, "", row);
  write_picture(options, subject, subject.surface.positions, result.positions);
  return row;
}

/// Why untangling comes first (Fig. 13): the same knotted tube recovered from its untangled state, and from a plain
/// torus with the same connectivity, which is embedded too but no knot.
Json recover_knot(const Options& options, bool from_torus) {
  constexpr double pi = std::numbers::pi;
  Tube tube;
  tube.t_max = 2 * pi;
  tube.closed = true;
  tube.steps = 54;
  tube.sides = 8;
  tube.radius = [](double) { return 0.45; };
  tube.centre = [](double t) -> Vec3 {
    return Vec3(std::sin(t) + 2 * std::sin(2 * t), std::cos(t) - 2 * std::cos(2 * t), -std::sin(3 * t)) / 2;
  };
  Subject subject(sample_tube(tube));
  const auto begin = Clock::now();
  const auto stop = [&] { return seconds_since(begin) > options.time_limit_s; };
  Json row;
  row["triangles"] = subject.scene.triangle_count();
  row["pairs_before"] = subject.diagnosis.pairs.size();
  if (from_torus) {
    tube.centre = [](double t) -> Vec3 { return 1.2 * Vec3(std::sin(t), std::cos(t), 0); };
    const Surface torus = sample_tube(tube);
    subject.patch.x = subject.prepared.gather(torus.positions);
  } else {
    row["iterations"] = paper_untangle(subject.patch, options.paper, {}, stop).iterations;
  }
  const std::vector<double> start = subject.positions();
  add_measures(subject, start, "", row);
  row["clean"] = row["pairs"] == 0;
  if (row["pairs"] == 0) recover_as_paper(subject, stop, row);
  write_picture(options, subject, start, subject.positions(), "start of the recovery");
  row["seconds"] = seconds_since(begin);
  return row;
}

/// A choice among values of an enum, by their names.
template <class Value>
void add_choice(CLI::App& command, const std::string& name, Value& value, std::initializer_list<Value> values,
                const std::string& description) {
  std::map<std::string, Value> choices;
  for (const Value choice : values) choices.emplace(to_string(choice), choice);
  command
      .add_option_function<std::string>(
          name, [&value, choices](const std::string& given) { value = choices.at(given); }, description)
      ->check(CLI::IsMember(choices));
}

void add_untangle_options(CLI::App& command, Options& options) {
  PaperOptions& paper = options.paper;
  add_choice(command, "--bandwidth", paper.bandwidth,
             {PaperBandwidth::global, PaperBandwidth::independent, PaperBandwidth::symmetric}, "model");
  command.add_flag("--frozen", options.frozen, "bandwidths stay as they are at the start");
  command.add_option("--bandwidth-scale", paper.bandwidth_scale, "times the bandwidths found");
  command.add_option("--neighbourhood", paper.neighbourhood, "in bandwidths");
  command.add_option("--gaussian", paper.lambda_gaussian, "weight of the Gaussian energy");
  command.add_option("--mesh", paper.lambda_mesh, "weight of the mesh energy");
  add_choice(command, "--mesh-energy", paper.mesh_energy,
             {PaperMeshEnergy::penetration_depth, PaperMeshEnergy::intersection_length}, "what it is");
  command.add_option("--arap", paper.lambda_arap, "weight of ARAP");
  command.add_option("--iterations", paper.max_iterations, "at most");
  command.add_flag("--recover", options.recover, "go back towards the input afterwards");
}

}  // namespace
}  // namespace unsnarl

int main(int argc, char** argv) {
  using namespace unsnarl;
  CLI::App app("One run of an experiment; bench/ablations makes the tables.");
  app.require_subcommand(1);
  Options options;
  app.add_option("--threads", options.threads, "default 2");
  app.add_option("--time-limit", options.time_limit_s, "seconds (default 30)");
  app.add_option("--picture", options.picture, "PNG of before and after");
  app.add_option("--label", options.label, "above the right half of the picture");
  CLI::App* untangle_command = app.add_subcommand("untangle", "the untangling of the paper");
  untangle_command->add_option("input", options.input)->required();
  add_untangle_options(*untangle_command, options);
  CLI::App* repair_command = app.add_subcommand("repair", "the whole repair");
  repair_command->add_option("input", options.input)->required();
  repair_command->add_flag("--paper", options.repair_as_paper, "as the paper does it");
  repair_command->add_option("--without", options.without, "a strategy to do without; may be repeated");
  app.add_subcommand("recover_untangled", "a knot from its untangled state");
  app.add_subcommand("recover_torus", "a knot from a torus");
  CLI11_PARSE(app, argc, argv);
  options.paper.adaptive = !options.frozen;
  try {
    const ThreadLimit limit(options.threads);
    const std::string command = app.get_subcommands().front()->get_name();
    const Json row = command == "untangle" ? untangle(options)
                     : command == "repair" ? repair_all(options)
                                           : recover_knot(options, command == "recover_torus");
    std::cout << row.dump() << '\n';
  } catch (const std::exception& error) {
    std::cerr << "ablations: " << error.what() << '\n';
    return 1;
  }
}
