#pragma once

#include <string>

#include "unsnarl/report.h"

namespace unsnarl::app {

/// "smallest gap 0.0011, asked for 0.02: between faces 3 and 70, at (0, 1, 2)". diagonal: the unit of the gap.
std::string gap_in_words(const GapReport& gap, double diagonal);

}  // namespace unsnarl::app
