#include <nlohmann/json.hpp>
#include <string>

#include "unsnarl/curves.h"
#include "unsnarl/exit_code.h"

namespace unsnarl {
namespace {

nlohmann::ordered_json json_of_crossings(std::span<const CurveCrossing> crossings) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const CurveCrossing& c : crossings)
    list.push_back(
        {{"curve_a", c.curve_a}, {"segment_a", c.segment_a}, {"curve_b", c.curve_b}, {"segment_b", c.segment_b}});
  return list;
}

}  // namespace

std::string curve_report_json(const CurveResult& result) {
  const CurveReport& r = result.report;
  const nlohmann::ordered_json json = {
      {"status", to_string(result.status)},
      {"exit_code", static_cast<int>(exit_code_of(result.status))},
      {"curves", result.curves.size()},
      {"points", r.points},
      {"crossings_before", r.crossings_before},
      {"crossings_after", r.crossings_after},
      {"diagonal", r.diagonal},
      {"displacement_mean_rel", r.displacement_mean_rel},
      {"displacement_mean", r.displacement_mean_rel * r.diagonal},
      {"displacement_max_rel", r.displacement_max_rel},
      {"displacement_max", r.displacement_max_rel * r.diagonal},
      {"distance_mean_rel", r.distance_mean_rel},
      {"distance_mean", r.distance_mean_rel * r.diagonal},
      {"distance_max_rel", r.distance_max_rel},
      {"distance_max", r.distance_max_rel * r.diagonal},
      {"drawing_distance_mean_rel", r.drawing_distance_mean_rel},
      {"drawing_distance_mean", r.drawing_distance_mean_rel * r.diagonal},
      {"drawing_distance_max_rel", r.drawing_distance_max_rel},
      {"drawing_distance_max", r.drawing_distance_max_rel * r.diagonal},
      {"drawing_lost", r.drawing_lost},
      {"moved_points", r.moved_points},
      {"turned_points", r.turned_points},
      {"inserted_points", r.inserted_points},
      {"joints", r.joints.size()},
      {"obstructions", json_of_crossings(r.fixed)},
      {"left", json_of_crossings(r.left)},
      {"seconds", r.seconds},
  };
  return json.dump();
}

}  // namespace unsnarl
