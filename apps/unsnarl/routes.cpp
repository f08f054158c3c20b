#include "routes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

#include "cancellable_work.h"
#include "command_options.h"
#include "input_bytes.h"
#include "mesh_input.h"
#include "pictures.h"
#include "staged_output.h"
#include "standard_streams.h"
#include "surface_files.h"
#include "unsnarl/exit_code.h"
#include "unsnarl/paths.h"
#include "unsnarl/pictures.h"
#include "unsnarl/routes.h"
#include "unsnarl/visible_text.h"
#include "usage_error.h"

namespace unsnarl::app {
namespace {

namespace fs = std::filesystem;

std::string as_text(const RoutePlan& plan, const RouteFindings& f) {
  const auto measured = [](double clearance) {
    return clearance < RouteFindings::measured_up_to ? fmt::format("{:.5f}", clearance)
                                                     : fmt::format("{} or more", RouteFindings::measured_up_to);
  };
  std::string text = "smallest distance / required distance: ";
  std::vector<std::string> parts;
  if (plan.agents.size() > 1)
    parts.push_back(measured(f.clearance) + (plan.timed ? " between agents at every time" : " between routes"));
  if (!plan.obstacles.empty()) parts.push_back(measured(f.obstacle_clearance) + " from obstacles");
  if (!plan.timed) parts.push_back(measured(f.self_clearance) + " within a route");
  return text +
         fmt::format(
             "{}\n"
             "radius * curvature: {:.3f} at most; length / straight: mean {:.3f}, largest {:.3f}\n",
             parts.empty() ? "nothing is near" : fmt::format("{}", fmt::join(parts, ", ")), f.turn, f.mean_ratio(),
             f.max_ratio()) +
         (plan.timed ? fmt::format("all have arrived at {:.6g} of {:.6g}{}\n",
                                   *std::max_element(f.arrival.begin(), f.arrival.end()), plan.duration,
                                   f.speed > 0 ? fmt::format("; speed / the one allowed: {:.3f} at most", f.speed) : "")
                     : "");
}

int check_file(const RoutesCommandOptions& options, const RoutePlan& plan) {
  const RouteFindings found = parse_file(
      options.check, [&](const std::string& bytes) { return check_routes(plan, parse_routes(bytes, plan)); });
  if (!options.quiet)
    tell(as_text(plan, found) + route_faults(plan, found) +
         (!found.hold() ? ""
          : plan.timed  ? "the agents keep their distance at every time\n"
                        : "the routes keep their distance from each other\n"));
  return found.hold() ? exit_embedded : exit_intersecting;
}

/// Pairs of faces of which at least one is of a tube: obstacles may intersect themselves and each other. In time, tubes
/// may cross too, and obstacles that move may cross them: they are there at different times.
std::vector<IntersectingPair> pairs_of_tubes(const RoutePlan& plan, const Surface& tubes) {
  const auto faces = static_cast<std::int32_t>(tubes.view().face_count());
  FindOptions find;
  find.weld = Weld::none;
  RoutePlan still = plan;
  std::erase_if(still.obstacles, [](const RouteObstacle& obstacle) { return !obstacle.motion.empty(); });
  std::vector<IntersectingPair> pairs = find_intersections(with_obstacles(still, tubes), find);
  std::erase_if(pairs, [&](const IntersectingPair& pair) {
    return pair.a >= faces || (plan.timed && pair.b < faces);  // a < b
  });
  return pairs;
}

/// Without obstacles that would hide all: those above every route.
RoutePlan seen_from_above(const RoutePlan& plan, const Surface& tubes) {
  double highest = tubes.positions[1];
  for (std::size_t k = 1; k < tubes.positions.size(); k += 3) highest = std::max(highest, tubes.positions[k]);
  RoutePlan seen = plan;
  std::erase_if(seen.obstacles, [&](const RouteObstacle& obstacle) {
    const std::vector<double>& p = obstacle.surface.positions;
    bool is_above = true;
    for (std::size_t k = 1; k < p.size(); k += 3) is_above = is_above && p[k] >= highest;
    return is_above;
  });
  return seen;
}

/// Tubes, a part each.
struct Tubes {
  Surface surface;
  std::vector<SceneFile> parts;
};
Tubes tubes_of(const RoutePlan& plan, std::span<const Route> routes, int sides) {
  Tubes tubes;
  tubes.surface = route_tubes(plan, routes, sides, &tubes.parts);
  return tubes;
}

std::string picture(const RoutePlan& plan, Tubes before, Tubes after, const std::string& label = "routes") {
  const RoutePlan seen = seen_from_above(plan, after.surface);
  PictureOptions options;
  options.before_label = "as asked";
  options.after_label = label;
  options.inset = false;
  options.translucent_from = plan.agents.size();
  const Surface all_before = with_obstacles(seen, before.surface, &before.parts),
                all_after = with_obstacles(seen, after.surface, &after.parts);
  options.files_before = before.parts;
  options.files = after.parts;
  return picture_png(all_before, intersecting_faces(pairs_of_tubes(seen, before.surface)), all_after, {}, options);
}

std::vector<std::string> names_of(const RoutePlan& plan) {
  std::vector<std::string> names;
  for (const RouteAgent& agent : plan.agents) names.push_back(agent.name);
  return names;
}

/// Adds tubes that are read back as they are and of which none meets another, nor an obstacle; false: they do not hold.
bool add_tubes(const std::string& path, const RoutePlan& plan, const Surface& tubes, StagedOutput& outputs) {
  const std::string bytes = surface_file(tubes, Format::obj, "tubes of routes by unsnarl", names_of(plan));
  const Document written = Document::read(outputs.add(path_of(path), {OutputFile{{}, bytes}}), Format::obj);
  return written.surface().positions == tubes.positions && written.surface().corners == tubes.corners &&
         pairs_of_tubes(plan, written.surface()).empty();
}

int tell_failure(const RoutesCommandOptions& options, const RoutePlan& plan, const RoutesResult& made) {
  if (options.quiet) return exit_code_of(made.status);
  for (const std::string& message : made.messages) tell(message + "\n");
  if (made.status == Status::no_progress && made.messages.empty())
    tell("no routes were found that keep their distance; the best ones:\n" + route_faults(plan, made.found));
  tell(fmt::format("{}: no file written\n", to_string(made.status)));
  return exit_code_of(made.status);
}

int tell_broken_tubes(const RoutesCommandOptions& options) {
  if (!options.quiet)
    tell(fmt::format(
        "the routes keep their distance, but faces of the tubes around them intersect; the radii may be too "
        "small for double precision\n{}: no file written\n",
        to_string(Status::no_progress)));
  return exit_code_of(Status::no_progress);
}

/// The paper's own way: surfaces of straight tubes, untangled as any surface is; only their ends stay.
int run_free_tubes(const RoutesCommandOptions& options, const RoutePlan& plan, const RoutesResult& made,
                   Interruption& interruption) {
  const auto [tubes, parts] = tubes_of(plan, made.asked, options.sides);
  Surface scene = with_obstacles(plan, tubes);
  RepairOptions wanted;
  wanted.find.weld = Weld::none;
  wanted.time_limit_s = options.time_limit_s;
  wanted.precision = Precision::float64;
  wanted.fixed.assign(scene.view().vertex_count(), 1);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    // Half balls and rings at the ends are the vertices within a radius of them.
    for (std::size_t v = parts[i].first_vertex; v < parts[i].first_vertex + parts[i].vertices; ++v) wanted.fixed[v] = 0;
    const std::size_t cap = parts[i].vertices - static_cast<std::size_t>(options.sides) * made.asked[i].points.size();
    const std::size_t ends = cap / 2 + static_cast<std::size_t>(options.sides);
    for (std::size_t k = 0; k < ends; ++k)
      wanted.fixed[parts[i].first_vertex + k] = wanted.fixed[parts[i].first_vertex + parts[i].vertices - 1 - k] = 1;
  }
  const RepairResult repaired = cancellable(options.progress, options.quiet, interruption, options.plan,
                                            [&](Context* context) { return repair(scene, wanted, context); });
  Surface after = tubes;
  std::copy_n(repaired.positions.begin(), after.positions.size(), after.positions.begin());
  const std::vector<IntersectingPair> left = pairs_of_tubes(plan, after);
  if (!left.empty()) {
    if (!options.quiet)
      tell(fmt::format("{}: {} pairs of faces still intersect; no file written\n", to_string(repaired.status),
                       left.size()));
    return repaired.status == Status::embedded ? exit_intersecting : exit_code_of(repaired.status);
  }
  const auto path = [&](const std::string& name) { return (path_of(options.folder) / path_of(name)).string(); };
  StagedOutput outputs(interruption);
  if (!add_tubes(path("tubes.obj"), plan, after, outputs)) return tell_broken_tubes(options);
  outputs.add(path("picture.png"), picture(plan, {tubes, parts}, {after, parts}, "free tubes"));
  outputs.commit();
  if (!options.quiet)
    tell(
        fmt::format("{} free tubes, no two faces intersect; they are no longer round, so the distances between\n"
                    "agents are not certified\nwrote {}\n",
                    plan.agents.size(), visible_text(options.folder)));
  return exit_embedded;
}

}  // namespace

