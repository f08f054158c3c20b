#include <nlohmann/json.hpp>

#include "report/files/shared_json.h"
#include "unsnarl/report_json.h"
#include "unsnarl/version.h"

namespace unsnarl {
namespace {

using Json = nlohmann::ordered_json;

}  // namespace

std::string check_json(const CheckReport& found, Goal goal, const FindOptions& options, const ReportFiles& files) {
  Json json;
  json["schema"] = "unsnarl-check";
  json["schema_version"] = check_schema_version;
  json["version"] = version;
  const auto text_or_null = [](const std::string& text) { return text.empty() ? Json() : Json(text); };
  json["input"] = {{"path", text_or_null(files.input)},    {"format", text_or_null(files.format)},
                   {"vertices", files.vertices},           {"faces", files.faces},
                   {"triangulation", found.triangulation}, {"notes", files.notes}};
  add_scene(files.scene, false, json);
  json["options"] = {{"goal", to_string(goal)},
                     {"weld", to_string(options.weld)},
                     {"weld_tolerance", options.weld_tolerance},
                     {"both_diagonals", options.both_diagonals}};
  json["pairs"] = pair_counts_json(found.counts);
  json["allowed"] = pair_counts_json(found.allowed);
  json["gap"] = gap_json(found.gap);
  json["intersecting_faces"] = found.faces.size();
  json["components"] = {{"total", found.topology.components},
                        {"intersecting", found.intersecting_components},
                        {"pairs_within", found.pairs_within_components},
                        {"pairs_between", found.counts.total() - found.pairs_within_components},
                        {"closed_non_orientable", found.closed_non_orientable},
                        {"list", Json::array()}};
  for (const ComponentFindings& component : found.components)
    json["components"]["list"].push_back({{"first_face", component.first_face},
                                          {"faces", component.faces},
                                          {"vertices", component.vertices},
                                          {"pairs_within", component.pairs_within},
                                          {"pairs_with_others", component.pairs_with_others},
                                          {"min", component.bounds.min},
                                          {"max", component.bounds.max}});
  json["overlapping_components"] = overlapping_components_json(found.overlapping_components);
  json["advice"] = Json::array();
  if (!found.overlapping_components.empty()) json["advice"].push_back(advice_on_overlaps(found.overlapping_components));
  json["parts"] = Json::array();
  for (const NamedPart& part : files.parts)
    json["parts"].push_back(
        {{"kind", to_string(part.kind)}, {"name", part.name}, {"faces", part.faces}, {"vertices", part.vertices}});
  json["topology"] = topology_json(found.topology);
  json["places"] = Json::array();
  for (const ConflictPlace& place : found.places)
    json["places"].push_back({{"pairs", place.pairs},
                              {"faces", place.faces.size()},
                              {"first_face", place.faces.front()},
                              {"min", place.bounds.min},
                              {"max", place.bounds.max}});
  return text_of(json);
}

}  // namespace unsnarl
