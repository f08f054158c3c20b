#pragma once

#include "run/limits.h"
#include "run/phases.h"

namespace unsnarl {

/// The limits that the stages of a repair ask when to end, and the phases that they tell how far they are.
struct RepairControl {
  Limits& limits;
  Phases& phases;
};

}  // namespace unsnarl
