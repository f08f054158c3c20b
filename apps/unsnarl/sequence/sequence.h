#pragma once

#include "fix.h"

namespace unsnarl::app {

/// `unsnarl fix --sequence`: repairs the frames of a moving mesh, writes each as soon as it is certain and notes it in
/// a record, by which a later call knows what is done. Returns the exit code. Throws FileError, WriteError, UsageError.
int run_sequence(const FixOptions& options, Interruption& interruption);

}  // namespace unsnarl::app
