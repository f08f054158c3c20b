#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "interruption.h"

namespace unsnarl::app {

struct KnotIsotopyCommandOptions {
  std::string start, end, folder, check, report;
  std::string method = "auto";
  int points = 0, frames = 25;
  double time_limit_s = 0;
  std::string progress = "auto";
  bool quiet = false;
};
void add_knot_isotopy_options(CLI::App& command, KnotIsotopyCommandOptions& options);

/// Reads two knots, looks for an isotopy between them, writes it, reads that back, certifies what was read, writes the
/// rest. Returns the exit code. Throws FileError, WriteError, UsageError.
int run_knot_isotopy(const KnotIsotopyCommandOptions& options, Interruption& interruption);

}  // namespace unsnarl::app