void add_routes_options(CLI::App& command, RoutesCommandOptions& options) {
  command
      .add_option(
          "PLAN", options.plan,
          "Plan (JSON): agents (name, radius, start, goal, waypoints, planar, priority) and obstacles (file, "
          "hollow). With \"timed\": true, agents only have to keep their distance at the same time; the plan may "
          "have a duration, agents a speed and a window, obstacles a motion. '-' for standard input")
      ->required();
  command.add_option("-o,--output", options.folder, "Folder for the results; it must be new or empty")
      ->type_name("DIR");
  command
      .add_option("--spacing", options.spacing,
                  "Distance between the points of a route, in radii of the agent (0.1 to 2, default 0.5)")
      ->check(number_within(0.1, 2, unit::none))
      ->type_name("NUMBER");
  command.add_option("--sides", options.sides, "Number of corners around a tube (3 to 256, default 16)")
      ->check(whole_number_within(3, 256))
      ->type_name("N");
  command.add_flag("--free-tubes", options.free_tubes,
                   "Untangle straight tubes as surfaces, as in the paper. They do not stay round, so distances are not "
                   "certified");
  add_time_limit(command, options.time_limit_s);
  command.add_option("--check", options.check, "Certify these routes instead of making some")->type_name("ROUTES.json");
  add_progress(command, options.progress);
  add_quiet(command, options.quiet);
  command.footer(std::string("Written into DIR:\n"
                             "  routes.json    points and lengths of the routes, and what was certified\n"
                             "  tubes.obj      the tubes that the agents move through, one group each\n"
                             "  animation.svg  the moving agents\n"
                             "  picture.png    the straight ways and the routes\n"
                             "With --free-tubes only tubes.obj and picture.png.\n\n"
                             "Examples:\n"
                             "  unsnarl sample routes_star_6 -o plan.json && unsnarl routes plan.json -o out\n"
                             "  unsnarl routes plan.json --check out/routes.json\n\n") +
                 exit_codes({{exit_embedded, "certified routes"},
                             {exit_intersecting, "none found (--check: not certified)"},
                             {exit_limit, "time limit reached"},
                             {exit_obstructed, "no routes can exist for this plan"}}));
}

