#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>

#include "unsnarl/intersections.h"
#include "unsnarl/report.h"
#include "unsnarl/scene_document.h"

namespace unsnarl {

// Parts of reports that several of them have.

nlohmann::ordered_json topology_json(const Topology& topology);
nlohmann::ordered_json pair_counts_json(const PairCounts& counts);
/// What "overlapping_components" lists.
nlohmann::ordered_json overlapping_components_json(std::span<const OverlappingComponent> overlapping);
/// Makes the list "changed_components". `diagonal`: RepairReport::diagonal.
nlohmann::ordered_json changed_components_json(std::span<const ChangedComponent> changed, double diagonal);
/// Pairs that are allowed, before and after a repair.
nlohmann::ordered_json allowed_json(const PairCounts& before, const PairCounts& after);
/// The gap, or null.
nlohmann::ordered_json gap_json(const std::optional<GapReport>& gap);
/// Adds "files" and "between_files" where there are several files. `after`: with what became of them.
void add_scene(const SceneReport& scene, bool after, nlohmann::ordered_json& json);
/// Beside each length relative to the diagonal ("displacement_max_rel") the same in the units of the positions, under
/// its name without "_rel", unless that is taken. `json` is an object or a list of them, of any depth.
void add_lengths(nlohmann::ordered_json& json, double diagonal);
/// The document as text, indented by two; bytes that are not UTF-8 (of file names) become U+FFFD.
std::string text_of(const nlohmann::ordered_json& json);

}  // namespace unsnarl
