#include "report/files/shared_json.h"

#include <optional>
#include <string_view>

namespace unsnarl {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view relative = "_rel";

/// Changes of areas and volumes are fractions of these.
bool is_length(std::string_view key) {
  return key.ends_with(relative) && !key.ends_with("_change_rel");
}

/// A number, or the "value" of an object, times the unit; nothing: it is neither.
std::optional<Json> times(const Json& relative_length, double unit) {
  if (relative_length.is_number()) return relative_length.get<double>() * unit;
  if (!relative_length.is_object() || !relative_length.contains("value")) return std::nullopt;
  Json length = relative_length;
  if (length["value"].is_number()) length["value"] = length["value"].get<double>() * unit;
  return length;
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

Json overlapping_components_json(std::span<const OverlappingComponent> overlapping) {
  Json list = Json::array();
  for (const OverlappingComponent& component : overlapping)
    list.push_back({{"component", component.component},
                    {"first_face", component.first_face},
                    {"name", component.name.empty() ? Json() : Json(component.name)},
                    {"volume_share", component.volume_share}});
  return list;
}

Json changed_components_json(std::span<const ChangedComponent> changed, double diagonal) {
  Json list = Json::array();
  for (const ChangedComponent& component : changed) {
    Json why = Json::array();
    for (const auto& [holds, name] : {std::pair{component.has_shrunk, "shrunk"},
                                      {component.is_turned, "turned"},
                                      {component.is_far, "far"},
                                      {component.is_creased, "creased"}})
      if (holds) why.push_back(name);
    list.push_back({{"component", component.component},
                    {"first_face", component.first_face},
                    {"name", component.name.empty() ? Json() : Json(component.name)},
                    {"why", why},
                    {component.is_closed ? "volume_change_rel" : "area_change_rel", component.size_change_rel},
                    {"rotation_deg", component.rotation_deg},
                    {"displacement_rel", component.displacement_rel},
                    {"farthest_vertex", component.farthest_vertex},
                    {"depth_rel", component.depth_rel ? Json(*component.depth_rel) : Json()},
                    {"creased_share", component.creased_share},
                    {"message", describe(component, diagonal)}});
  }
  return list;
}

Json allowed_json(const PairCounts& before, const PairCounts& after) {
  return {{"before", pair_counts_json(before)}, {"after", pair_counts_json(after)}};
}

void add_scene(const SceneReport& scene, bool after, Json& json) {
  if (scene.files.empty()) return;
  const auto text_or_null = [](const std::string& text) { return text.empty() ? Json() : Json(text); };
  const auto add_pairs = [&](const ScenePairs& pairs, Json& to) {
    if (!after) {
      to["pairs"] = pair_counts_json(pairs.before);
      to["allowed"] = pair_counts_json(pairs.allowed_before);
      return;
    }
    to["before"] = pair_counts_json(pairs.before);
    to["after"] = pair_counts_json(pairs.after);
    to["allowed"] = allowed_json(pairs.allowed_before, pairs.allowed_after);
  };
  json["files"] = json["between_files"] = Json::array();
  for (std::size_t i = 0; i < scene.files.size(); ++i) {
    const SceneFileReport& report = scene.files[i];
    Json file = {{"name", report.file.name},
                 {"path", text_or_null(report.input)},
                 {"format", text_or_null(report.format)},
                 {"first_vertex", report.file.first_vertex},
                 {"vertices", report.file.vertices},
                 {"first_face", report.file.first_face},
                 {"faces", report.file.faces}};
    add_pairs(scene.pairs[i], file);
    if (after) {
      file["output"] = text_or_null(report.output);
      file["displacement_mean_rel"] = report.displacement_mean_rel;
      file["displacement_max_rel"] = report.displacement_max_rel;
      file["untouched_share"] = report.untouched_share;
    }
    json["files"].push_back(std::move(file));
  }
  for (std::size_t k = scene.files.size(); k < scene.pairs.size(); ++k) {
    const ScenePairs& pairs = scene.pairs[k];
    Json between = {{"files", {scene.files[pairs.a].file.name, scene.files[pairs.b].file.name}}};
    add_pairs(pairs, between);
    json["between_files"].push_back(std::move(between));
  }
}

Json gap_json(const std::optional<GapReport>& gap) {
  if (!gap) return {};
  const bool is_known = gap->faces[0] >= 0;
  return {{"asked_rel", gap->asked_rel},
          {"smallest_rel", is_known ? Json(gap->smallest_rel) : Json()},
          {"met", gap->is_met()},
          {"faces", is_known ? Json(gap->faces) : Json()},
          {"position", is_known ? Json(gap->position) : Json()},
          {"between_held", gap->is_between_held}};
}

void add_lengths(Json& json, double diagonal) {
  if (json.is_array())
    for (Json& entry : json) add_lengths(entry, diagonal);
  if (!json.is_object()) return;
  Json with_lengths = Json::object();
  for (auto& [key, value] : json.items()) {
    add_lengths(value, diagonal);
    const std::string name = is_length(key) ? key.substr(0, key.size() - relative.size()) : std::string();
    const std::optional<Json> length = name.empty() || json.contains(name) ? std::nullopt : times(value, diagonal);
    with_lengths[key] = std::move(value);
    if (length) with_lengths[name] = *length;
  }
  json = std::move(with_lengths);
}

std::string text_of(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace unsnarl
