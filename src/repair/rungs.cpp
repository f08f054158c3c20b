#include "repair/rungs.h"

#include <algorithm>
#include <array>
#include <vector>

namespace unsnarl {
namespace {

/// Gentle rungs hold vertices with more neighbours than this. The needles of a CAD export met at two of 1900.
constexpr std::size_t hub_valence = 100;

/// Regions at least so deep, in edges, are untangled on a coarser mesh where gentle rungs fail, without shortening
/// curves on the fine one (that took fine bodies up to 60 % longer, and brought one of all closer) ...
constexpr int deep = 10;
/// ... and so deep before these. (A curled body, 27 deep: gentle rungs end 20 % closer, with 2 turned faces, not 39.
/// Every face cut in four, 54 deep: with the coarser mesh first it ends a quarter closer. Measured when recovery still
/// put turned faces back, not since.)
constexpr int very_deep = 32;

constexpr LocalRung shallow = {LocalMethod::shallow, 0.1, 1, 20};
constexpr LocalRung contour = {LocalMethod::contour, 0.1, 2, 60};
constexpr LocalRung long_contour = {LocalMethod::contour, 0.3, 4, 60};
constexpr LocalRung shorten = {LocalMethod::shorten, 0.1, 2, 60};
constexpr LocalRung long_shorten = {LocalMethod::shorten, 0.3, 4, 60};
constexpr LocalRung smoothing = {LocalMethod::smoothing, 0.1, 3, 60};
constexpr LocalRung wide_smoothing = {LocalMethod::smoothing, 0.1, 5, 100};

constexpr Rung coarser(int least_depth) {
  return {"coarser", by_depth, nullptr, nullptr, no_hubs, least_depth};
}

}  // namespace

std::span<const Rung> gentle_rungs() {
  static const std::array<Rung, 6> rungs = {{
      {"shallow-0", 0, &shallow, nullptr, hub_valence},
      {"contour-2", 2, &contour, nullptr, hub_valence},
      {"contour-4", 4, &contour, nullptr, hub_valence},
      {"contour-8", 8, &long_contour, nullptr},
      // Few rings: with 4 and 8, 2 and 6, or 8 and 16 what contours leave of twelve meshes moves 13 to 19 % farther
      // (measured at any depth).
      {"shorten-2", 2, &shorten, nullptr, no_hubs, 0, deep},
      {"shorten-4", 4, &long_shorten, nullptr, no_hubs, 0, deep},
  }};
  return rungs;
}

std::span<const Rung> wild_rungs() {
  static const FlowRung& flow = *std::find_if(default_flow_rungs().begin(), default_flow_rungs().end(),
                                              [](const FlowRung& rung) { return rung.name == "flow 1b"; });
  static const std::array<Rung, 6> rungs = {{
      coarser(deep),
      {"smoothing-4", 4, &smoothing, nullptr},
      {"flow-8", 8, nullptr, &flow},
      {"smoothing-8", 8, &wide_smoothing, nullptr},
      {"flow-16", 16, nullptr, &flow},
      // Of what a coarser mesh had left, 32 pairs: in 0.1 s, where flows of the component kept 103 after 70 s. (With
      // 8 rings they are left here too.)
      {"coarser-16", 16, nullptr, nullptr},
  }};
  return rungs;
}

std::span<const Rung> wild_rungs_of_coarser_mesh() {
  const std::span<const Rung> all = wild_rungs();
  const auto is_left_out = [](const Rung& rung) { return rung.is_on_coarser_mesh() && rung.rings != by_depth; };
  return {all.begin(), std::find_if(all.begin(), all.end(), is_left_out)};
}

std::span<const Rung> whole_component_rungs() {
  static const std::vector<Rung> rungs = [] {
    std::vector<Rung> all;
    for (const FlowRung& flow : default_flow_rungs())
      if (flow.line_search) all.push_back({flow.name, whole_component, nullptr, &flow});
    return all;
  }();
  return rungs;
}

std::span<const Rung> coarser_first() {
  static constexpr std::array<Rung, 1> rungs = {coarser(very_deep)};
  return rungs;
}

std::span<const Rung> coarser_first_again() {
  static constexpr std::array<Rung, 1> rungs = {coarser(deep)};
  return rungs;
}

std::span<const Rung> second_way_rungs() {
  return whole_component_rungs().first(2);
}

bool frees_whole_components(std::string_view rung) {
  const std::span<const Rung> whole = whole_component_rungs();
  return std::any_of(whole.begin(), whole.end(), [&](const Rung& r) { return r.name == rung; });
}

std::string_view rung_name(int number) {
  auto left = static_cast<std::size_t>(number);
  for (const std::span<const Rung> rungs : {gentle_rungs(), wild_rungs()}) {
    if (left < rungs.size()) return rungs[left].name;
    left -= rungs.size();
  }
  return whole_component_rungs()[left].name;
}

int last_rung() {
  return static_cast<int>(gentle_rungs().size() + wild_rungs().size() + whole_component_rungs().size()) - 1;
}

}  // namespace unsnarl
