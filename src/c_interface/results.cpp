#include "results.h"

#include <nlohmann/json.hpp>

#include <utility>

namespace unsnarl::c_interface {

unsnarl_result result_of_repair(RepairResult repaired, RepairFileOptions options, const ReportFiles& files) {
  unsnarl_result result;
  result.status = outcome(repaired.status, files.nested);
  result.report = report_json(repaired, options.repair, files);
  result.arrays["positions"] = {std::move(repaired.positions), 3};
  options.repair.as_written = {};
  result.repaired = {std::move(repaired), std::move(options)};
  return result;
}

void add_polylines(unsnarl_result& result, const std::vector<std::vector<double>>& polylines, std::size_t dimension) {
  std::vector<double> points;
  std::vector<std::int32_t> offsets = {0};
  for (const std::vector<double>& polyline : polylines) {
    points.insert(points.end(), polyline.begin(), polyline.end());
    offsets.push_back(static_cast<std::int32_t>(points.size() / dimension));
  }
  result.arrays["points"] = {std::move(points), dimension};
  result.arrays["offsets"] = {std::move(offsets)};
}

void add_triangles(unsnarl_result& result, Surface surface) {
  result.arrays["positions"] = {std::move(surface.positions), 3};
  result.arrays["corners"] = {std::move(surface.corners), 3};
}

}  // namespace unsnarl::c_interface
