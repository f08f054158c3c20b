#include "paper_options.h"

#include <fmt/format.h>

#include <cstdint>
#include <initializer_list>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "command_options.h"

namespace unsnarl::app {
namespace {

constexpr const char* group = "For research, with --paper";

/// A choice among values of an enum, by their names.
template <class Value>
void add_choice(CLI::App& command, const std::string& name, Value& value, std::initializer_list<Value> values,
                const std::string& description) {
  std::map<std::string, Value> choices;
  std::vector<std::string> words;
  for (const Value choice : values) {
    words.emplace_back(to_string(choice));
    choices.emplace(words.back(), choice);
  }
  command
      .add_option_function<std::string>(
          name, [&value, choices](const std::string& given) { value = choices.at(given); }, description)
      ->check(one_of(words))
      ->type_name(fmt::format("{}", fmt::join(words, "|")))
      ->needs("--paper")
      ->group(group);
}

void add_number(CLI::App& command, const std::string& name, double& value, double least,
                const std::string& description) {
  command.add_option(name, value, description)
      ->check(number_within(least, std::numeric_limits<double>::max(), unit::none))
      ->type_name("NUMBER")
      ->needs("--paper")
      ->group(group);
}

void add_count(CLI::App& command, const std::string& name, int& value, int least, const std::string& description) {
  command.add_option(name, value, description)
      ->check(whole_number_within(least, std::numeric_limits<std::int32_t>::max()))
      ->type_name("N")
      ->needs("--paper")
      ->group(group);
}

}  // namespace

void add_paper_options(CLI::App& command, PaperOptions& options) {
  constexpr double positive = std::numeric_limits<double>::min();
  add_choice(command, "--paper-bandwidth", options.bandwidth,
             {PaperBandwidth::global, PaperBandwidth::independent, PaperBandwidth::symmetric},
             "Bandwidths of the Gaussian energy (Table 2): one for all vertices, or one for each vertex by model (I) "
             "(independent) or (II) (symmetric, default)");
  command
      .add_flag_callback(
          "--paper-frozen", [&options] { options.adaptive = false; },
          "Compute the bandwidths once, at the start (§5.6)")
      ->needs("--paper")
      ->group(group);
  add_number(command, "--paper-bandwidth-scale", options.bandwidth_scale, positive,
             "Factor on the bandwidths (Fig. 14; default 1)");
  add_number(command, "--paper-neighbourhood", options.neighbourhood, positive,
             "Ignore pairs of vertices farther apart than this many bandwidths (§3.5.4; default 1.5)");
  add_number(command, "--paper-gaussian", options.lambda_gaussian, 0, "Weight of the Gaussian energy (default 1)");
  add_number(command, "--paper-mesh", options.lambda_mesh, 0,
             "Weight of the mesh energy, in mean edge lengths (default 0.3)");
  add_choice(command, "--paper-mesh-energy", options.mesh_energy,
             {PaperMeshEnergy::penetration_depth, PaperMeshEnergy::intersection_length},
             "Penetration depth (default), or length of the intersection curves (§3.2)");
  command
      .add_flag_callback(
          "--paper-triangles", [&options] { options.whole_polygons = false; },
          "Measure the penetration of triangles, not of whole polygons")
      ->needs("--paper")
      ->group(group);
  add_number(command, "--paper-arap", options.lambda_arap, 0, "Weight of the regularisation (§5.8; default 0.5)");
  add_count(command, "--paper-memory", options.memory, 1, "Steps that L-BFGS remembers (default 8)");
  add_count(command, "--paper-iterations", options.max_iterations, 0, "Largest number of iterations (default 3000)");
}

}  // namespace unsnarl::app
