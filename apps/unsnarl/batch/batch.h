#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "interruption.h"

namespace unsnarl::app {

struct BatchOptions {
  std::string input, output;
  int jobs = 0, threads = 0;  ///< 0: what the machine has, and that divided by `jobs`
  std::string shard;
  int attempts = 3;
  double time_limit_s = 3600;
  double memory_limit_mb = 0;  ///< 0: nine tenths of what the machine, or the job's control group, has / `jobs`
  bool summary = false, retry = false, thumbnails = false, quiet = false;
  std::string worker;                    ///< empty: this program
  std::vector<std::string> fix_options;  ///< for `unsnarl fix`
};
void add_batch_options(CLI::App& command, BatchOptions& options);

/// Repairs each mesh of a list or folder in a process of its own and keeps a record of it. Returns the exit code:
/// exit_embedded, exit_gap_not_met (all are, but not all gaps are as wide as asked), exit_allowed (all are, but for
/// pairs that may pass), exit_intersecting (all have been worked on, not all are embedded) or exit_cancelled. Throws
/// FileError, WriteError, UsageError.
int run_batch(const BatchOptions& options, Interruption& interruption);

}  // namespace unsnarl::app
