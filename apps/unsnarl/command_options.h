#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "unsnarl/repair.h"

namespace unsnarl::app {

/// Checks of values that say nothing in the help text, where the name of the type says it all.
CLI::Validator one_of(std::vector<std::string> words);
CLI::Validator number_within(double least, double most);
CLI::Validator not_negative();

/// Options that commands share word for word. group: the heading that they stand under in the help.
void add_time_limit(CLI::App& command, double& seconds, const std::string& group = "Options");
void add_progress(CLI::App& command, std::string& progress, const std::string& group = "Options");
void add_quiet(CLI::App& command, bool& quiet, const std::string& group = "Options");

/// Options that `fix` and `check` share.
struct MeshOptions {
  std::vector<std::string> inputs;  ///< one, or the files of a scene
  std::string format;
  std::string goal = "all", weld = "seams";
  double weld_tolerance = 0;
  bool both_diagonals = false;
  int threads = 0;
  bool quiet = false;

  bool is_scene() const { return inputs.size() > 1; }
  FindOptions find() const;
  Goal goal_wanted() const { return goal == "disjoint" ? Goal::disjoint : Goal::all; }
};
/// `input`: what the help says of IN, before the formats.
void add_mesh_options(CLI::App& command, MeshOptions& options,
                      const std::string& input = "Mesh file, or several that are one scene");

}  // namespace unsnarl::app
