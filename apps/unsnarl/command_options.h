#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "unsnarl/repair.h"

namespace unsnarl::app {

/// Checks of values that say nothing in the help text, where the name of the type says it all.
CLI::Validator one_of(std::vector<std::string> words);
CLI::Validator not_negative();

/// Options that `fix` and `check` share.
struct MeshOptions {
  std::string input, format;
  std::string goal = "all", weld = "seams";
  double weld_tolerance = 0;
  bool both_diagonals = false;
  int threads = 0;
  bool quiet = false;

  FindOptions find() const;
  Goal goal_wanted() const { return goal == "disjoint" ? Goal::disjoint : Goal::all; }
};
void add_mesh_options(CLI::App& command, MeshOptions& options);

}  // namespace unsnarl::app
