#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "unsnarl/repair.h"

namespace unsnarl::app {

/// Options that `fix` and `check` share.
struct MeshOptions {
  std::string input, format;
  std::string goal = "all", weld = "seams";
  double weld_tolerance = 0;
  int threads = 0;
  bool quiet = false;

  FindOptions find() const;
  Goal goal_wanted() const { return goal == "disjoint" ? Goal::disjoint : Goal::all; }
};
void add_mesh_options(CLI::App& command, MeshOptions& options);

}  // namespace unsnarl::app
