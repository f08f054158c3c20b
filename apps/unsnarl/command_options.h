#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "unsnarl/repair.h"

namespace unsnarl::app {

/// Checks of values that say nothing in the help text, where the name of the type says it all.
CLI::Validator one_of(std::vector<std::string> words);
CLI::Validator number_within(double least, double most);
CLI::Validator number_below(double least, double bound);  ///< the bound itself is not allowed
CLI::Validator not_negative();
CLI::Validator whole_number_within(long least, long most);
/// The name of a file to be written has to end in one of these ("png"), unless it is a stream or device; what is
/// written there has no other format. Folders are allowed where `folders` says so. `advice`: what else to do.
CLI::Validator file_named(std::vector<std::string> extensions, bool folders = false, const std::string& advice = "");

/// Options that commands share word for word. group: the heading that they stand under in the help.
void add_time_limit(CLI::App& command, double& seconds, const std::string& group = "Options");
void add_memory_limit(CLI::App& command, double& megabytes, const std::string& group = "Options");
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
  /// Refuses options that do nothing beside the others, as they do after parsing. Throws UsageError.
  void require_effect() const;
  FindOptions find() const;
  Goal goal_wanted() const { return goal == "disjoint" ? Goal::disjoint : Goal::all; }
};
/// `input`: what the help says of IN, before the formats.
void add_mesh_options(CLI::App& command, MeshOptions& options,
                      const std::string& input = "Mesh file, or several that are one scene");

}  // namespace unsnarl::app
