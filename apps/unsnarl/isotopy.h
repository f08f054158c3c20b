#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "interruption.h"

namespace unsnarl::app {

struct IsotopyCommandOptions {
  std::string start, end, folder;
  int points = 0, frames = 25;
  double flatten = 1e-4, time_limit_s = 0;
  bool reverse = false;
  std::vector<std::string> pairs;
  std::string progress = "auto";
  bool quiet = false;
};
void add_isotopy_options(CLI::App& command, IsotopyCommandOptions& options);

/// Reads two files of closed curves, makes an isotopy between them, writes its surface, reads that back, certifies what
/// was read, writes the rest. Returns the exit code. Throws FileError, WriteError, UsageError.
int run_isotopy(const IsotopyCommandOptions& options, Interruption& interruption);

}  // namespace unsnarl::app
