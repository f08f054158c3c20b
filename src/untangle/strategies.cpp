#include "untangle/strategies.h"

#include <algorithm>
#include <array>
#include <vector>

namespace unsnarl {
namespace {

/// Gentle strategies hold vertices with more neighbours than this. The needles of a CAD export met at two of 1900.
constexpr std::size_t hub_valence = 100;

/// Regions at least so deep, in edges, are untangled on a coarser mesh where gentle strategies fail, without shortening
/// curves on the fine one (that took fine bodies up to 60 % longer, and brought one of all closer) ...
constexpr int deep = 10;
/// ... and so deep before these. (27k faces of a warped torus, 4 deep: nearer, in half the time. 6.6k faces, 2 deep:
/// 0.53 % instead of 0.41.)
constexpr int very_deep = 4;

constexpr LocalStrategy shallow = {LocalMethod::shallow, 0.1, 1, 20};
constexpr LocalStrategy contour = {LocalMethod::contour, 0.1, 2, 60};
constexpr LocalStrategy long_contour = {LocalMethod::contour, 0.3, 4, 60};
constexpr LocalStrategy shorten = {LocalMethod::shorten, 0.1, 2, 60};
constexpr LocalStrategy long_shorten = {LocalMethod::shorten, 0.3, 4, 60};
constexpr LocalStrategy smoothing = {LocalMethod::smoothing, 0.1, 3, 60};
constexpr LocalStrategy fill = {LocalMethod::smoothing, 0.1, 12, 100};
constexpr LocalStrategy wide_fill = {LocalMethod::smoothing, 0.1, 24, 100};
constexpr LocalStrategy wide_smoothing = {LocalMethod::smoothing, 0.1, 5, 100};

constexpr Strategy coarser(int least_depth) {
  return {"coarser", by_depth, nullptr, nullptr, no_hubs, least_depth};
}

}  // namespace

std::span<const Strategy> gentle_strategies() {
  static const std::array<Strategy, 6> strategies = {{
      {"shallow-0", 0, &shallow, nullptr, hub_valence},
      {"contour-2", 2, &contour, nullptr, hub_valence},
      {"contour-4", 4, &contour, nullptr, hub_valence},
      {"contour-8", 8, &long_contour, nullptr},
      // Few rings: with 4 and 8, 2 and 6, or 8 and 16 what contours leave of twelve meshes moves 13 to 19 % farther
      // (measured at any depth).
      {"shorten-2", 2, &shorten, nullptr, no_hubs, 0, deep},
      {"shorten-4", 4, &long_shorten, nullptr, no_hubs, 0, deep},
  }};
  return strategies;
}

std::span<const Strategy> wild_strategies() {
  static const FlowRung& flow = *std::find_if(default_flow_strategies().begin(), default_flow_strategies().end(),
                                              [](const FlowRung& strategy) { return strategy.name == "flow 1b"; });
  static const std::array<Strategy, 6> strategies = {{
      coarser(deep),
      {"smoothing-4", 4, &smoothing, nullptr},
      {"flow-8", 8, nullptr, &flow},
      {"smoothing-8", 8, &wide_smoothing, nullptr},
      {"flow-16", 16, nullptr, &flow},
      // Of what a coarser mesh had left, 32 pairs: in 0.1 s, where flows of the component kept 103 after 70 s. (With
      // 8 rings they are left here too.)
      {"coarser-16", 16, nullptr, nullptr},
  }};
  return strategies;
}

std::span<const Strategy> wild_strategies_of_coarser_mesh() {
  static const std::array<Strategy, 4> strategies = {{
      {"smoothing-4", 4, &smoothing, nullptr},
      {"smoothing-8", 8, &wide_smoothing, nullptr},
      {"fill-8", 8, &fill, nullptr},
      {"fill-16", 16, &wide_fill, nullptr},
  }};
  return strategies;
}

std::span<const Strategy> whole_component_strategies() {
  static const std::vector<Strategy> strategies = [] {
    std::vector<Strategy> all;
    for (const FlowRung& flow : default_flow_strategies())
      if (flow.line_search) all.push_back({flow.name, whole_component, nullptr, &flow});
    return all;
  }();
  return strategies;
}

std::span<const Strategy> coarser_first() {
  static constexpr std::array<Strategy, 1> strategies = {coarser(very_deep)};
  return strategies;
}

std::span<const Strategy> coarser_first_again() {
  static constexpr std::array<Strategy, 1> strategies = {coarser(deep)};
  return strategies;
}

std::span<const Strategy> second_way_strategies() {
  return whole_component_strategies().first(2);
}

bool frees_whole_components(std::string_view strategy) {
  const std::span<const Strategy> whole = whole_component_strategies();
  return std::any_of(whole.begin(), whole.end(), [&](const Strategy& r) { return r.name == strategy; });
}

std::string_view strategy_name(int number) {
  auto left = static_cast<std::size_t>(number);
  for (const std::span<const Strategy> strategies : {gentle_strategies(), wild_strategies()}) {
    if (left < strategies.size()) return strategies[left].name;
    left -= strategies.size();
  }
  return whole_component_strategies()[left].name;
}

int last_strategy() {
  return static_cast<int>(gentle_strategies().size() + wild_strategies().size() + whole_component_strategies().size()) -
         1;
}

}  // namespace unsnarl
