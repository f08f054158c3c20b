#pragma once

#include "command_options.h"
#include "interruption.h"

namespace unsnarl::app {

struct FixOptions : MeshOptions {
  std::string output;
  bool in_place = false;
  bool keep_partial = false;
  std::string precision = "auto";
  double time_limit_s = 0, memory_limit_mb = 0;
  double max_displacement = 0, min_gap = 0;  ///< fractions of the diagonal, or lengths if `absolute`
  bool absolute = false;
  std::string fix_vertices;
  bool paper = false, no_recover = false;
  std::string report, highlight, picture, view;
  std::string progress = "auto";
};
void add_fix_options(CLI::App& command, FixOptions& options);

/// Reads, repairs, writes to a temporary file, reads it back, certifies what was read, renames. Returns the exit code.
/// Throws FileError, WriteError, UsageError.
int run_fix(const FixOptions& options, Interruption& interruption);

}  // namespace unsnarl::app
