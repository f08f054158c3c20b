#include <optional>
#include <string>

#include "fuzz/promise.h"
#include "fuzz/targets.h"
#include "unsnarl/document.h"
#include "unsnarl/routes.h"

namespace unsnarl::fuzz {
namespace {

/// Agents up to which straight routes are certified too.
constexpr std::size_t most_agents = 10;

template <class Parse>
auto parsed(Parse&& parse) -> std::optional<decltype(parse())> {
  try {
    return parse();
  } catch (const FileError& refusal) {
    promise(refusal.what()[0] != '\0', "a refusal has a reason");
    return std::nullopt;
  }
}

}  // namespace

void routes_plan(Bytes bytes) {
  const std::string text(bytes.begin(), bytes.end());
  if (text.find("file") != std::string::npos) return;  // which could name any device
  const std::optional<RoutePlan> plan = parsed([&] { return parse_route_plan(text); });
  if (!plan) return;
  const std::string written = route_plan_json(*plan);
  promise(route_plan_json(parse_route_plan(written)) == written, "a plan comes back as it was written");
  const bool is_obstructed = !route_obstructions(*plan).empty();
  if (plan->agents.size() > most_agents) return;
  RoutesResult straight;
  for (const RouteAgent& agent : plan->agents) {
    Route& route = straight.routes.emplace_back();
    route.points.push_back(agent.start);
    route.points.insert(route.points.end(), agent.waypoints.begin(), agent.waypoints.end());
    route.points.push_back(agent.goal);
  }
  straight.found = check_routes(*plan, straight.routes);
  promise(straight.found.places_kept, "straight routes go through their places");
  promise(!(is_obstructed && straight.found.hold()) || !plan->obstacles.empty(), "what is obstructed does not hold");
  const std::vector<Route> back = parse_routes(routes_json(*plan, straight), *plan);
  for (std::size_t i = 0; i < back.size(); ++i)
    promise(back[i].points == straight.routes[i].points, "routes come back as they were written");
  parsed([&] { return parse_routes(text, *plan); });
}

}  // namespace unsnarl::fuzz
