#pragma once

#include "command_options.h"
#include "interruption.h"

namespace unsnarl::app {

struct ViewOptions : MeshOptions {
  // The last of the inputs may be OUT.
  bool scene = false;  ///< two inputs are two files of a scene
  std::string output, report;
};
void add_view_options(CLI::App& command, ViewOptions& options);

/// Writes a page that shows a mesh or the files of a scene, or these and their repaired versions. Returns the exit
/// code. Throws FileError, WriteError, UsageError.
int run_view(const ViewOptions& options, Interruption& interruption);

}  // namespace unsnarl::app
