#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "unsnarl/repair.h"

namespace unsnarl {

/// Raised whenever a key of a report is renamed, removed or changes its meaning; new keys do not raise it.
inline constexpr int report_schema_version = 1;

/// What a report says about the files around a repair.
struct ReportFiles {
  std::string input, output;                             ///< paths; empty: arrays were given, none was written
  std::string format;                                    ///< of the input: "obj", ...
  std::size_t vertices = 0, faces = 0;                   ///< as the file counts them
  std::string triangulation;                             ///< how the polygons were cut, in words
  std::vector<std::string> notes;                        ///< what the reader remarked
  double seconds = 0;                                    ///< from the start of the program
  std::vector<StageReport> before_repair, after_repair;  ///< reading, writing
};

/// The report of `unsnarl fix`: keys are the names of the fields of RepairReport and of what it holds; so are units.
nlohmann::ordered_json report_json(const RepairResult& result, const RepairOptions& options, const ReportFiles& files);

/// Parts that other reports share.
nlohmann::ordered_json topology_json(const Topology& topology);
nlohmann::ordered_json pair_counts_json(const PairCounts& counts);

std::string_view to_string(Weld weld);
std::string_view to_string(Precision precision);
std::string_view to_string(Goal goal);

}  // namespace unsnarl
