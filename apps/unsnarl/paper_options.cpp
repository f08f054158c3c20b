#include "paper_options.h"

#include <algorithm>
#include <initializer_list>
#include <limits>
#include <map>

#include "command_options.h"

namespace unsnarl::app {
namespace {

constexpr const char* group = "For research, with --paper";
constexpr double most = std::numeric_limits<double>::max();

/// A choice among values of an enum, by their names.
template <class Value>
void add_choice(CLI::App& command, const std::string& name, Value& value, std::initializer_list<Value> values,
                const std::string& description) {
  std::map<std::string, Value> choices;
  std::string type_name;
  for (const Value choice : values) {
    choices.emplace(to_string(choice), choice);
    type_name += (type_name.empty() ? "" : "|") + std::string(to_string(choice));
  }
  command
      .add_option_function<std::string>(
          name, [&value, choices](const std::string& given) { value = choices.at(given); }, description)
      ->check(CLI::IsMember(choices).description(""))
      ->type_name(type_name)
      ->needs("--paper")
      ->group(group);
}

template <class Number>
void add_number(CLI::App& command, const std::string& name, Number& value, Number least, const std::string& type_name,
                const std::string& description) {
  command.add_option(name, value, description)
      ->check(number_within(least, std::min<double>(most, std::numeric_limits<Number>::max())))
      ->type_name(type_name)
      ->needs("--paper")
      ->group(group);
}

}  // namespace

void add_paper_options(CLI::App& command, PaperOptions& options) {
  constexpr double positive = std::numeric_limits<double>::min();
  add_choice(command, "--paper-bandwidth", options.bandwidth,
             {PaperBandwidth::global, PaperBandwidth::independent, PaperBandwidth::symmetric},
             "Bandwidths of the Gaussian energy (Table 2): one, or one a vertex by model (I) or (II);\n"
             "default: symmetric, (II)");
  command
      .add_flag_callback(
          "--paper-frozen", [&options] { options.adaptive = false; },
          "Bandwidths stay as they are found at the start (§5.6)")
      ->needs("--paper")
      ->group(group);
  add_number(command, "--paper-bandwidth-scale", options.bandwidth_scale, positive, "X",
             "Times the bandwidths found (Fig. 14); default 1");
  add_number(command, "--paper-neighbourhood", options.neighbourhood, positive, "X",
             "Vertices farther apart, in bandwidths, do not repel each other (§3.5.4); default 1.5");
  add_number(command, "--paper-gaussian", options.lambda_gaussian, 0.0, "W",
             "Weight of the Gaussian energy; default 1");
  add_number(command, "--paper-mesh", options.lambda_mesh, 0.0, "W", "Weight of the mesh energy, in mean edges; default 0.3");
  add_choice(command, "--paper-mesh-energy", options.mesh_energy,
             {PaperMeshEnergy::penetration_depth, PaperMeshEnergy::intersection_length},
             "Penetration depth (default), or the length of the intersection curves (§3.2)");
  command
      .add_flag_callback(
          "--paper-triangles", [&options] { options.whole_polygons = false; },
          "Penetration between the triangles of polygons, not between polygons as they are")
      ->needs("--paper")
      ->group(group);
  add_number(command, "--paper-arap", options.lambda_arap, 0.0, "W", "Weight of the regularisation (§5.8); default 0.5");
  add_number(command, "--paper-memory", options.memory, 1, "N", "Steps that L-BFGS keeps; default 8");
  add_number(command, "--paper-iterations", options.max_iterations, 0, "N", "Most of them; default 3000");
}

}  // namespace unsnarl::app
