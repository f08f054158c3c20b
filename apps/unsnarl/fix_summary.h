#pragma once

#include <string>
#include <vector>

#include "unsnarl/repair.h"
#include "unsnarl/report_json.h"

namespace unsnarl::app {

/// The summary that `fix` ends with, several lines; the last says where a partial result is. `other_outputs`: paths of
/// all files that were written but those of the mesh.
std::string fix_summary(const RepairResult& result, const RepairOptions& options, const ReportFiles& files,
                        const std::vector<std::string>& other_outputs);

}  // namespace unsnarl::app
