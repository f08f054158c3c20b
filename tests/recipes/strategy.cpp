// What CONTRIBUTING.md promises of its strategy: it is in the table, and resolves what lifting can resolve.
#include <cstdio>

#include "scene/shapes.h"
#include "untangle/escalation.h"
#include "untangle/strategies.h"

int main() {
  using namespace unsnarl;
  const int number = strategy_number("lifting");
  if (number < 0 || strategy_name(number) != "lifting") return std::puts("not in the table"), 1;
  // Two sheets that overlap by less than the lift, the lower one fixed.
  const shapes::Shape shape = shapes::crossing_bumps(12, 0.5);
  std::vector<std::uint8_t> fixed(shape.points.size(), 0);
  std::fill(fixed.begin(), fixed.begin() + static_cast<std::ptrdiff_t>(fixed.size() / 2), std::uint8_t{1});
  Scene scene = make_scene(shape.positions(), shape.triangles, fixed);
  SceneIndex index(scene);
  EscalationOptions options;
  options.tiers = default_tiers();
  for (int k = 0; k <= last_strategy(); ++k)
    if (k != number) options.left_out.emplace_back(strategy_name(k));
  const EscalationResult result = escalate(scene, index, {}, options);
  if (!result.left.empty() || result.regions.front().strategy != "lifting") return std::puts("not resolved"), 1;
}
