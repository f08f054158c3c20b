#pragma once

#include "command_options.h"
#include "interruption.h"

namespace unsnarl::app {

struct ViewOptions : MeshOptions {
  std::string repaired, output, report;
};
void add_view_options(CLI::App& command, ViewOptions& options);

/// Writes a page that shows a mesh, or a mesh and its repaired version. Returns the exit code.
/// Throws FileError, WriteError, UsageError.
int run_view(const ViewOptions& options, Interruption& interruption);

}  // namespace unsnarl::app
