#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <stdexcept>

#include "io/parse_json.h"
#include "unsnarl/document.h"
#include "unsnarl/paths.h"
#include "unsnarl/routes.h"
#include "unsnarl/version.h"

namespace unsnarl {
namespace {

using Json = nlohmann::ordered_json;

[[noreturn]] void refuse(const std::string& place, const std::string& what) {
  throw FileError(fmt::format("{}: {}", place, what));
}

/// The text of a value, cut short.
std::string shown(const Json& value) {
  std::string text = value.dump(-1, ' ', false, Json::error_handler_t::replace);
  if (text.size() > 40) text = text.substr(0, 37) + "...";
  return text;
}

const Json& object(const Json& value, const std::string& place, std::initializer_list<std::string_view> keys) {
  if (!value.is_object()) refuse(place, fmt::format("{} is not an object", shown(value)));
  for (const auto& [key, member] : value.items())
    if (std::find(keys.begin(), keys.end(), key) == keys.end())
      refuse(place, fmt::format("there is no \"{}\" to give here; there are {}", key,
                                fmt::format("{}", fmt::join(keys, ", "))));
  return value;
}

const Json& member(const Json& value, const std::string& place, const char* key) {
  const auto found = value.find(key);
  if (found == value.end()) refuse(place, fmt::format("\"{}\" is missing", key));
  return *found;
}

const Json& list(const Json& value, const std::string& place) {
  if (!value.is_array()) refuse(place, fmt::format("{} is not a list", shown(value)));
  return value;
}

double number(const Json& value, const std::string& place) {
  if (!value.is_number()) refuse(place, fmt::format("{} is not a number", shown(value)));
  return value.get<double>();
}

std::string text(const Json& value, const std::string& place) {
  if (!value.is_string()) refuse(place, fmt::format("{} is not a text in quotes", shown(value)));
  return value.get<std::string>();
}

bool yes_or_no(const Json& value, const std::string& place) {
  if (!value.is_boolean()) refuse(place, "give true or false");
  return value.get<bool>();
}

/// As many numbers as there are in `form`, which the message shows.
std::vector<double> numbers(const Json& value, std::size_t count, const char* form, const std::string& place) {
  if (!value.is_array() || value.size() != count) refuse(place, fmt::format("{} is not {}", shown(value), form));
  std::vector<double> all;
  for (const Json& item : value) all.push_back(number(item, fmt::format("{}[{}]", place, all.size())));
  return all;
}

RoutePoint point(const Json& value, const std::string& place) {
  const std::vector<double> p = numbers(value, 3, "[x, y, z]", place);
  return {p[0], p[1], p[2]};
}

std::vector<RoutePoint> points(const Json& value, const std::string& place) {
  std::vector<RoutePoint> all;
  for (const Json& item : list(value, place)) all.push_back(point(item, fmt::format("{}[{}]", place, all.size())));
  return all;
}

RouteAgent agent(const Json& value, std::size_t number_of_agent) {
  const std::string place = fmt::format("agents[{}]", number_of_agent);
  object(value, place, {"name", "radius", "start", "goal", "waypoints", "planar", "priority", "window", "speed"});
  RouteAgent made;
  made.name = value.contains("name") ? text(value["name"], place + ".name") : fmt::format("agent_{}", number_of_agent);
  made.radius = number(member(value, place, "radius"), place + ".radius");
  made.start = point(member(value, place, "start"), place + ".start");
  made.goal = point(member(value, place, "goal"), place + ".goal");
  if (value.contains("waypoints")) made.waypoints = points(value["waypoints"], place + ".waypoints");
  if (value.contains("planar")) made.planar = yes_or_no(value["planar"], place + ".planar");
  if (value.contains("priority")) made.priority = number(value["priority"], place + ".priority");
  if (value.contains("speed")) made.speed = number(value["speed"], place + ".speed");
  if (value.contains("window")) {
    const std::vector<double> window = numbers(value["window"], 2, "[from, to]", place + ".window");
    made.window = {window[0], window[1]};
  }
  return made;
}

Surface written_surface(const Json& value, const std::string& place) {
  Surface surface;
  for (const RoutePoint& p : points(member(value, place, "vertices"), place + ".vertices"))
    surface.positions.insert(surface.positions.end(), p.begin(), p.end());
  surface.offsets.push_back(0);
  for (const Json& face : list(member(value, place, "faces"), place + ".faces")) {
    const std::string here = fmt::format("{}.faces[{}]", place, surface.offsets.size() - 1);
    if (list(face, here).size() < 3) refuse(here, "a face has three corners at least");
    for (const Json& corner : face) {
      if (!corner.is_number_integer()) refuse(here, fmt::format("{} is not the number of a vertex", shown(corner)));
      const auto v = corner.get<std::int64_t>();
      if (v < 0 || v >= static_cast<std::int64_t>(surface.positions.size() / 3))
        refuse(here,
               fmt::format("there is no vertex {}; there are {}, counted from 0", v, surface.positions.size() / 3));
      surface.corners.push_back(static_cast<std::int32_t>(v));
    }
    surface.offsets.push_back(static_cast<std::int32_t>(surface.corners.size()));
  }
  return surface;
}

RouteObstacle obstacle(const Json& value, std::size_t number_of_obstacle, const std::filesystem::path& folder) {
  const std::string place = fmt::format("obstacles[{}]", number_of_obstacle);
  object(value, place, {"name", "file", "vertices", "faces", "hollow", "motion"});
  RouteObstacle made;
  made.name = fmt::format("obstacle_{}", number_of_obstacle);
  if (value.contains("file")) {
    if (value.contains("vertices") || value.contains("faces"))
      refuse(place, "give either a file or vertices and faces");
    const std::string file = text(value["file"], place + ".file");
    try {
      made.surface = Document::read(folder / path_of(file)).surface();
    } catch (const FileError& e) {
      refuse(place + ".file", e.what());
    }
    made.name = path_of(file).stem().string();
  } else {
    if (!value.contains("vertices")) refuse(place, "\"file\" is missing, or \"vertices\" and \"faces\"");
    made.surface = written_surface(value, place);
  }
  if (value.contains("name")) made.name = text(value["name"], place + ".name");
  if (value.contains("hollow")) made.hollow = yes_or_no(value["hollow"], place + ".hollow");
  if (value.contains("motion"))
    for (const Json& item : list(value["motion"], place + ".motion")) {
      const std::vector<double> move =
          numbers(item, 4, "[time, x, y, z]", fmt::format("{}.motion[{}]", place, made.motion.size()));
      made.motion.push_back({move[0], {move[1], move[2], move[3]}});
    }
  return made;
}

}  // namespace

RoutePlan parse_route_plan(std::string_view text, const std::filesystem::path& folder) {
  const Json root = parse_json(text);
  object(root, "the plan", {"agents", "obstacles", "timed", "duration"});
  RoutePlan plan;
  if (root.contains("timed")) plan.timed = yes_or_no(root["timed"], "timed");
  if (root.contains("duration")) {
    plan.duration = number(root["duration"], "duration");
    if (!plan.timed) refuse("duration", "give the plan \"timed\": true too");
  }
  for (const Json& item : list(member(root, "the plan", "agents"), "agents"))
    plan.agents.push_back(agent(item, plan.agents.size()));
  if (root.contains("obstacles"))
    for (const Json& item : list(root["obstacles"], "obstacles"))
      plan.obstacles.push_back(obstacle(item, plan.obstacles.size(), folder));
  try {
    check_plan(plan);
  } catch (const std::invalid_argument& e) {
    throw FileError(e.what());
  }
  return plan;
}

std::string route_plan_json(const RoutePlan& plan) {
  Json json = {{"agents", Json::array()}};
  for (const RouteAgent& a : plan.agents) {
    Json item = {{"name", a.name}, {"radius", a.radius}, {"start", a.start}, {"goal", a.goal}};
    if (!a.waypoints.empty()) item["waypoints"] = a.waypoints;
    if (a.planar) item["planar"] = true;
    if (a.priority != 0) item["priority"] = a.priority;
    if (a.window != RouteAgent().window) item["window"] = {a.window[0], std::min(a.window[1], plan.duration)};
    if (a.speed != RouteAgent().speed) item["speed"] = a.speed;
    json["agents"].push_back(std::move(item));
  }
  if (plan.timed) json["timed"] = true;
  if (plan.timed && plan.duration != 1) json["duration"] = plan.duration;
  if (!plan.obstacles.empty()) json["obstacles"] = Json::array();
  for (const RouteObstacle& o : plan.obstacles) {
    Json item = {{"name", o.name}, {"vertices", Json::array()}, {"faces", Json::array()}};
    const SurfaceView surface = o.surface;
    for (std::size_t v = 0; v < surface.vertex_count(); ++v) {
      const auto p = surface.positions.subspan(3 * v, 3);
      item["vertices"].push_back({p[0], p[1], p[2]});
    }
    for (std::size_t f = 0; f < surface.face_count(); ++f)
      item["faces"].push_back(std::vector<std::int32_t>(surface.face(f).begin(), surface.face(f).end()));
    if (o.hollow) item["hollow"] = true;
    for (const RouteMove& m : o.motion) item["motion"].push_back({m.time, m.offset[0], m.offset[1], m.offset[2]});
    json["obstacles"].push_back(std::move(item));
  }
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string routes_json(const RoutePlan& plan, const RoutesResult& result) {
  const RouteFindings& f = result.found;
  Json json = {{"schema", "unsnarl-routes"},
               {"schema_version", 2},
               {"version", version},
               {"timed", plan.timed},
               {"hold", f.hold()},
               {"clearance", f.clearance},
               {"obstacle_clearance", f.obstacle_clearance},
               {"self_clearance", f.self_clearance},
               {"clearances_measured_up_to", RouteFindings::measured_up_to},
               {"turn", f.turn},
               {"speed", f.speed},
               {"mean_ratio", f.mean_ratio()},
               {"max_ratio", f.max_ratio()},
               {"mean_alone_ratio", result.mean_alone_ratio()},
               {"seconds", result.seconds},
               {"routes", Json::array()}};
  if (plan.timed) json["duration"] = plan.duration;
  for (std::size_t i = 0; i < result.routes.size(); ++i) {
    Json item = {{"name", plan.agents[i].name}, {"radius", plan.agents[i].radius}};
    if (i < f.length.size()) {
      item["length"] = f.length[i];
      item["straight"] = f.straight[i];
    }
    if (i < f.arrival.size()) item["arrival"] = f.arrival[i];
    if (i < result.alone_length.size()) item["alone"] = result.alone_length[i];
    item["points"] = result.routes[i].points;
    json["routes"].push_back(std::move(item));
  }
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::vector<Route> parse_routes(std::string_view bytes, const RoutePlan& plan) {
  const Json root = parse_json(bytes);
  if (!root.is_object()) refuse("the file", "it is not an object with \"routes\"");
  std::vector<Route> routes(plan.agents.size());
  std::size_t k = 0;
  for (const Json& item : list(member(root, "the file", "routes"), "routes")) {
    const std::string place = fmt::format("routes[{}]", k++);
    if (!item.is_object()) refuse(place, fmt::format("{} is not an object", shown(item)));
    const std::string name = text(member(item, place, "name"), place + ".name");
    const auto found =
        std::find_if(plan.agents.begin(), plan.agents.end(), [&](const RouteAgent& a) { return a.name == name; });
    if (found == plan.agents.end()) refuse(place + ".name", fmt::format("the plan has no agent '{}'", name));
    Route& route = routes[static_cast<std::size_t>(found - plan.agents.begin())];
    if (!route.points.empty()) refuse(place + ".name", fmt::format("there is a route of '{}' before", name));
    route.points = points(member(item, place, "points"), place + ".points");
    if (route.points.size() < 2) refuse(place + ".points", "a route has two points at least");
  }
  for (std::size_t i = 0; i < routes.size(); ++i)
    if (routes[i].points.empty()) refuse("routes", fmt::format("there is none of '{}'", plan.agents[i].name));
  return routes;
}

}  // namespace unsnarl
