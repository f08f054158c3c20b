#pragma once

#include <string>

#include "command_options.h"
#include "unsnarl/paper.h"

namespace unsnarl::app {

/// `--paper-...`: the settings of --paper, in a group of the help of their own.
void add_paper_options(CLI::App& command, PaperOptions& options);

}  // namespace unsnarl::app
