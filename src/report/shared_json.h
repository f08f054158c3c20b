#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "unsnarl/intersections.h"
#include "unsnarl/report.h"

namespace unsnarl {

// Parts of reports that several of them have.

nlohmann::ordered_json topology_json(const Topology& topology);
nlohmann::ordered_json pair_counts_json(const PairCounts& counts);
/// The document as text, indented by two; bytes that are not UTF-8 (of file names) become U+FFFD.
std::string text_of(const nlohmann::ordered_json& json);

}  // namespace unsnarl