int run_routes(const RoutesCommandOptions& options, Interruption& interruption) {
  if (options.folder.empty() == options.check.empty())
    throw UsageError("'unsnarl routes' needs -o DIR, to make routes, or --check ROUTES.json, to certify some");
  const RoutePlan plan = parse_file(options.plan, [&](const std::string& bytes) {
    return parse_route_plan(bytes, options.plan == standard_stream ? fs::path() : path_of(options.plan).parent_path());
  });
  if (!options.check.empty()) return check_file(options, plan);
  if (options.free_tubes && plan.timed)
    throw UsageError("--free-tubes does not work with \"timed\": true; leave one of the two out");
  prepare_picture_folder(options.folder, "-o");

  RouteOptions wanted;
  wanted.spacing = options.spacing;
  wanted.time_limit_s = options.time_limit_s;
  wanted.ways_only = options.free_tubes;
  const RoutesResult made = cancellable(options.progress, options.quiet, interruption, options.plan,
                                        [&](Context* context) { return plan_routes(plan, wanted, context); });
  if (options.free_tubes && !made.asked.empty()) return run_free_tubes(options, plan, made, interruption);
  if (made.status != Status::embedded) return tell_failure(options, plan, made);

  const auto path = [&](const std::string& name) { return (path_of(options.folder) / path_of(name)).string(); };
  const Tubes tubes = tubes_of(plan, made.routes, options.sides);
  StagedOutput outputs(interruption);
  const fs::path written = outputs.add(path_of(path("routes.json")), {OutputFile{{}, routes_json(plan, made)}});
  const RouteFindings found = check_routes(plan, parse_routes(read_bytes(written.string()), plan));
  if (!found.hold()) throw std::logic_error("the routes to be written do not hold: " + route_faults(plan, found));
  if (!add_tubes(path("tubes.obj"), plan, tubes.surface, outputs)) return tell_broken_tubes(options);
  outputs.add(path("animation.svg"), routes_animation_svg(plan, made.routes));
  outputs.add(path("picture.png"), picture(plan, tubes_of(plan, made.asked, options.sides), tubes));
  outputs.commit();
  if (!options.quiet)
    tell(fmt::format("{} route{}, certified as written:\n{}{}wrote {}, {:.1f} s\n", made.routes.size(),
                     made.routes.size() == 1 ? "" : "s", as_text(plan, made.found),
                     plan.obstacles.empty() ? ""
                                            : fmt::format("length / length of the agent's route alone: mean {:.3f}\n",
                                                          made.mean_alone_ratio()),
                     visible_text(options.folder), made.seconds));
  return exit_embedded;
}

}  // namespace unsnarl::app
