#include "unsnarl/routes.h"

#include <nlohmann/json.hpp>

#include "arguments.h"
#include "results.h"

namespace unsnarl::c_interface {
namespace {

Json json_of(const RouteFindings& found) {
  return {{"hold", found.hold()},
          {"clearance", found.clearance},
          {"obstacle_clearance", found.obstacle_clearance},
          {"self_clearance", found.self_clearance},
          {"agents", found.agents},
          {"obstacle", found.obstacle},
          {"self", found.self},
          {"turn", found.turn},
          {"turn_agent", found.turn_agent},
          {"speed", found.speed},
          {"speed_agent", found.speed_agent},
          {"late", found.late},
          {"off_plane", found.off_plane},
          {"places_kept", found.places_kept},
          {"length", found.length},
          {"straight", found.straight},
          {"arrival", found.arrival}};
}

RoutePlan plan_of(const char* text) {
  require(text, "plan");
  try {
    return parse_route_plan(text);
  } catch (const FileError& error) {
    throw std::invalid_argument(std::string("plan: ") + error.what());
  }
}

unsnarl_result planned(const RoutePlan& plan, const unsnarl_options& given, Context* context) {
  RouteOptions options;
  options.spacing = given.spacing;
  options.time_limit_s = given.time_limit;
  const RoutesResult made = plan_routes(plan, options, context);

  Json json = made.routes.empty() ? Json::object() : json_of(made.found);
  json["messages"] = made.messages;
  json["alone_length"] = made.alone_length;
  json["seconds"] = made.seconds;
  unsnarl_result result;
  result.status = to_string(made.status);
  result.report = json.dump();
  std::vector<std::vector<double>> polylines;
  for (const Route& route : made.routes) {
    std::vector<double>& points = polylines.emplace_back();
    for (const RoutePoint& p : route.points) points.insert(points.end(), p.begin(), p.end());
  }
  add_polylines(result, polylines, 3);
  return result;
}

std::vector<Route> routes_of(const unsnarl_curves& curves) {
  std::vector<Route> routes(curves.curve_count);
  for (std::size_t c = 0; c < curves.curve_count; ++c)
    for (std::int32_t k = curves.offsets[c]; k < curves.offsets[c + 1]; ++k)
      routes[c].points.push_back({curves.points[3 * k], curves.points[3 * k + 1], curves.points[3 * k + 2]});
  return routes;
}

}  // namespace
}  // namespace unsnarl::c_interface

using namespace unsnarl;
using namespace unsnarl::c_interface;

int unsnarl_plan_routes(const char* plan, const unsnarl_options* options, unsnarl_context* context,
                        unsnarl_result** result) {
  return hand_out(result,
                  [&] { return planned(plan_of(plan), options_of(options, Work::routes), context_of(context)); });
}

int unsnarl_check_routes(const char* plan, const unsnarl_curves* routes, unsnarl_result** result) {
  return hand_out(result, [&] {
    const RoutePlan wanted = plan_of(plan);
    const RouteFindings findings = check_routes(wanted, routes_of(curves_of(routes, "routes")));
    Json json = json_of(findings);
    json["faults"] = route_faults(wanted, findings);
    unsnarl_result found;
    found.report = json.dump();
    return found;
  });
}
