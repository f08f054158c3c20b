#include "unsnarl/report_json.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "report/files/recording_json.h"
#include "report/files/shared_json.h"
#include "unsnarl/nesting.h"
#include "unsnarl/version.h"

namespace unsnarl {
namespace {

using Json = nlohmann::ordered_json;

/// What a strategy was called in reports of version 0.1 and sources before; to be left out in the version after the
/// next.
std::string strategy_name_of_0_1(const std::string& name) {
  constexpr auto renamed = std::to_array<std::pair<std::string_view, std::string_view>>({
      {"push_apart", "shallow-0"},
      {"slide_apart", "contour-2"},
      {"slide_apart_wide", "contour-4"},
      {"part_layers", "contour-8"},
      {"shorten_curves", "shorten-4"},
  });
  for (const auto& [now, then] : renamed)
    if (name == now) return std::string(then);
  return name;
}

/// How many faces are of a part that may pass through another, or itself.
std::ptrdiff_t faces_that_may_pass(const AllowedPairs& allowed) {
  std::set<std::int32_t> parts;
  for (const auto& pair : allowed.parts) parts.insert(pair.begin(), pair.end());
  return std::count_if(allowed.part_of_face.begin(), allowed.part_of_face.end(),
                       [&](std::int32_t part) { return parts.contains(part); });
}

Json options_json(const RepairOptions& options) {
  return {{"goal", to_string(options.goal)},
          {"weld", to_string(options.find.weld)},
          {"weld_tolerance", options.find.weld_tolerance},
          {"threads", options.find.threads},
          {"precision", options.precision ? Json(to_string(*options.precision)) : Json("automatic")},
          {"fixed_vertices", std::count_if(options.fixed.begin(), options.fixed.end(), [](auto f) { return f != 0; })},
          {"rigid_vertices", std::count_if(options.rigid.begin(), options.rigid.end(), [](auto r) { return r >= 0; })},
          {"each_component", options.each_component},
          {"both_diagonals", options.find.both_diagonals},
          {"allowed_faces", faces_that_may_pass(options.find.allowed)},
          {"min_gap_rel", options.min_gap_rel},
          {"gap_near_conflicts", options.gap_near_conflicts},
          {"min_dihedral_deg", options.min_dihedral_deg},
          {"max_displacement_rel", options.max_displacement_rel},
          {"time_limit_s", options.time_limit_s},
          {"memory_limit_mb", options.memory_limit_mb},
          {"recover", options.recover},
          {"paper", options.paper.has_value()}};
}

Json stages_json(const RepairResult& result, const ReportFiles& files) {
  Json stages = Json::array();
  for (const auto* list : {&files.before_repair, &result.report.stages, &files.after_repair})
    for (const StageReport& stage : *list)
      stages.push_back({{"name", stage.name},
                        {"seconds", stage.seconds},
                        {"cpu_seconds", stage.cpu_seconds},
                        {"peak_memory_mb", stage.peak_memory_mb}});
  return stages;
}

/// Distances in diagonals, as all lengths of a report; null where there are no two faces to measure.
Json clearance_json(const Clearance& clearance, double diagonal) {
  const auto entry = [](double value, const std::array<std::int32_t, 2>& faces) {
    Json json;
    json["value"] = std::isfinite(value) ? Json(value) : Json();
    json["faces"] = faces[0] < 0 ? Json() : Json(faces);
    return json;
  };
  const double unit = diagonal > 0 ? 1 / diagonal : 1;
  return {{"dihedral_deg", entry(clearance.dihedral_deg, clearance.dihedral_faces)},
          {"gap_rel", entry(clearance.gap * unit, clearance.gap_faces)},
          {"component_gap_rel", entry(clearance.component_gap * unit, clearance.component_gap_faces)}};
}

Json left_json(const RepairReport& report) {
  Json by_reason = Json::object(), pairs = Json::array();
  for (std::size_t i = 0; i < left_reason_count; ++i)
    if (report.left_by_reason[i] > 0)
      by_reason[std::string(to_string(static_cast<LeftReason>(i)))] = report.left_by_reason[i];
  for (std::size_t i = 0; i < std::min(report.left.size(), most_left_pairs_listed); ++i) {
    const LeftPair& pair = report.left[i];
    pairs.push_back({{"faces", {pair.a, pair.b}},
                     {"class", pair_class_names[static_cast<std::size_t>(pair.kind)]},
                     {"reason", to_string(pair.reason)}});
    if (pair.strategy.empty()) continue;
    pairs.back()["strategy"] = pair.strategy;
    pairs.back()["strategy_0_1"] = strategy_name_of_0_1(pair.strategy);
  }
  return {{"by_reason", by_reason}, {"pairs", pairs}};
}

}  // namespace

std::string report_json(const RepairResult& result, const RepairOptions& options, const ReportFiles& files) {
  const RepairReport& r = result.report;
  Json json;
  json["schema"] = "unsnarl-report";
  json["schema_version"] = report_schema_version;
  json["version"] = version;
  json["status"] = outcome(result.status, files.nested);
  json["exit_code"] = static_cast<int>(exit_code_of(result.status, files.nested));
  const auto text_or_null = [](const std::string& text) { return text.empty() ? Json() : Json(text); };
  json["input"] = {{"path", text_or_null(files.input)}, {"format", text_or_null(files.format)},
                   {"vertices", files.vertices},        {"faces", files.faces},
                   {"triangulation", r.triangulation},  {"notes", files.notes}};
  json["output"] = {
      {"written", !files.output.empty()}, {"path", text_or_null(files.output)}, {"partial", files.partial}};
  add_scene(files.scene, true, json);
  if (!files.nested.empty()) json["nested"] = Json::array();
  for (const NestedPair& pair : files.nested)
    json["nested"].push_back({{"inner", pair.inner},
                              {"outer", pair.outer},
                              {"wrong_before", pair.wrong_before},
                              {"wrong_after", pair.wrong_after},
                              {"nested", pair.is_nested},
                              {"apart", pair.apart}});
  json["options"] = options_json(options);
  json["topology"] = topology_json(r.topology);
  json["before"] = pair_counts_json(r.before);
  json["after"] = pair_counts_json(r.after);
  json["allowed"] = allowed_json(r.allowed_before, r.allowed_after);
  json["obstructions"] = Json::array();
  for (const Obstruction& obstruction : r.obstructions)
    json["obstructions"].push_back(
        {{"kind", to_string(obstruction.kind)}, {"faces", obstruction.faces}, {"message", obstruction.message}});
  json["left"] = left_json(r);
  json["diagonal"] = r.diagonal;
  json["displacement_mean_rel"] = r.displacement_mean_rel;
  json["displacement_rms_rel"] = r.displacement_rms_rel;
  json["displacement_area_rms_rel"] = r.displacement_area_rms_rel;
  json["displacement_max_rel"] = r.displacement_max_rel;
  json["displacement_lower_bound_rel"] = r.displacement_lower_bound_rel;
  json["untouched_share"] = r.untouched_share;
  json["flipped_triangles"] = r.flipped_triangles;
  json["flipped_triangles_without_conflict"] = r.flipped_triangles_without_conflict;
  json["min_gap_rel"] = r.min_gap_rel;
  json["gap"] = gap_json(r.gap);
  json["volume_change_rel"] = r.volume_change_rel;
  json["area_change_rel"] = r.area_change_rel;
  json["edge_stretch_max"] = r.edge_stretch_max;
  json["edge_stretch_p999"] = r.edge_stretch_p999;
  json["float32_embedded"] = r.float32_embedded;
  json["precision"] = to_string(r.precision);
  json["clearance"] = Json::object();
  for (const auto& [when, clearance] :
       {std::pair{"before", &files.clearance_before}, {"after", &files.clearance_after}})
    json["clearance"][when] = *clearance ? clearance_json(**clearance, r.diagonal) : Json();
  json["regions"] = Json::array();
  for (const RegionReport& region : r.regions)
    json["regions"].push_back({{"strategy", region.strategy},
                               {"strategy_0_1", strategy_name_of_0_1(region.strategy)},
                               {"faces", region.faces},
                               {"pairs", region.pairs},
                               {"iterations", region.iterations},
                               {"seconds", region.seconds},
                               {"depth_rel", region.depth_rel},
                               {"displacement_rel", region.displacement_rel},
                               {"farthest_vertex", region.farthest_vertex}});
  if (r.before_recovery)
    json["before_recovery"] = {{"clean", r.before_recovery->is_clean},
                               {"displacement_mean_rel", r.before_recovery->displacement_mean_rel},
                               {"displacement_max_rel", r.before_recovery->displacement_max_rel}};
  json["components"] = Json::array();
  for (const ComponentReport& component : r.components)
    json["components"].push_back({{"component", component.component},
                                  {"first_face", component.first_face},
                                  {"pairs_before", component.pairs_before},
                                  {"pairs_after", component.pairs_after}});
  json["overlapping_components"] = overlapping_components_json(r.overlapping_components);
  json["changed_components"] = changed_components_json(r.changed_components, r.diagonal);
  json["advice"] = Json::array();
  if (!r.overlapping_components.empty()) json["advice"].push_back(advice_on_overlaps(r.overlapping_components));
  json["rigid_parts"] = Json::array();
  for (const RigidPartReport& part : r.rigid_parts)
    json["rigid_parts"].push_back({{"name", part.name},
                                   {"vertices", part.vertices},
                                   {"rotation_deg", part.rotation_deg},
                                   {"translation_rel", part.translation_rel},
                                   {"translation_length", part.translation_rel * r.diagonal},
                                   {"residual_rel", part.residual_rel},
                                   {"rotation", part.rotation},
                                   {"translation", part.translation}});
  add_lengths(json, r.diagonal);
  if (options.record.any()) json["history"] = history_json(r.history);
  json["stages"] = stages_json(result, files);
  json["seconds"] = files.whole.seconds;
  json["peak_memory_mb"] = files.whole.peak_memory_mb;
  return text_of(json);
}

std::string pairs_json(const PairCounts& counts) {
  return pair_counts_json(counts).dump();
}

std::optional<Status> status_from_name(std::string_view name) {
  for (const Status status :
       {Status::embedded, Status::reduced, Status::no_progress, Status::obstructed, Status::allowed, Status::time_limit,
        Status::memory_limit, Status::displacement_exceeded, Status::cancelled, Status::gap_not_met})
    if (to_string(status) == name) return status;
  return std::nullopt;
}

std::string_view to_string(Weld weld) {
  switch (weld) {
    case Weld::none: return "none";
    case Weld::seams: return "seams";
    case Weld::all: return "all";
  }
  return "unknown";
}

std::string_view to_string(Goal goal) {
  return goal == Goal::all ? "all" : "disjoint";
}

}  // namespace unsnarl
