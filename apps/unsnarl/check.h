#pragma once

#include "command_options.h"
#include "interruption.h"

namespace unsnarl::app {

struct CheckOptions : MeshOptions {
  bool json = false;
  std::string pairs;
  double min_gap = 0;  ///< a fraction of the diagonal, or a length if `absolute`
  bool absolute = false;
  double time_limit_s = 0, memory_limit_mb = 0;
};
void add_check_options(CLI::App& command, CheckOptions& options);

/// Counts and locates self-intersections, on standard output. Returns the exit code.
/// Throws FileError, WriteError, UsageError.
int run_check(const CheckOptions& options, Interruption& interruption);

}  // namespace unsnarl::app
