#pragma once

#include <nlohmann/json.hpp>
#include <span>

#include "unsnarl/repair.h"

namespace unsnarl {

/// Raised whenever a key of a recording is renamed, removed or changes its meaning; new keys do not raise it.
inline constexpr int recording_schema_version = 1;

/// History and frames of a repair, as docs/recording.md describes them.
nlohmann::ordered_json recording_json(const RepairResult& result, const SurfaceView& surface);

/// Its parts; reports have the history too.
nlohmann::ordered_json history_json(std::span<const RegionHistory> history);
nlohmann::ordered_json frames_json(std::span<const RecordedFrame> frames);

}  // namespace unsnarl
