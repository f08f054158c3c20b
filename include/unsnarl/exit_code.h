#pragma once

#include "unsnarl/report.h"

namespace unsnarl {

/// Exit codes of the program `unsnarl`, the same for all commands.
enum ExitCode : int {
  exit_embedded = 0,  ///< nothing intersects (any more)
  exit_intersecting = 1,
  exit_usage = 2,
  exit_invalid_input = 3,
  exit_cannot_write = 4,
  exit_limit = 5,
  exit_cancelled = 6,
  exit_obstructed = 7,
  exit_allowed = 8,       ///< nothing intersects but what may pass through each other
  exit_system_error = 9,  ///< the system failed (no descriptors, no memory, a read error); may succeed later
  exit_gap_not_met = 10,
  exit_internal_error = 70,
};

/// The exit code of `unsnarl fix`; also in its report.
constexpr ExitCode exit_code_of(Status status) {
  switch (status) {
    case Status::embedded: return exit_embedded;
    case Status::reduced:
    case Status::no_progress: return exit_intersecting;
    case Status::obstructed: return exit_obstructed;
    case Status::allowed: return exit_allowed;
    case Status::time_limit:
    case Status::memory_limit:
    case Status::displacement_exceeded: return exit_limit;
    case Status::cancelled: return exit_cancelled;
    case Status::gap_not_met: return exit_gap_not_met;
  }
  return exit_internal_error;
}

}  // namespace unsnarl
