#include "report/files/recording_json.h"

#include <bit>
#include <cmath>
#include <cstdint>

#include "io/base64.h"
#include "io/byte_order.h"
#include "unsnarl/report_json.h"
#include "unsnarl/version.h"

namespace unsnarl {
namespace {

using Json = nlohmann::ordered_json;

/// Little-endian 4-byte values in base64.
template <class Value, class Source>
std::string packed(const std::vector<Source>& values) {
  static_assert(sizeof(Value) == 4);
  std::string bytes(4 * values.size(), '\0');
  for (std::size_t i = 0; i < values.size(); ++i)
    store(bytes.data() + 4 * i, static_cast<Value>(values[i]), std::endian::little);
  return base64_encoded(bytes);
}

Json frames_json(std::span<const RecordedFrame> frames) {
  Json json = Json::array();
  for (const RecordedFrame& frame : frames)
    json.push_back({{"phase", frame.phase},
                    {"strategy", frame.strategy},
                    {"iteration", frame.iteration},
                    {"pairs", frame.pairs},
                    {"allowed", frame.allowed},
                    {"intersecting", packed<std::int32_t>(frame.intersecting)},
                    {"vertices", packed<std::int32_t>(frame.vertices)},
                    {"displacements", packed<float>(frame.displacements)}});
  return json;
}

}  // namespace

Json history_json(std::span<const RegionHistory> history) {
  Json json = Json::array();
  for (const RegionHistory& region : history) {
    Json pairs = Json::array(), step = Json::array(), min_gap = Json::array(), energy = Json::object();
    Json bandwidth = Json::array();
    for (const IterationRecord& iteration : region.iterations) {
      pairs.push_back(iteration.pairs);
      step.push_back(iteration.step);
      min_gap.push_back(iteration.min_gap);
      bandwidth.push_back(iteration.bandwidth);
    }
    for (std::size_t term = 0; term < energy_term_count; ++term) {
      Json values = Json::array();
      bool any = false;
      for (const IterationRecord& iteration : region.iterations) {
        values.push_back(iteration.energy[term]);
        any |= !std::isnan(iteration.energy[term]);
      }
      if (any) energy[std::string(energy_term_names[term])] = std::move(values);
    }
    json.push_back({{"phase", region.phase},
                    {"strategy", region.strategy},
                    {"region", region.region},
                    {"pairs", std::move(pairs)},
                    {"step", std::move(step)},
                    {"min_gap", std::move(min_gap)},
                    {"energy", std::move(energy)}});
    if (region.bandwidths.empty()) continue;
    json.back()["bandwidth"] = std::move(bandwidth);
    json.back()["bandwidths"] = packed<float>(region.bandwidths);
  }
  return json;
}

std::string recording_json(const RepairResult& result, const SurfaceView& surface) {
  Json json;
  json["schema"] = "unsnarl-recording";
  json["schema_version"] = recording_schema_version;
  json["version"] = version;
  json["status"] = to_string(result.status);
  json["vertices"] = surface.vertex_count();
  json["faces"] = surface.face_count();
  json["diagonal"] = result.report.diagonal;
  json["history"] = history_json(result.report.history);
  json["frames"] = frames_json(result.frames);
  return json.dump();
}

}  // namespace unsnarl
