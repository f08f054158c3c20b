#include "report/report_json.h"

#include <algorithm>

#include "report/exit_code.h"
#include "report/process_usage.h"
#include "report/recording_json.h"
#include "unsnarl/version.h"

namespace unsnarl {
namespace {

using Json = nlohmann::ordered_json;

Json options_json(const RepairOptions& options) {
  return {{"goal", to_string(options.goal)},
          {"weld", to_string(options.find.weld)},
          {"weld_tolerance", options.find.weld_tolerance},
          {"threads", options.find.threads},
          {"precision", options.precision ? Json(to_string(*options.precision)) : Json("automatic")},
          {"fixed_vertices", std::count_if(options.fixed.begin(), options.fixed.end(), [](auto f) { return f != 0; })},
          {"each_component", options.each_component},
          {"both_diagonals", options.find.both_diagonals},
          {"min_gap_rel", options.min_gap_rel},
          {"max_displacement_rel", options.max_displacement_rel},
          {"time_limit_s", options.time_limit_s},
          {"memory_limit_mb", options.memory_limit_mb},
          {"recover", options.recover},
          {"paper", options.paper}};
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

Json left_json(const RepairReport& report) {
  Json by_reason = Json::object(), pairs = Json::array();
  for (std::size_t i = 0; i < left_reason_count; ++i)
    if (report.left_by_reason[i] > 0)
      by_reason[std::string(to_string(static_cast<LeftReason>(i)))] = report.left_by_reason[i];
  for (const LeftPair& pair : report.left) {
    pairs.push_back({{"faces", {pair.a, pair.b}},
                     {"class", pair_class_names[static_cast<std::size_t>(pair.kind)]},
                     {"reason", to_string(pair.reason)}});
    if (!pair.strategy.empty()) pairs.back()["strategy"] = pair.strategy;
  }
  return {{"by_reason", by_reason}, {"pairs", pairs}};
}

}  // namespace

Json topology_json(const Topology& t) {
  return {{"vertices", t.vertices},
          {"faces", t.faces},
          {"triangles", t.triangles},
          {"components", t.components},
          {"closed_components", t.closed_components},
          {"non_orientable_components", t.non_orientable_components},
          {"boundary_edges", t.boundary_edges},
          {"non_manifold_edges", t.non_manifold_edges},
          {"non_manifold_vertices", t.non_manifold_vertices},
          {"duplicate_faces", t.duplicate_faces},
          {"zero_area_faces", t.zero_area_faces},
          {"duplicate_vertices", t.duplicate_vertices},
          {"unused_vertices", t.unused_vertices}};
}

Json pair_counts_json(const PairCounts& counts) {
  Json by_class = Json::object();
  for (std::size_t i = 0; i < pair_class_count; ++i) by_class[std::string(pair_class_names[i])] = counts.by_class[i];
  return {{"total", counts.total()}, {"by_class", by_class}};
}

Json report_json(const RepairResult& result, const RepairOptions& options, const ReportFiles& files) {
  const RepairReport& r = result.report;
  Json json;
  json["schema"] = "unsnarl-report";
  json["schema_version"] = report_schema_version;
  json["version"] = version;
  json["status"] = to_string(result.status);
  json["exit_code"] = static_cast<int>(exit_code_of(result.status));
  const auto text_or_null = [](const std::string& text) { return text.empty() ? Json() : Json(text); };
  json["input"] = {{"path", text_or_null(files.input)},    {"format", text_or_null(files.format)},
                   {"vertices", files.vertices},           {"faces", files.faces},
                   {"triangulation", files.triangulation}, {"notes", files.notes}};
  json["output"] = {{"written", !files.output.empty()}, {"path", text_or_null(files.output)}};
  json["options"] = options_json(options);
  json["topology"] = topology_json(r.topology);
  json["before"] = pair_counts_json(r.before);
  json["after"] = pair_counts_json(r.after);
  json["obstructions"] = Json::array();
  for (const Obstruction& obstruction : r.obstructions)
    json["obstructions"].push_back(
        {{"kind", to_string(obstruction.kind)}, {"faces", obstruction.faces}, {"message", obstruction.message}});
  json["left"] = left_json(r);
  json["diagonal"] = r.diagonal;
  json["displacement_mean_rel"] = r.displacement_mean_rel;
  json["displacement_rms_rel"] = r.displacement_rms_rel;
  json["displacement_max_rel"] = r.displacement_max_rel;
  json["displacement_lower_bound_rel"] = r.displacement_lower_bound_rel;
  json["untouched_share"] = r.untouched_share;
  json["flipped_triangles"] = r.flipped_triangles;
  json["flipped_triangles_without_conflict"] = r.flipped_triangles_without_conflict;
  json["min_gap_rel"] = r.min_gap_rel;
  json["volume_change_rel"] = r.volume_change_rel;
  json["area_change_rel"] = r.area_change_rel;
  json["edge_stretch_max"] = r.edge_stretch_max;
  json["edge_stretch_p999"] = r.edge_stretch_p999;
  json["float32_embedded"] = r.float32_embedded;
  json["precision"] = to_string(r.precision);
  json["regions"] = Json::array();
  for (const RegionReport& region : r.regions)
    json["regions"].push_back({{"strategy", region.strategy},
                               {"faces", region.faces},
                               {"pairs", region.pairs},
                               {"iterations", region.iterations},
                               {"seconds", region.seconds}});
  json["components"] = Json::array();
  for (const ComponentReport& component : r.components)
    json["components"].push_back({{"component", component.component},
                                  {"first_face", component.first_face},
                                  {"pairs_before", component.pairs_before},
                                  {"pairs_after", component.pairs_after}});
  if (options.record.any()) json["history"] = history_json(r.history);
  json["stages"] = stages_json(result, files);
  json["seconds"] = files.seconds;
  json["peak_memory_mb"] = peak_memory_mb();
  return json;
}

std::string_view to_string(Status status) {
  switch (status) {
    case Status::embedded: return "embedded";
    case Status::reduced: return "reduced";
    case Status::no_progress: return "no_progress";
    case Status::obstructed: return "obstructed";
    case Status::time_limit: return "time_limit";
    case Status::memory_limit: return "memory_limit";
    case Status::displacement_exceeded: return "displacement_exceeded";
    case Status::cancelled: return "cancelled";
  }
  return "unknown";
}

std::string_view to_string(Obstruction::Kind kind) {
  switch (kind) {
    case Obstruction::Kind::closed_non_orientable: return "closed_non_orientable";
    case Obstruction::Kind::duplicate_faces: return "duplicate_faces";
    case Obstruction::Kind::fixed_faces: return "fixed_faces";
    case Obstruction::Kind::between_components: return "between_components";
  }
  return "unknown";
}

std::string_view to_string(LeftReason reason) {
  switch (reason) {
    case LeftReason::closed_non_orientable: return "closed_non_orientable";
    case LeftReason::duplicate_faces: return "duplicate_faces";
    case LeftReason::fixed_faces: return "fixed_faces";
    case LeftReason::between_components: return "between_components";
    case LeftReason::goal: return "goal";
    case LeftReason::rounding: return "rounding";
    case LeftReason::displacement: return "displacement";
    case LeftReason::taken_back: return "taken_back";
    case LeftReason::time_limit: return "time_limit";
    case LeftReason::memory_limit: return "memory_limit";
    case LeftReason::cancelled: return "cancelled";
    case LeftReason::unresolved: return "unresolved";
    case LeftReason::other_diagonal: return "other_diagonal";
  }
  return "unknown";
}

std::string_view to_string(Weld weld) {
  switch (weld) {
    case Weld::none: return "none";
    case Weld::seams: return "seams";
    case Weld::all: return "all";
  }
  return "unknown";
}

std::string_view to_string(Precision precision) {
  return precision == Precision::float32 ? "float32" : "float64";
}

std::string_view to_string(Goal goal) {
  return goal == Goal::all ? "all" : "disjoint";
}

}  // namespace unsnarl
