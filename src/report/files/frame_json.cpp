#include <optional>

#include "report/files/shared_json.h"
#include "unsnarl/report_json.h"
#include "unsnarl/sequence.h"

namespace unsnarl {
namespace {

nlohmann::ordered_json jitter_or_null(const std::optional<Jitter>& jitter) {
  if (!jitter) return nullptr;
  return {{"mean_rel", jitter->mean_rel}, {"max_rel", jitter->max_rel}};
}

}  // namespace

std::string frame_json(const FrameReport& r) {
  const nlohmann::ordered_json json = {
      {"frame", r.frame},
      {"status", to_string(r.status)},
      {"before", pair_counts_json(r.before)},
      {"after", pair_counts_json(r.after)},
      {"allowed", allowed_json(r.allowed_before, r.allowed_after)},
      {"diagonal", r.diagonal},
      {"displacement_mean_rel", r.displacement_mean_rel},
      {"displacement_mean", r.displacement_mean_rel * r.diagonal},
      {"displacement_max_rel", r.displacement_max_rel},
      {"displacement_max", r.displacement_max_rel * r.diagonal},
      {"untouched_share", r.untouched_share},
      {"float32_embedded", r.float32_embedded},
      {"precision", to_string(r.precision)},
      {"is_smoothed", r.is_smoothed},
      {"changed_components", changed_components_json(r.changed_components, r.diagonal)},
      {"jitter_alone", jitter_or_null(r.alone)},
      {"jitter", jitter_or_null(r.jitter)}};
  return json.dump();
}

}  // namespace unsnarl
