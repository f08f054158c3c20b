#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "interruption.h"

namespace unsnarl::app {

struct SeifertCommandOptions {
  std::string input, output, format, check, surface;
  double edge = 0, time_limit_s = 0;
  int views = 60, handles = 0;
  bool no_fair = false, relax = false;
  std::string report, picture, wire, tube;
  std::string progress = "auto";
  bool quiet = false;
};
void add_seifert_options(CLI::App& command, SeifertCommandOptions& options);

/// Reads a link, spans it, writes to a temporary file, reads it back, certifies what was read, renames. Returns the
/// exit code. Throws FileError, WriteError, UsageError.
int run_seifert(const SeifertCommandOptions& options, Interruption& interruption);

}  // namespace unsnarl::app
