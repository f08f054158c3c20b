#pragma once

#include <string>

#include "report/report_json.h"
#include "unsnarl/repair.h"

namespace unsnarl::app {

/// What `fix` tells a person at the end, several lines.
std::string fix_summary(const RepairResult& result, const RepairOptions& options, const ReportFiles& files);

}  // namespace unsnarl::app
