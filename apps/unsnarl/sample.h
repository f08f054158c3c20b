#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "interruption.h"

namespace unsnarl::app {

struct SampleOptions {
  std::string name, output, format;
  int resolution = 0;
  std::vector<std::string> parameters;  ///< "name=value"
  bool list = false;
};
void add_sample_options(CLI::App& command, SampleOptions& options);

/// Writes one of the built-in self-intersecting surfaces, or lists them. Returns the exit code.
/// Throws WriteError, UsageError.
int run_sample(const SampleOptions& options, Interruption& interruption);

}  // namespace unsnarl::app
