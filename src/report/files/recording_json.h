#pragma once

#include <nlohmann/json.hpp>
#include <span>

#include "unsnarl/recording.h"

namespace unsnarl {

/// The history of a repair, as docs/recording.md describes it: a part of recordings and of reports.
nlohmann::ordered_json history_json(std::span<const RegionHistory> history);

}  // namespace unsnarl
