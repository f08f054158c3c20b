#pragma once

#include <string>

#include "unsnarl/repair.h"
#include "unsnarl/report_json.h"

namespace unsnarl::app {

/// The summary that `fix` ends with, several lines.
std::string fix_summary(const RepairResult& result, const RepairOptions& options, const ReportFiles& files);

}  // namespace unsnarl::app
