#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "interruption.h"

namespace unsnarl::app {

struct RoutesCommandOptions {
  std::string plan, folder, check;
  double spacing = 0.5, time_limit_s = 0;
  int sides = 16;
  bool free_tubes = false;
  std::string progress = "auto";
  bool quiet = false;
};
void add_routes_options(CLI::App& command, RoutesCommandOptions& options);

/// Reads a plan, makes routes, writes them and their tubes, reads both back, certifies what was read, writes the rest.
/// Returns the exit code. Throws FileError, WriteError, UsageError.
int run_routes(const RoutesCommandOptions& options, Interruption& interruption);

}  // namespace unsnarl::app
